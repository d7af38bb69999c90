"""Eq. 5 to 15: the homoclinic orbit, Melnikov's function and the critical amplitude, proved and checked."""

import mpmath
import numpy as np
import pytest
import scipy.integrate
import scipy.optimize
import sympy as sp

from book.studies import melnikov
from book.studies.melnikov import melnikov_quadrature
from duffing import ConvergenceError, Duffing, critical_amplitude, homoclinic_orbit, melnikov_function
from duffing.melnikov import damping_integral, forcing_integral, least_critical_frequency

ALPHA, P, MU, OMEGA, GAMMA = sp.symbols("alpha p mu omega gamma", positive=True)
DELTA = sp.Symbol("delta", negative=True)
SYMBOLIC = Duffing(ALPHA, P, MU, OMEGA, DELTA, GAMMA)
T = sp.Symbol("t", real=True)
WELLS = [("-1", "1"), ("-1.7", "0.6"), ("-0.4", "2.5")]


@pytest.mark.parametrize("side", [1, -1])
def test_homoclinic_orbit_solves_the_unperturbed_equations_of_motion(side):
    """Eq. 5 at epsilon = 0 and Eq. 8, for symbolic delta < 0 < gamma."""
    x, v = homoclinic_orbit(SYMBOLIC, T, side)
    assert sp.simplify(sp.diff(x, T) - v) == 0
    assert sp.simplify((sp.diff(v, T) + DELTA * x + GAMMA * x**3).rewrite(sp.exp)) == 0


@pytest.mark.parametrize("side", [1, -1])
def test_homoclinic_orbit_has_the_energy_of_the_saddle(side):
    """Eq. 4 and 6: H0 = 0 along the loop, so v^2 = -delta x^2 - gamma x^4 / 2."""
    x, v = homoclinic_orbit(SYMBOLIC, T, side)
    assert sp.simplify(SYMBOLIC.energy(x, v).rewrite(sp.exp)) == 0


def test_time_along_the_loop_is_the_integral_of_equation_7():
    """dt/dx of Eq. 7 with x = x*(t), on the outgoing branch t < 0 of the right loop, where v > 0."""
    t = sp.Symbol("t", negative=True)
    x, v = homoclinic_orbit(SYMBOLIC, t)
    slope = 1 / (x * sp.sqrt(-DELTA - GAMMA * x**2 / 2))
    values = {DELTA: sp.Rational(-7, 5), GAMMA: sp.Rational(3, 2)}
    for time in (-3, -1, sp.Rational(-1, 10)):
        difference = (slope * v - 1).subs(values).subs(t, time)
        assert abs(sp.N(difference, 40)) < 1e-38


def test_right_loop_belongs_to_plus_and_left_loop_to_minus():
    """The text below Eq. 8 pairs the signs with the sides the other way round."""
    assert homoclinic_orbit(Duffing(), 0.0, side=1)[0] > 0 > homoclinic_orbit(Duffing(), 0.0, side=-1)[0]


def test_homoclinic_orbit_ends_at_the_saddle_without_overflow():
    x, v = homoclinic_orbit(Duffing(delta=-2.0), np.array([-1e6, -800.0, 800.0, 1e6]))
    np.testing.assert_array_equal(x, 0.0)
    np.testing.assert_array_equal(v, 0.0)


@pytest.mark.parametrize(("delta", "gamma"), WELLS)
@pytest.mark.parametrize("p", ["0.1", "0.3", "0.5", "1", "1.5", "2", "3"])
def test_damping_integral_equals_quadrature_of_equation_9_to_forty_digits(p, delta, gamma):
    with mpmath.workdps(60):
        osc = Duffing(*map(mpmath.mpf, ("1", p, "0", "1", delta, gamma)))
        assert abs(melnikov_quadrature(osc, 0, digits=42) / melnikov_function(osc, 0) - 1) < mpmath.mpf(10) ** -40


@pytest.mark.parametrize(("delta", "gamma"), WELLS)
@pytest.mark.parametrize("omega", ["0.2", "0.7", "1", "2", "4"])
def test_forcing_integral_equals_quadrature_of_equation_9_to_forty_digits(omega, delta, gamma):
    with mpmath.workdps(60):
        osc = Duffing(*map(mpmath.mpf, ("0", "1", "1", omega, delta, gamma)))
        t0 = mpmath.mpf("0.3")
        assert abs(melnikov_quadrature(osc, t0, digits=42) / melnikov_function(osc, t0) - 1) < mpmath.mpf(10) ** -40


def test_melnikov_function_of_the_whole_problem_equals_quadrature_to_forty_digits():
    with mpmath.workdps(60):
        osc = Duffing(*map(mpmath.mpf, ("0.1", "0.1", "0.27", "1", "-1", "1")))
        for t0 in (mpmath.mpf("0.2"), mpmath.mpf("-2.5")):
            assert abs(melnikov_quadrature(osc, t0, digits=42) / melnikov_function(osc, t0) - 1) < mpmath.mpf(10) ** -40


def test_damping_integral_becomes_the_beta_function_for_every_p_above_minus_one():
    """s = tanh(u)^2 in the integral over u of |sech u tanh u|^(p + 1); q = p + 1 > 0 is any positive number."""
    q, s = sp.symbols("q s", positive=True)
    u = sp.Symbol("u", positive=True)
    by_parts = (sp.sech(u) * sp.tanh(u)) ** q / sp.diff(sp.tanh(u) ** 2, u)  # the integrand over s, still in u
    in_s = s ** ((q - 1) / 2) * (1 - s) ** ((q - 2) / 2) / 2
    with mpmath.workdps(30):
        for q_value in (sp.Rational(1, 7), sp.Rational(11, 10), sp.Integer(3)):
            for u_value in (sp.Rational(1, 3), sp.Integer(2)):
                difference = (by_parts - in_s.subs(s, sp.tanh(u) ** 2)).subs({q: q_value, u: u_value})
                assert abs(sp.N(difference, 30)) < 1e-25
    # Twice the half line is Euler's integral of the first kind, B((q + 1)/2, q/2); sympy closes it for the symbol q.
    closed = sp.gammasimp(sp.integrate(2 * in_s, (s, 0, 1), conds="none"))
    beta = sp.beta((q + 1) / 2, q / 2).rewrite(sp.gamma)
    assert sp.simplify(sp.gammasimp(closed / beta)) == 1


@pytest.mark.parametrize("p", [1, 2, 3])
def test_damping_integral_for_whole_p_equals_sympys_direct_integral(p):
    s = sp.Symbol("s", nonnegative=True)  # s = tanh(sqrt(-delta) t): v* is a polynomial times sqrt(1 - s^2) in s
    speed = sp.sqrt(2 / GAMMA) * (-DELTA) * s * sp.sqrt(1 - s**2)
    direct = 2 * sp.integrate(sp.expand(speed ** (p + 1) / (1 - s**2)) / sp.sqrt(-DELTA), (s, 0, 1))
    closed = damping_integral(Duffing(p=sp.Integer(p), delta=DELTA, gamma=GAMMA)).rewrite(sp.gamma)
    assert sp.simplify(direct - closed) == 0


def test_forcing_integral_follows_from_the_known_transform_of_sech():
    """v* = dx*/dt: by parts, the transform of v* is omega times that of x*, and sech's is pi sech(pi omega / 2)."""
    u, k = sp.symbols("u k", positive=True)
    # Residues at u = i pi / 2 close the contour of height pi: (1 + exp(-pi k)) I = 2 pi exp(-pi k / 2).
    residue = sp.residue(sp.exp(sp.I * k * u) / sp.cosh(u), u, sp.I * sp.pi / 2)
    transform = 2 * sp.pi * sp.I * residue / (1 + sp.exp(-sp.pi * k))
    assert sp.simplify((transform - sp.pi / sp.cosh(sp.pi * k / 2)).rewrite(sp.exp)) == 0
    amplitude = sp.sqrt(-2 * DELTA / GAMMA)
    by_parts = amplitude * OMEGA * (transform / sp.sqrt(-DELTA)).subs(k, OMEGA / sp.sqrt(-DELTA))
    assert sp.simplify((by_parts - forcing_integral(SYMBOLIC)).rewrite(sp.exp)) == 0


def relative_error(osc, t0, digits):
    """Of the quadrature, to the larger of the two terms of the closed form."""
    value = melnikov_quadrature(osc, t0, digits=digits)
    with mpmath.workdps(digits + 200):
        exact = Duffing(*map(mpmath.mpf, (osc.alpha, osc.p, osc.mu, osc.omega, osc.delta, osc.gamma)))
        t0 = mpmath.mpf(t0)
        forcing = exact.mu * forcing_integral(exact) * mpmath.sin(exact.omega * t0)
        return abs(value - melnikov_function(exact, t0)) / max(abs(forcing), exact.alpha * damping_integral(exact))


@pytest.mark.parametrize("digits", [15, 40])
@pytest.mark.parametrize("p", [0.001, 1.0, 50.0])
@pytest.mark.parametrize("omega", [0.001, 1.0, 40.0])
def test_quadrature_has_the_digits_asked_for_at_every_frequency_and_exponent(omega, p, digits):
    assert relative_error(Duffing(alpha=0.1, p=p, mu=0.3, omega=omega), 0.7, digits) < mpmath.mpf(10) ** -digits


@pytest.mark.parametrize(("omega", "digits"), [(40.0, 50), (200.0, 15), (1.0, 120)])
def test_quadrature_resolves_the_forcing_alone_where_its_oscillation_cancels_all_that_doubles_hold(omega, digits):
    assert relative_error(Duffing(alpha=0.0, mu=0.3, omega=omega), 0.7, digits) < mpmath.mpf(10) ** -digits


def test_quadrature_of_no_damping_and_no_forcing_is_zero():
    assert melnikov_quadrature(Duffing(alpha=0.0, mu=0.0), 0.3, digits=20) == 0


def test_quadrature_whose_sums_do_not_agree_is_a_named_error(monkeypatch):
    monkeypatch.setattr(melnikov, "loop_velocity", lambda osc, t, lib: lib.sech(t) * lib.cos(1e3 * t))
    with pytest.raises(ConvergenceError, match=r"^digits = 20: the sums agree to a part in"):
        melnikov_quadrature(Duffing(mu=0.3), 0.7, digits=20)


def test_forcing_integral_equals_scipys_quadrature():
    osc = Duffing(omega=1.3, delta=-1.7, gamma=0.6)
    for side in (1, -1):
        work = scipy.integrate.quad(
            lambda t, s=side: homoclinic_orbit(osc, t, s)[1] * np.cos(1.3 * (t + 0.4)), -40, 40, limit=200
        )[0]
        free = Duffing(alpha=0.0, mu=1.0, omega=1.3, delta=-1.7, gamma=0.6)
        assert melnikov_function(free, 0.4, side) == pytest.approx(work, rel=1e-9)


def test_melnikov_function_is_minus_the_wedge_product_for_positive_orientation():
    """Eq. 9 to 11: h ^ g = (h_x g_v - h_v g_x) with g along dx only gives -v times the perturbation in dx ^ dv."""
    x, v = sp.symbols("x v", real=True)
    perturbation = SYMBOLIC.mu * sp.cos(OMEGA * T) - SYMBOLIC.damping(v)
    h, g = (sp.diff(SYMBOLIC.energy(x, v), x), sp.diff(SYMBOLIC.energy(x, v), v)), (perturbation, 0)
    assert h == (DELTA * x + GAMMA * x**3, v)
    assert sp.expand(h[0] * g[1] - h[1] * g[0] + v * perturbation) == 0


def test_critical_amplitude_is_equation_13_as_printed():
    printed = (
        ALPHA * 2 ** (P / 2) / (sp.pi * OMEGA) * (-DELTA) ** (P + sp.Rational(1, 2)) / GAMMA ** (P / 2)
        * sp.beta((P + 2) / 2, (P + 1) / 2) * sp.cosh(sp.pi * OMEGA / (2 * sp.sqrt(-DELTA)))
    )  # fmt: skip
    assert sp.simplify(sp.powsimp(critical_amplitude(SYMBOLIC) / printed, force=True)) == 1


def test_simple_zeros_of_the_melnikov_function_appear_at_the_critical_amplitude():
    """Eq. 12: none below, a double zero at mu_c, simple zeros above; for both loops."""
    phase = np.linspace(0, 2 * np.pi, 4001)
    mu_c = critical_amplitude(Duffing(p=0.1))
    for side in (1, -1):
        below, at, above = (melnikov_function(Duffing(p=0.1, mu=f * mu_c), phase, side) for f in (0.999, 1.0, 1.001))
        assert below.max() < 0
        assert at.max() == pytest.approx(0.0, abs=1e-15)
        assert np.sum(np.diff(np.sign(above)) != 0) == 2


def test_critical_amplitude_has_the_known_elementary_forms_at_p_1_2_3():
    """p = 1: Moon and Holmes, 4 alpha cosh(pi omega/2) / (3 sqrt(2) pi omega) at delta = -1, gamma = 1."""
    u = sp.cosh(sp.pi * OMEGA / (2 * sp.sqrt(-DELTA))) * ALPHA / (sp.pi * OMEGA)
    known = {
        1: 2 * sp.sqrt(2) / 3 * (-DELTA) ** sp.Rational(3, 2) / sp.sqrt(GAMMA) * u,
        2: sp.Rational(8, 15) * (-DELTA) ** sp.Rational(5, 2) / GAMMA * u,
        3: sp.Rational(8, 35) * sp.sqrt(2) * (-DELTA) ** sp.Rational(7, 2) / GAMMA ** sp.Rational(3, 2) * u,
    }
    for p, form in known.items():
        ours = critical_amplitude(Duffing(ALPHA, sp.Integer(p), MU, OMEGA, DELTA, GAMMA)).rewrite(sp.gamma)
        assert sp.simplify(ours / form) == 1
    textbook = 4 * ALPHA * sp.cosh(sp.pi * OMEGA / 2) / (3 * sp.sqrt(2) * sp.pi * OMEGA)
    assert sp.simplify(known[1].subs({DELTA: -1, GAMMA: 1}) - textbook) == 0


def test_critical_amplitude_tends_to_the_coulomb_value_as_p_vanishes():
    """Dry friction alpha sign(v) takes alpha times the path 2 x_max; forcing gives forcing_integral at most."""
    general = critical_amplitude(SYMBOLIC).rewrite(sp.gamma)
    path = 2 * homoclinic_orbit(SYMBOLIC, sp.Integer(0))[0]
    coulomb = ALPHA * path / forcing_integral(SYMBOLIC)
    assert sp.simplify((general.subs(P, 0) / coulomb).rewrite(sp.exp)) == 1


def test_critical_amplitude_falls_with_p_because_the_loop_is_slower_than_one():
    """d/dp of the damping integral is the mean of log|v|, negative when max |v*| = -delta / sqrt(2 gamma) < 1 ..."""
    assert np.max(np.abs(homoclinic_orbit(Duffing(), np.linspace(-5, 5, 10001))[1])) == pytest.approx(
        1 / np.sqrt(2), rel=1e-6
    )
    p = np.linspace(0.01, 6, 600)
    for omega in (0.2, 1.0, 4.0):
        assert np.all(np.diff(critical_amplitude(Duffing(p=p, omega=omega))) < 0)
    # ... and not otherwise: a fast loop in a deep well is braked more by a larger exponent.
    assert np.any(np.diff(critical_amplitude(Duffing(p=p, delta=-8.0))) > 0)


def test_omega_of_least_critical_amplitude_is_where_scipy_finds_the_minimum():
    for p, delta in ((0.1, -1.0), (2.0, -3.0)):
        found = scipy.optimize.minimize_scalar(
            lambda omega, p=p, delta=delta: critical_amplitude(Duffing(p=p, delta=delta, omega=omega)),
            bounds=(0.1, 4.0), method="bounded", options={"xatol": 1e-10},
        )  # fmt: skip
        assert least_critical_frequency(Duffing(p=p, delta=delta)) == pytest.approx(found.x, abs=1e-7)


def test_critical_amplitude_diverges_like_one_over_omega():
    limit = sp.limit(OMEGA * critical_amplitude(SYMBOLIC), OMEGA, 0)
    assert (
        sp.simplify(limit - critical_amplitude(SYMBOLIC) * OMEGA / sp.cosh(sp.pi * OMEGA / (2 * sp.sqrt(-DELTA)))) == 0
    )


def test_beta_and_gamma_obey_equations_14_and_15():
    r, s, n = sp.symbols("r s n", positive=True)
    assert sp.simplify(sp.beta(r, s).rewrite(sp.gamma) - sp.gamma(r) * sp.gamma(s) / sp.gamma(r + s)) == 0
    assert sp.gammasimp(sp.gamma(n + 1) - n * sp.gamma(n)) == 0


def test_critical_amplitude_obeys_the_scaling_of_the_equation():
    osc = Duffing(alpha=0.3, p=np.array([0.1, 1.0, 2.5]), omega=1.3, delta=-1.7, gamma=0.6)
    unit = osc.dimensionless()
    np.testing.assert_allclose(critical_amplitude(osc) * np.sqrt(0.6) * 1.7**-1.5, critical_amplitude(unit), rtol=1e-13)


@pytest.mark.parametrize(
    "call",
    [
        lambda osc: homoclinic_orbit(osc, 0.0),
        lambda osc: melnikov_function(osc, 0.0),
        lambda osc: melnikov_quadrature(osc, 0.0),
        critical_amplitude,
        least_critical_frequency,
    ],
)
def test_every_formula_refuses_a_potential_without_two_wells(call):
    for osc, name in ((Duffing(delta=1.0), "delta"), (Duffing(gamma=-1.0), "gamma"), (Duffing(delta=0.0), "delta")):
        with pytest.raises(ValueError, match=f"^{name} = .*double well"):
            call(osc)


def test_bad_arguments_of_the_formulas_are_named():
    with pytest.raises(ValueError, match=r"^side = 0"):
        homoclinic_orbit(Duffing(), 0.0, side=0)
    with pytest.raises(ValueError, match=r"^osc has the shape \(2,\)"):
        melnikov_quadrature(Duffing(mu=[0.1, 0.2]), 0.0)
    with pytest.raises(ValueError, match=r"^digits = 0"):
        melnikov_quadrature(Duffing(), 0.0, digits=0)


def test_formulas_return_the_familys_shape_even_for_fields_they_do_not_use():
    family = Duffing(mu=np.zeros((2, 3)))
    assert critical_amplitude(family).shape == (2, 3)
    assert homoclinic_orbit(family, 0.5)[0].shape == (2, 3)
    assert melnikov_function(family, [[[0.1]], [[0.2]]]).shape == (2, 2, 3)
    assert np.shape(critical_amplitude(Duffing())) == ()


def test_times_that_are_not_finite_numbers_are_named():
    for bad in (np.nan, np.inf, "a", None, 1j):
        with pytest.raises(ValueError, match=r"^t = "):
            homoclinic_orbit(Duffing(), bad)
        with pytest.raises(ValueError, match=r"^t0 = "):
            melnikov_function(Duffing(), bad)


def test_a_single_oscillators_numbers_are_pythons_own_and_show_themselves_as_numbers():
    osc = Duffing(alpha=0.25, p=0.6)
    for value in (critical_amplitude(osc), melnikov_function(osc, 0.3)):
        assert type(value) is float
