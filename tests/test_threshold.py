"""The tangency by forward orbits: against W^S followed backward, SciPy alone, dry friction, and under scaling."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import odeint, solve_ivp
from scipy.optimize import brentq, minimize_scalar

from book.studies import dry_friction
from book.studies.dry_friction import dry_friction_tangency
from duffing import Duffing, critical_amplitude, homoclinic_tangency, splitting, trajectory
from duffing.errors import ConvergenceError, NoSaddleOrbitError
from duffing.manifolds.passage import forward_frame, overshoot
from duffing.manifolds.saddle import saddle_orbit
from duffing.manifolds.sticking import sticking_amplitude
from duffing.manifolds.threshold import caught, highest, threshold

PHASES = np.linspace(0, 2 * np.pi, 9)


def scipy_states(osc, state, t):
    """(x, v) at the times t by SciPy's LSODA, which turns stiff in a creep, from Eq. 1 written out."""
    alpha, p, mu, omega, delta, gamma = map(float, osc.columns()[:, 0])

    def field(t, y):
        x, v = y
        return [v, mu * math.cos(omega * t) - alpha * math.copysign(abs(v) ** p, v) - (delta + gamma * x * x) * x]

    return odeint(field, state, t, rtol=1e-10, atol=1e-13, tfirst=True, mxstep=100_000)


def scipy_height(osc, x, v):
    """exp(-t), t from the turn in the right well to when the orbit from (x, v) at phase 0 next leaves a well's bottom
    outwards; positive if that is the left well."""
    well, far = math.sqrt(-osc.delta / osc.gamma), 40 / math.sqrt(-osc.delta)
    t = np.arange(0, far, far / 300)
    x, v = scipy_states(osc, (x, v), t).T
    turn = np.flatnonzero((v[:-1] > 0) & (v[1:] <= 0) & (x[1:] > well))
    if turn.size == 0:
        return 0.0
    inside = turn[0] + np.flatnonzero(np.abs(x[turn[0] :]) < well)[:1]
    out = np.flatnonzero(np.abs(x[inside[0] :]) > well) if inside.size else inside
    if out.size == 0:
        return 0.0
    k = inside[0] + out[0]
    when = t[k - 1] + (t[k] - t[k - 1]) * (well - abs(x[k - 1])) / (abs(x[k]) - abs(x[k - 1]))
    return -math.copysign(math.exp((t[turn[0]] - when) * math.sqrt(-osc.delta)), x[k])


def scipy_contact(osc):
    """mu at which the first orbit of W^U goes over the hump, by SciPy alone, everything forward in time.

    The saddle orbit is what starts two periods before at the x that parts leaving to the right from leaving to the
    left, found by bisection. Positions beside it are as good as W^U once the flow has contracted what they miss it by.
    """
    period, well = osc.period, math.sqrt(-osc.delta / osc.gamma)

    def greatest(mu):
        forced = replace(osc, mu=mu)
        low, high = -0.3 * well, 0.3 * well
        t = np.linspace(-2 * period, 0, 65)
        while high - low > 1e-15:
            middle = (low + high) / 2
            states = scipy_states(forced, (middle, 0.0), np.append(t, t[1:] + 2 * period))
            left = states[np.flatnonzero(np.abs(states[:, 0]) > 0.6 * well)[:1], 0]
            if left.size == 0 or middle in (low, high):
                break
            low, high = (low, middle) if left[0] > 0 else (middle, high)
        x, v = states[64]
        image = scipy_states(forced, (x + 1e-4 * well, v), [0, period])[-1, 0]
        stretch = (image - x) / (1e-4 * well)

        def depth(place):
            return -scipy_height(forced, x + 1e-4 * well * stretch**place, v)

        places = np.linspace(0, 1, 33)
        best = places[np.argmin([depth(place) for place in places])]
        beside = best - places[1], best + places[1]
        return -minimize_scalar(depth, bounds=beside, method="bounded", options={"xatol": 1e-6}).fun

    mu_c = float(critical_amplitude(osc))
    return brentq(greatest, 0.97 * mu_c, mu_c, xtol=1e-9 * mu_c)


@pytest.mark.parametrize(
    "osc", [Duffing(alpha=0.1, p=0.1), Duffing(alpha=0.06, p=0.3, omega=1.6, delta=-2.0, gamma=0.5)]
)
def test_tangency_at_small_p_equals_the_first_orbit_over_the_hump_found_by_scipy_alone(osc):
    assert homoclinic_tangency(osc) == pytest.approx(scipy_contact(osc), rel=1e-7)


def test_both_methods_agree_where_both_answer():
    osc = Duffing(alpha=[[0.05], [0.2]], p=[0.5, 0.75, 1.0, 2.0], omega=1.3, delta=-2.0, gamma=0.5)
    tangency = homoclinic_tangency(osc, method="manifolds")
    np.testing.assert_allclose(homoclinic_tangency(osc, method="threshold"), tangency, rtol=1e-9)
    forced = replace(osc, mu=1.2 * tangency)
    backward = splitting(forced, PHASES, method="manifolds")
    np.testing.assert_allclose(splitting(forced, PHASES, method="threshold"), backward, atol=1e-10)


def test_each_member_of_a_family_of_both_methods_gets_its_own():
    osc = Duffing(alpha=0.1, p=[[0.15], [1.0], [0.4]], omega=[1.0, 1.4], mu=0.12)
    tangency, split = homoclinic_tangency(osc), splitting(osc, 1.0)
    assert tangency.shape == split.shape == (3, 2)
    for k in np.ndindex(3, 2):
        one = Duffing(alpha=0.1, p=float(osc.p[k[0], 0]), omega=float(osc.omega[k[1]]), mu=0.12)
        assert homoclinic_tangency(one) == pytest.approx(tangency[k], rel=1e-9)
        assert splitting(one, 1.0) == pytest.approx(split[k], abs=1e-10)


def test_prototypes_ratios_at_small_p_are_reproduced():
    """An independent program, before this one, found these ratios of the tangency to Eq. 13 at omega = 1."""
    osc = Duffing(alpha=0.1, p=[0.1, 0.2])
    np.testing.assert_allclose(homoclinic_tangency(osc) / critical_amplitude(osc), [0.97931, 0.98576], atol=1e-5)


@pytest.mark.parametrize(("p", "alpha"), [(0.05, 0.1), (0.1, 0.01), (0.1, 0.2), (0.3, 0.1)])
def test_splitting_is_negative_all_round_below_the_tangency_and_positive_somewhere_above_at_small_p(p, alpha):
    osc = Duffing(alpha=alpha, p=p)
    mu = homoclinic_tangency(osc)
    low, high = splitting(replace(osc, mu=mu * np.array([1 - 1e-3, 1 + 1e-3])), np.linspace(0, 6.2, 100)).max(axis=0)
    assert low < 0 < high
    assert highest(forward_frame(replace(osc, mu=mu * (1 - 1e-8))))[0] < 0
    assert highest(forward_frame(replace(osc, mu=mu * (1 + 1e-8))))[0] > 0


@pytest.mark.parametrize("p", [0.05, 0.2, 1.0])
def test_orbits_just_below_the_threshold_fall_back_and_just_above_it_go_over(p):
    """Also at p = 0.05, where the saddle orbit of this forcing sticks."""
    osc = Duffing(alpha=0.1, p=p, mu=0.09)
    x = threshold(forward_frame(osc), PHASES, np.zeros(PHASES.size, dtype=int))
    for phase, x_s in zip(PHASES, x, strict=True):
        for shift, side in ((-1e-10, 1), (1e-10, -1)):
            path = trajectory(osc, (x_s + shift, 0.0), phase + np.linspace(0, 80, 800), rtol=1e-12, atol=1e-14)[0]
            path = path[np.argmax(path < 0.5) :]
            assert path[np.argmax(np.abs(path) > 0.9)] * side > 0.9


def test_threshold_is_answered_where_the_saddle_orbit_sticks():
    osc = Duffing(alpha=0.1, p=0.05, mu=0.09)
    assert sticking_amplitude(osc) > osc.mu
    with pytest.raises(NoSaddleOrbitError, match="sticks"):
        saddle_orbit(osc)
    assert splitting(osc, PHASES).max() < 0
    low, high = caught(osc, 1.0)
    x_s = threshold(forward_frame(osc), np.array([1.0]), np.array([0]))[0]
    assert high - low < 1e-10
    assert x_s == pytest.approx(low, abs=1e-10)


def test_hump_catches_an_interval_under_weak_force_and_lets_it_go_in_time():
    osc = Duffing(alpha=0.2, p=0.1, mu=0.08, delta=-2.0, gamma=0.5)
    with pytest.raises(NoSaddleOrbitError, match="interval of positions is caught"):
        splitting(osc, 0.0)
    short, long = (np.diff(caught(osc, 1.0, periods))[0] for periods in (5, 20))
    assert 1e-5 < long < short < 0.1


def test_overshoot_orders_the_orbits_and_vanishes_at_the_threshold():
    frame = forward_frame(Duffing(alpha=0.1, p=0.1, mu=0.12))
    x_s = threshold(frame, np.array([0.7]), np.array([0]))[0]
    x = x_s + np.array([-1e-2, -1e-3, -1e-5, -1e-8, 0.0, 1e-8, 1e-5, 1e-3, 1e-2])
    value, near = overshoot(frame, x, np.full(x.size, 0.7), np.zeros(x.size, dtype=int))
    assert np.all(np.diff(value) > 0)
    assert abs(value[4]) < 1e-11 and near[4]


def test_scaling_carries_the_small_exponents_over():
    osc = Duffing(alpha=0.12, p=0.15, mu=0.4, omega=1.6, delta=-2.0, gamma=0.5)
    unit = osc.dimensionless()
    assert homoclinic_tangency(osc) == pytest.approx(2**1.5 / 0.5**0.5 * homoclinic_tangency(unit), rel=1e-9)
    np.testing.assert_allclose(splitting(osc, PHASES), 2.0 * splitting(unit, PHASES), atol=1e-10)
    np.testing.assert_allclose(caught(osc, 0.5), 2.0 * caught(unit, 0.5), rtol=1e-12)


def test_reversed_forcing_is_half_a_period_at_small_p():
    osc = Duffing(alpha=0.1, p=0.1, mu=0.13)
    opposite = splitting(replace(osc, mu=-0.13), PHASES + np.pi)
    np.testing.assert_allclose(splitting(osc, PHASES), opposite, atol=1e-10)


def test_tangency_tends_to_that_of_dry_friction():
    """mu_t / mu_c = that of p = 0 + a p + b p^2: three small exponents give it."""
    p = np.array([0.005, 0.01, 0.02])
    osc = Duffing(alpha=0.1, p=p)
    limit = np.polyfit(p, homoclinic_tangency(osc) / critical_amplitude(osc), 2)[-1]
    assert limit == pytest.approx(dry_friction_tangency(0.1), abs=2e-6)


def test_stops_of_dry_friction_are_those_that_scipys_events_find():
    alpha, mu, omega = 0.1, 0.155, 1.2
    x, t = -0.03, -1.0
    for _ in range(6):
        stop = dry_friction.next_stop(alpha, mu, omega, x, t)
        force = x - x**3 + mu * np.cos(omega * t)
        if abs(force) <= alpha:
            fine = t + np.linspace(0, 2 * np.pi / omega, 200_001)
            pull = x - x**3 + mu * np.cos(omega * fine)
            k = np.argmax(np.abs(pull) > alpha)
            force, spring = pull[k], x - x**3
            t = brentq(lambda t, spring=spring: abs(spring + mu * np.cos(omega * t)) - alpha, *fine[k - 1 : k + 1])
        side = np.sign(force)

        def slope(t, y, side=side):
            return y[1], y[0] - y[0] ** 3 + mu * np.cos(omega * t) - side * alpha

        def velocity(t, y):
            return y[1]

        velocity.terminal, velocity.direction = True, -side
        way = solve_ivp(
            slope, (t, t + 50), (x, 0.0), "DOP853", events=velocity, rtol=1e-12, atol=1e-14, first_step=1e-3
        )
        np.testing.assert_allclose(stop, (way.y[0, -1], way.t[-1]), atol=1e-9)
        x, t = stop


def test_what_has_no_answer_is_named():
    with pytest.raises(ValueError, match="method = 'backward'"):
        homoclinic_tangency(Duffing(), method="backward")
    with pytest.raises(ValueError, match="delta = 1"):
        splitting(Duffing(p=0.1, mu=0.1, delta=1.0), 0.0)
    with pytest.raises(ValueError, match=r"alpha = 0\.0: must be > 0"):
        homoclinic_tangency(Duffing(p=0.1, alpha=0.0))
    with pytest.raises(NoSaddleOrbitError, match=r"p = 0\.1, mu = 0\.05.*interval of positions is caught"):
        splitting(Duffing(alpha=0.1, p=0.1, mu=[0.15, 0.05]), 0.0)
    with pytest.raises(NoSaddleOrbitError, match="at rest at mu = 0"):
        splitting(Duffing(alpha=0.1, p=0.1), 0.0)
    with pytest.raises((ConvergenceError, NoSaddleOrbitError), match=r"p = 0\.1"):
        homoclinic_tangency(Duffing(alpha=0.1, p=0.1), method="manifolds")
    with pytest.raises(ValueError, match="periods = 0"):
        caught(Duffing(p=0.1, mu=0.05), 0.0, periods=0)
    with pytest.raises(ConvergenceError, match=r"alpha = 5\.0, omega = 1\.0: no tangency"):
        dry_friction_tangency(5.0)
