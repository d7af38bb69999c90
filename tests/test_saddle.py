"""The saddle orbit, against SciPy's integrator, exact eigenvalues, exact scaling; and where it sticks."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from duffing import Duffing, NoSaddleOrbitError, critical_amplitude
from duffing.manifolds.saddle import saddle_orbit
from duffing.manifolds.shooting import central_orbit, linear_response
from duffing.manifolds.sticking import sticking_amplitude

CASES = [
    Duffing(alpha=0.1, p=1.0, mu=0.08),
    Duffing(alpha=0.3, p=2.0, mu=0.15, omega=1.4, delta=-2.0, gamma=3.0),
    Duffing(alpha=0.2, p=0.6, mu=0.2, omega=0.9, delta=-1.5, gamma=0.4),
    Duffing(alpha=0.1, p=0.5, mu=-0.1),
]


def carried(osc, state, time):
    """States (2, n) after the time by SciPy's DOP853, from the states (2, n) at phase 0."""

    def field(t, y):
        return [y[1], osc.acceleration(y[0], y[1], t)]

    runs = [solve_ivp(field, (0, time), y, method="DOP853", rtol=1e-12, atol=1e-14) for y in np.transpose(state)]
    assert all(run.success for run in runs)
    return np.transpose([run.y[:, -1] for run in runs])


def friction_time_by_scipy(osc, state, time):
    """State and friction time after the time, by SciPy's Radau in friction time itself: x, Y = sign(v) |v|^p and t.

    The friction time is infinite (10 000), with the time reached instead of a state, where the time is never reached.
    """
    x, v = state

    def field(s, y):
        pace = abs(y[1]) ** (1 / osc.p - 1) / osc.p
        velocity = np.sign(y[1]) * abs(y[1]) ** (1 / osc.p)
        return [pace * velocity, osc.force(y[0], y[2]) - osc.alpha * y[1], pace]

    def arrival(s, y):
        return y[2] - time

    arrival.terminal = True
    start = [x, np.sign(v) * abs(v) ** osc.p, 0.0]
    run = solve_ivp(field, (0, 1e4), start, method="Radau", rtol=1e-9, atol=1e-12, events=arrival)
    if not run.y_events[0].size:
        return run.y[2, -1], np.inf
    x, damping, _ = run.y_events[0][0]
    return np.array([x, np.sign(damping) * abs(damping) ** (1 / osc.p)]), run.t_events[0][0]


@pytest.mark.parametrize("osc", CASES)
def test_saddle_orbit_closes_after_a_period_and_is_its_own_mirror_image_after_half(osc):
    state = saddle_orbit(osc).state
    ends = [carried(osc, state[:, None], part * osc.period)[:, 0] for part in (0.5, 1.0)]
    np.testing.assert_allclose(ends[0], -state, atol=1e-9)
    np.testing.assert_allclose(ends[1], state, atol=1e-8)  # an error of 1e-11 grows by the multiplier, up to 500


@pytest.mark.parametrize("osc", CASES)
def test_directions_and_multipliers_are_those_of_the_stroboscopic_map(osc):
    """The map's derivative by differences of SciPy's solutions, whose error the unstable multiplier amplifies. It hides
    what becomes of the stable vector: that one is carried backward, by the inverse.
    """
    orbit = saddle_orbit(osc)
    step = 1e-6
    moved = orbit.state[:, None] + step * np.array([[1, 0, -1, 0], [0, 1, 0, -1]])
    ends = carried(osc, moved, osc.period)
    derivative = (ends[:, :2] - ends[:, 2:]) / (2 * step)
    unstable, stable = orbit.multipliers
    np.testing.assert_allclose(derivative @ orbit.unstable, unstable * orbit.unstable, rtol=1e-4, atol=1e-4 * unstable)
    assert unstable == pytest.approx(np.trace(derivative), rel=1e-4)  # the other one is a thousandth or less
    back = np.linalg.solve(derivative, orbit.stable)
    np.testing.assert_allclose(back / np.hypot(*back), orbit.stable, atol=1e-4)
    assert 0 < stable < 1 < unstable
    assert min(orbit.unstable[0], orbit.stable[0]) > 0


@pytest.mark.parametrize("omega", [0.1, 0.5, 1.0, 3.0])
def test_linear_damping_makes_the_product_of_the_multipliers_exp_minus_alpha_T(omega):
    osc = Duffing(alpha=np.array([0.0, 0.05, 0.1, 0.4]), mu=0.1, omega=omega)
    logarithms = np.log(saddle_orbit(osc).multipliers).sum(axis=0)
    np.testing.assert_allclose(logarithms, -osc.alpha * osc.period, atol=1e-12 * osc.period)


@pytest.mark.parametrize("p", [1.0, 2.0])
def test_without_forcing_the_saddle_point_has_the_exact_eigenvalues_and_eigenvectors(p):
    osc = Duffing(alpha=0.3, p=p, mu=0.0, omega=1.3, delta=-2.0, gamma=0.5)
    damping = 0.3 if p == 1.0 else 0.0  # |v| v has no linear part
    exponents = -damping / 2 + np.array([1, -1]) * np.sqrt(damping**2 / 4 + 2.0)
    orbit = saddle_orbit(osc)
    np.testing.assert_array_equal(orbit.state, [0.0, 0.0])
    np.testing.assert_allclose(orbit.multipliers, np.exp(exponents * osc.period), rtol=1e-9)
    for vector, exponent in zip((orbit.unstable, orbit.stable), exponents, strict=True):
        np.testing.assert_allclose(vector, np.array([1, exponent]) / np.hypot(1, exponent), rtol=1e-9)


def test_weak_forcing_gives_the_linear_response():
    osc = Duffing(alpha=0.2, mu=1e-4, omega=1.3, delta=-2.0, gamma=3.0)
    response = osc.mu / (osc.delta - osc.omega**2 + 1j * osc.omega * osc.alpha)
    exact = np.array([response.real, (1j * osc.omega * response).real])
    np.testing.assert_allclose(saddle_orbit(osc).state, exact, rtol=1e-7)  # the cubic force is a 1e-9 of the linear one


def test_guess_balances_the_energy_of_the_power_law():
    """Over a period of the guess, forcing gives what the damping itself, not its equivalent, takes."""
    osc = Duffing(alpha=[0.1, 0.4], p=[0.3, 2.0], mu=[0.1, -0.3], omega=[1.0, 0.7])
    t = np.linspace(0, 1, 20_000, endpoint=False)[:, None] * osc.period
    _, v = linear_response(osc, t)
    given, taken = (v * osc.mu * np.cos(osc.omega * t)).mean(axis=0), (v * osc.damping(v)).mean(axis=0)
    np.testing.assert_allclose(given, taken, rtol=1e-5)


def test_scaling_carries_the_saddle_orbit_over_exactly():
    osc = CASES[1]
    orbit, unit = saddle_orbit(osc), saddle_orbit(osc.dimensionless())
    scale = np.array([np.sqrt(2 / 3), np.sqrt(2 / 3) * np.sqrt(2)])
    np.testing.assert_allclose(orbit.state, scale * unit.state, rtol=1e-12)
    np.testing.assert_allclose(orbit.multipliers, unit.multipliers, rtol=1e-12)


def test_family_gives_each_member_its_own_orbit():
    family = Duffing(alpha=np.array([0.05, 0.1]), p=np.array([[0.5], [1.0], [2.0]]), mu=0.07, omega=1.2)
    together = saddle_orbit(family)
    assert together.state.shape == together.unstable.shape == together.multipliers.shape == (2, 3, 2)
    for index in np.ndindex(3, 2):
        one = saddle_orbit(Duffing(alpha=family.alpha[index[1]], p=family.p[index[0], 0], mu=0.07, omega=1.2))
        for field, alone in zip(together, one, strict=True):
            np.testing.assert_allclose(field[(slice(None), *index)], alone, rtol=1e-10, atol=1e-14)


def friction_time_of_half_a_period(osc):
    """Of the orbit near x = 0 of oscillators with delta = -1, gamma = 1: (N,), infinite where it sticks."""
    return central_orbit(osc.members())[0].friction_time.sum(axis=0)


@pytest.mark.parametrize(("p", "alpha"), [(0.1, 0.1), (0.3, 0.1), (0.75, 0.4)])
def test_friction_time_equals_scipys_where_the_orbit_creeps(p, alpha):
    osc = Duffing(alpha=alpha, p=p)
    osc = replace(osc, mu=float(critical_amplitude(osc)))
    orbit = saddle_orbit(osc)
    end, half = friction_time_by_scipy(osc, orbit.state, osc.period / 2)
    np.testing.assert_allclose(end, -orbit.state, atol=1e-8)
    assert friction_time_of_half_a_period(osc) == pytest.approx(half, rel=1e-6)
    assert np.log(orbit.multipliers).sum() == pytest.approx(-osc.alpha * 2 * half, rel=1e-6)


@pytest.mark.parametrize("p", [0.1, 0.25, 0.4])
def test_sticking_amplitude_grows_as_alpha_to_the_1_over_1_minus_p(p):
    """x = alpha^(1/(1-p)) X takes alpha out of the equation where the cubic force is negligible."""
    weak = Duffing(alpha=np.array([1e-3, 2e-3]), p=p)
    amplitude = sticking_amplitude(weak)
    assert amplitude[1] / amplitude[0] == pytest.approx(2 ** (1 / (1 - p)), rel=3e-4)


def test_saddle_orbit_sticks_below_the_sticking_amplitude_and_nowhere_above():
    osc = Duffing(alpha=0.1, p=0.2, omega=1.1, delta=-2.0, gamma=3.0)
    threshold = sticking_amplitude(osc)
    below, above = replace(osc, mu=0.95 * threshold), replace(osc, mu=1.5 * threshold)
    with pytest.raises(NoSaddleOrbitError, match=r"alpha = 0.1, p = 0.2, .*it sticks"):
        saddle_orbit(below)
    assert friction_time_of_half_a_period(below.dimensionless()) == np.inf
    # SciPy in friction time never gets past the zero of the force, at about a quarter of a period.
    unit = below.dimensionless().members()
    start = central_orbit(unit)[0].states[:, 0, 0]
    reached, friction_time = friction_time_by_scipy(below.dimensionless(), start, unit.period[0] / 2)
    assert friction_time == np.inf
    assert 0.2 < reached / unit.period[0] < 0.3
    mirrored = friction_time_of_half_a_period(replace(above, mu=-above.mu).dimensionless())
    np.testing.assert_allclose(mirrored, friction_time_of_half_a_period(above.dimensionless()), rtol=1e-8)
    assert 0 < saddle_orbit(above).multipliers[1] < 1


def test_orbit_never_sticks_for_p_above_one_half():
    osc = Duffing(alpha=[0.1, 0.4, 0.0], p=[0.6, 1.0, 0.3])
    np.testing.assert_array_equal(sticking_amplitude(osc), 0.0)
    forced = replace(osc, alpha=[0.1, 0.4, 0.1], p=[0.6, 1.0, 0.51], mu=0.01)
    assert np.all(np.isfinite(friction_time_of_half_a_period(forced)))


@pytest.mark.parametrize(
    ("osc", "reason"),
    [
        (Duffing(alpha=0.1, p=0.5, mu=0.0), "at rest at mu = 0"),
        (
            Duffing(alpha=0.1, mu=[0.1, 0.6], omega=0.1),
            r"mu = 0.6, omega = 0.1.*1 such",
        ),  # pulled over the potential's hill
        (Duffing(alpha=0.4, p=0.05, mu=0.61), "all but sticks"),
    ],
)
def test_missing_saddle_orbit_is_a_named_error_with_the_reason(osc, reason):
    with pytest.raises(NoSaddleOrbitError, match=reason):
        saddle_orbit(osc)


@pytest.mark.parametrize("function", [saddle_orbit, sticking_amplitude])
def test_single_well_is_refused(function):
    with pytest.raises(ValueError, match=r"delta = 1\.0"):
        function(Duffing(delta=1.0, mu=0.1))


def test_marginal_exponent_is_refused_for_the_sticking_amplitude():
    with pytest.raises(ValueError, match=r"p = 0\.5"):
        sticking_amplitude(Duffing(p=0.5))
