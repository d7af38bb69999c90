"""The tangency: a second method that shares nothing, exact symmetries and scaling, Melnikov's limit and its order."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from scipy.integrate import odeint
from scipy.optimize import fsolve

from duffing import Duffing, critical_amplitude, melnikov_function
from duffing.errors import ConvergenceError, NoSaddleOrbitError
from duffing.manifolds.correction import tangency_correction
from duffing.manifolds.saddle import saddle_frame
from duffing.manifolds.tangency import _highest, _split, homoclinic_tangency, splitting

PHASES = np.linspace(0, 2 * np.pi, 24, endpoint=False)


def scipy_flow(osc, state, span):
    """State after the time span by SciPy's LSODA, from Eq. 1 written out."""
    alpha, p, mu, omega, delta, gamma = map(float, osc.columns()[:, 0])

    def field(t, y):
        x, v = y
        return [v, mu * math.cos(omega * t) - alpha * math.copysign(abs(v) ** p, v) - (delta + gamma * x * x) * x]

    return odeint(field, state, span, rtol=1e-12, atol=1e-14, tfirst=True, mxstep=10_000)[-1]


def contact(osc, side=1):
    """mu at which W^U and W^S touch in the stroboscopic plane of phase 0, by SciPy alone.

    Unknowns: mu and the places of the point on both curves. Equations: the points are one, the tangents parallel. The
    saddle orbit by fsolve, its directions by numpy's eigenvectors, the first guess from the unperturbed loop, which is
    outermost at omega t0 = side pi/2. Equations of motion with delta = -k^2, times in units of 1/k.
    """
    mu_c, period = critical_amplitude(osc), osc.period
    k, length = np.sqrt(-osc.delta), np.sqrt(-osc.delta / osc.gamma)
    late = side * np.pi / 2 / osc.omega * k  # how long before its outermost point the loop is at phase 0
    forward, backward = (3, 2) if side == -1 else (2, 3)

    @lru_cache
    def saddle(mu):
        forced = replace(osc, mu=mu)
        guess = [-mu / (osc.omega**2 - osc.delta), 0.0]
        state = fsolve(lambda z: scipy_flow(forced, z, (0, period / 2)) + z, guess, xtol=1e-10)
        moved = [[scipy_flow(forced, state + s * 1e-6 * unit, (0, period)) for s in (1, -1)] for unit in np.eye(2)]
        values, vectors = np.linalg.eig(np.transpose([(plus - minus) / 2e-6 for plus, minus in moved]))
        order = np.argsort(-values)
        return forced, state, (vectors / vectors[0]).T[order], values[order]  # x = 1 along both

    def mismatch(unknown):
        forced, state, vectors, _ = saddle(mu_c * unknown[0])
        ends, tangents = [], []
        for place, vector, periods in zip(unknown[1:], vectors, (-forward, backward), strict=True):
            offsets = [side * length * np.exp(place + shift) * vector for shift in (0.0, 1e-4, -1e-4)]
            end, ahead, behind = (scipy_flow(forced, state + offset, (periods * period, 0.0)) for offset in offsets)
            ends.append(end)
            tangents.append((ahead - behind) / np.hypot(*(ahead - behind)))
        return [*(ends[0] - ends[1]), tangents[0][0] * tangents[1][1] - tangents[0][1] * tangents[1][0]]

    # The unperturbed loop leaves and returns as x = 2 sqrt(2) exp(-|t|).
    multipliers = saddle(mu_c)[3]
    place_u = np.log(2 * np.sqrt(2)) - late - forward * np.log(multipliers[0])
    place_s = np.log(2 * np.sqrt(2)) + late + backward * np.log(multipliers[1])
    root, _, flag, message = fsolve(mismatch, [1.0, place_u, place_s], xtol=1e-8, epsfcn=1e-9, full_output=True)
    assert flag == 1, message
    return mu_c * root[0]


@pytest.mark.parametrize(
    "osc",
    [
        Duffing(alpha=0.1, p=1.0),
        Duffing(alpha=0.3, p=2.0),
        Duffing(alpha=0.1, p=1.5, omega=1.3),
        Duffing(alpha=0.05, p=3.0, omega=1.2, delta=-2.0, gamma=0.5),
        Duffing(alpha=0.1, p=0.75),
    ],
)
def test_tangency_equals_the_contact_of_both_curves_found_by_scipy_alone(osc):
    assert homoclinic_tangency(osc) == pytest.approx(contact(osc), rel=1e-7)


def test_left_loops_touch_at_the_same_forcing_as_the_right_ones():
    osc = Duffing(alpha=0.2, p=2.0)
    assert homoclinic_tangency(osc) == pytest.approx(contact(osc, side=-1), rel=1e-7)


def test_prototypes_ratios_are_reproduced():
    """An independent program, before this one, found these ratios of the tangency to Eq. 13 at omega = 1."""
    osc = Duffing(alpha=[0.1, 0.05, 0.025], p=[[1.0], [2.0], [0.5]])
    known = [[1.00041, 1.00010, 1.00003], [0.99857, 0.99964, 0.99991], [0.99698, 0.99849, 0.99926]]
    np.testing.assert_allclose(homoclinic_tangency(osc) / critical_amplitude(osc), known, atol=1e-5)


@pytest.mark.parametrize("p", [0.5, 1.0, 2.0])
def test_splitting_collapses_on_the_melnikov_function_in_the_first_order_of_alpha(p):
    """At fixed mu / alpha, splitting times dH0/dx at the outermost point, over alpha, converges to M(t0) / alpha."""
    alpha = np.array([0.04, 0.02, 0.01, 0.005])
    osc = Duffing(alpha=alpha, p=p, omega=1.3, delta=-2.0, gamma=0.5)
    osc = replace(osc, mu=1.5 * critical_amplitude(osc))
    slope = -osc.delta * np.sqrt(-2 * osc.delta / osc.gamma)
    predicted = melnikov_function(osc, PHASES[:, None] / osc.omega) / alpha
    worst = np.abs(splitting(osc, PHASES) * slope / alpha - predicted).max(axis=0)
    assert worst[-1] < 0.02 * np.abs(predicted).max()
    np.testing.assert_allclose(np.log2(worst[:-1] / worst[1:]), 1.0, atol=0.15)


def test_without_damping_time_reversal_makes_the_splitting_odd():
    osc = Duffing(alpha=0.0, mu=0.1)
    values = splitting(osc, PHASES)
    np.testing.assert_allclose(values, -splitting(osc, -PHASES), atol=1e-9)
    np.testing.assert_allclose(values[[0, 12]], 0.0, atol=1e-9)
    assert values[1:12].min() > 0


def test_reversed_forcing_is_half_a_period():
    osc = Duffing(alpha=0.1, p=0.6, mu=0.1)
    opposite = replace(osc, mu=-0.1)
    np.testing.assert_allclose(splitting(osc, PHASES), splitting(opposite, PHASES + np.pi), atol=1e-9)


@pytest.mark.parametrize("p", [0.6, 1.0, 2.0])
def test_slope_of_the_splitting_is_its_difference_quotient(p):
    frame = saddle_frame(Duffing(alpha=0.2, p=p, mu=0.2, omega=1.4))
    step = 1e-4
    ahead, behind = (_split(frame, PHASES[:, None] + shift)[0] for shift in (step, -step))
    slope = _split(frame, PHASES[:, None])[1]
    np.testing.assert_allclose(slope, (ahead - behind) / (2 * step), atol=1e-5 * np.abs(slope).max())


@pytest.mark.parametrize("p", [0.75, 1.0, 2.0])
def test_splitting_is_negative_all_round_below_the_tangency_and_positive_somewhere_above(p):
    osc = Duffing(alpha=0.1, p=p)
    mu = homoclinic_tangency(osc)
    fine = np.linspace(0, 2 * np.pi, 120)
    below, at, above = splitting(replace(osc, mu=mu * np.array([0.999, 1.0, 1.001])), fine).max(axis=0)
    assert below < 0 < above
    assert at < 1e-8
    touching = splitting(replace(osc, mu=mu), np.linspace(1.5, 1.6, 51)).max()
    assert touching == pytest.approx(
        0.0, abs=0.1 * 0.001**2
    )  # between two phases the maximum is missed by its curvature


@pytest.mark.parametrize("p", [1.0, 2.0, 3.0])
def test_correction_is_of_order_alpha_squared_for_smooth_damping(p):
    osc = Duffing(alpha=np.array([0.01, 0.02, 0.04]), p=p)
    excess = np.abs(homoclinic_tangency(osc) / critical_amplitude(osc) - 1)
    np.testing.assert_allclose(np.log2(excess[1:] / excess[:-1]), 2.0, atol=0.01)


@pytest.mark.parametrize(("p", "omega"), [(0.5, 1.0), (0.75, 1.0), (0.5, 3.0)])
def test_correction_for_p_below_1_is_the_excess_of_friction_near_the_saddle_orbit(p, omega):
    """What is left beyond the term alpha^(1+p), which varies with log(alpha), is of order alpha^2.

    Divided by alpha^2 it stays, while the whole grows as alpha^(p-1).
    """
    osc = Duffing(alpha=np.array([5e-4, 1e-3, 2e-3, 4e-3]), p=p, omega=omega)
    excess, theory = homoclinic_tangency(osc) / critical_amplitude(osc) - 1, tangency_correction(osc)
    rest, whole = (excess - theory) / osc.alpha**2, excess / osc.alpha**2
    assert np.abs(rest).max() < 0.3 * np.abs(whole[0])
    assert np.ptp(rest) < 0.3 * np.ptp(whole)


def test_correction_repeats_when_log_alpha_grows_by_the_period():
    alpha, omega, p = 1e-3, 3.0, 0.5
    osc = Duffing(alpha=alpha * np.exp(np.pi / omega * np.array([0.0, 0.5, 1.0])), p=p, omega=omega)
    coefficient = tangency_correction(osc) / osc.alpha ** (1 + p)
    assert coefficient[2] == pytest.approx(coefficient[0], rel=1e-3)
    assert abs(coefficient[1] / coefficient[0] - 1) > 0.02


def test_scaling_carries_tangency_and_splitting_over_exactly():
    osc = Duffing(alpha=0.12, p=1.4, mu=0.3, omega=1.6, delta=-2.0, gamma=0.5)
    unit = osc.dimensionless()
    assert homoclinic_tangency(osc) == pytest.approx(2**1.5 / 0.5**0.5 * homoclinic_tangency(unit), rel=1e-9)
    np.testing.assert_allclose(splitting(osc, PHASES), 2.0 * splitting(unit, PHASES), rtol=1e-9)


def test_family_and_phases_give_the_documented_shapes_and_each_member_its_own():
    osc = Duffing(alpha=np.array([0.05, 0.1]), p=np.array([[0.8], [1.0], [2.0]]), mu=0.1, omega=1.1)
    together, tangency = splitting(osc, [0.5, 1.5]), homoclinic_tangency(osc)
    assert together.shape == (2, 3, 2)
    assert splitting(osc, 0.5).shape == tangency.shape == (3, 2)
    one = Duffing(alpha=0.1, p=0.8, mu=0.1, omega=1.1)
    assert splitting(one, 0.5).shape == homoclinic_tangency(one).shape == ()
    np.testing.assert_allclose(together[:, 0, 1], splitting(one, [0.5, 1.5]), rtol=1e-8)
    assert homoclinic_tangency(one) == pytest.approx(tangency[0, 1], rel=1e-7)


def test_bad_input_and_missing_saddle_orbits_are_named():
    with pytest.raises(ValueError, match=r"alpha = 0\.0: must be > 0"):
        homoclinic_tangency(Duffing(alpha=0.0))
    with pytest.raises(ValueError, match="gamma = -1"):
        homoclinic_tangency(Duffing(gamma=-1.0))
    with pytest.raises(ValueError, match="phase has shape"):
        splitting(Duffing(mu=0.1), [[0.0, 1.0]])
    with pytest.raises(ValueError, match="phase = nan"):
        splitting(Duffing(mu=0.1), float("nan"))
    with pytest.raises(ValueError, match=r"p = 1\.0"):
        tangency_correction(Duffing(p=1.0))
    with pytest.raises(NoSaddleOrbitError, match="sticks"):
        splitting(Duffing(alpha=0.1, p=0.1, mu=0.05), 0.0, method="manifolds")
    with pytest.raises((NoSaddleOrbitError, ConvergenceError), match=r"alpha = 0\.1, p = 0\.1"):
        homoclinic_tangency(Duffing(alpha=0.1, p=0.1), method="manifolds")


def test_splitting_is_smooth_where_newtons_steps_alone_would_go_to_and_fro():
    """Along W^S at p = 0.4 the time of the crossing bends sharply there: from either side Newton's step overshoots."""
    phase = np.linspace(4.44, 4.56, 13)
    values = splitting(Duffing(alpha=0.1, p=0.4, mu=0.11306543), phase, method="manifolds")
    slopes = np.diff(values) / np.diff(phase)
    assert np.abs(np.diff(slopes)).max() < 0.3 * np.abs(slopes).max()


def test_the_greatest_splitting_among_launches_all_round_is_that_over_all_phases():
    osc = Duffing(alpha=0.1, p=0.75, mu=0.12)
    (height,), phase = _highest(saddle_frame(osc))
    around = splitting(osc, PHASES)
    assert around.min() < 0 < height
    assert height == pytest.approx(around.max(), rel=0.02)
    assert splitting(osc, phase) == pytest.approx(height, rel=1e-6)
