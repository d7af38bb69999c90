"""The tangency by forward orbits: against W^S followed backward, SciPy alone, dry friction, and under scaling."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve, minimize_scalar

from book.studies import dry_friction
from book.studies.dry_friction import dry_friction_tangency
from duffing import Duffing, critical_amplitude, homoclinic_tangency, splitting, trajectory
from duffing.errors import ConvergenceError, NoSaddleOrbitError
from duffing.manifolds import threshold as tangency_by_threshold
from duffing.manifolds.passage import forward_frame, overshoot
from duffing.manifolds.saddle import saddle_orbit
from duffing.manifolds.sticking import sticking_amplitude
from duffing.manifolds.threshold import caught, highest, threshold

PHASES = np.linspace(0, 2 * np.pi, 9)


def scipy_orbit(osc, x, w, t, event):
    """(x, w, t) where the event next rises through zero, w = sign(v) |v|^p, by SciPy alone.

    Eq. 1 in s, dt/ds = phi / (1 + phi) with phi = dv/dw: a creep through v = 0 is too singular for x and v in time.
    """
    alpha, p, mu, omega, delta, gamma = map(float, osc.columns()[:, 0])

    def slope(s, y):
        x, w, t = y
        speed = min(abs(w), 2.0) ** (1 / p - 1)  # in trials only w is as large as that
        phi = speed / p + 1e-9  # the small part lets time go on where F = 0 in a creep
        force = mu * math.cos(omega * t) - (delta + gamma * x * x) * x
        return np.array([phi * speed * w, force - alpha * w, phi]) / (1 + phi)

    def ends(s, y):
        return event(*y)

    ends.terminal, ends.direction = True, 1
    way = solve_ivp(slope, (0, 1e300), (x, w, t), "LSODA", events=ends, rtol=1e-11, atol=1e-14)
    assert way.status == 1, way.message
    return way.y[:, -1]


def scipy_height(osc, x, w):
    """exp(-t), t from the turn in the right well to when the orbit from (x, w) at phase pi/2 next leaves a well's
    bottom outwards; positive if that is the left well. In units of sqrt(-delta)."""
    well, unit = math.sqrt(-osc.delta / osc.gamma), 1 / math.sqrt(-osc.delta)
    out = scipy_orbit(osc, x, w, osc.period / 4, lambda x, w, t: x - well)
    turn = scipy_orbit(osc, *out, lambda x, w, t: -w)
    end = scipy_orbit(osc, *turn, lambda x, w, t: max(abs(x) - well if w * x > 0 else -1.0, t - turn[2] - 50 * unit))
    return -math.copysign(math.exp((turn[2] - end[2]) / unit), end[0])


def scipy_highest(osc):
    """The greatest height of W^U over the hump by SciPy alone, everything forward in time.

    The saddle orbit is a fixed point of half a period and the mirror, found by fsolve where it is fast, a quarter of a
    period on. Positions beside it are as good as W^U once the flow has contracted what they miss it by.
    """
    period, well = osc.period, math.sqrt(-osc.delta / osc.gamma)

    def half(state):
        return scipy_orbit(osc, *state, period / 4, lambda x, w, t: t - 0.75 * period)[:2]

    fast = (osc.omega * osc.mu / (osc.omega**2 - osc.delta)) ** osc.p
    (x, w), _, found, message = fsolve(lambda z: half(z) + z, (0.0, fast), xtol=1e-11, epsfcn=1e-9, full_output=True)
    assert found == 1, message
    near = 1e-6 * well
    image = -half(-half((x + near, w)))  # the mirror twice
    stretch = (image[0] - x) / near

    def depth(place):
        return -scipy_height(osc, x + near * stretch**place, w)

    places = np.linspace(0, 1, 25)
    best = places[np.argmin([depth(place) for place in places])]
    beside = best - places[1], best + places[1]
    return -minimize_scalar(depth, bounds=beside, method="bounded", options={"xatol": 1e-6}).fun


@pytest.mark.parametrize(
    "osc",
    [
        Duffing(alpha=0.1, p=0.1),
        Duffing(alpha=0.3, p=0.2, omega=1.6, delta=-2.0, gamma=0.5),
        Duffing(alpha=0.16, p=0.1, omega=1.175),  # some orbits of W^U come to rest in the well
    ],
)
def test_tangency_at_small_p_is_where_the_first_orbit_goes_over_the_hump_by_scipy_alone(osc):
    """A bisection's last bracket: at 1e-7 below no orbit of W^U goes over, at 1e-7 above one does."""
    mu = homoclinic_tangency(osc)
    below, above = (scipy_highest(replace(osc, mu=mu * (1 + shift))) for shift in (-1e-7, 1e-7))
    assert below < 0 < above < 1e-5


def test_both_methods_agree_where_both_answer():
    osc = Duffing(alpha=[[0.05], [0.2]], p=[0.5, 0.75, 1.0, 2.0], omega=1.3, delta=-2.0, gamma=0.5)
    tangency = homoclinic_tangency(osc, method="manifolds")
    np.testing.assert_allclose(homoclinic_tangency(osc, method="threshold"), tangency, rtol=1e-9)
    forced = replace(osc, mu=1.2 * tangency)
    backward = splitting(forced, PHASES, method="manifolds")
    np.testing.assert_allclose(splitting(forced, PHASES, method="threshold"), backward, atol=1e-10)


def test_both_methods_agree_at_low_frequencies():
    """Over a period distances grow by up to exp(24): launches on W^U stay near the saddle orbit all round.

    At omega = 0.25 the splitting at a phase suffers from rounding (see _NEAREST); its greatest value does not.
    """
    osc = Duffing(alpha=0.1, p=[0.5, 0.5, 1.0], omega=[0.35, 0.3, 0.25])
    tangency = homoclinic_tangency(osc, method="manifolds")
    np.testing.assert_allclose(homoclinic_tangency(osc, method="threshold"), tangency, rtol=1e-9)
    forced = replace(osc, mu=1.2 * tangency)
    backward, error = splitting(forced, PHASES, method="manifolds"), np.array([1e-7, 1e-7, 2e-6])
    assert np.all(np.abs(splitting(forced, PHASES, method="threshold") - backward) < error)
    with pytest.raises(ConvergenceError, match=r"omega = 0\.2,.*leave the saddle orbit by a factor"):
        homoclinic_tangency(Duffing(alpha=0.1, p=1.0, omega=0.2), method="threshold")


def test_tangency_at_small_p_is_below_the_formula_by_under_a_per_cent_at_low_frequencies():
    """The values were found with launches at a smaller distance from the saddle orbit."""
    osc = Duffing(alpha=0.1, p=0.1, omega=[0.3, 0.32])
    np.testing.assert_allclose(
        homoclinic_tangency(osc) / critical_amplitude(osc) - 1, [-0.0086208, -0.0070976], atol=2e-6
    )


def test_jump_of_the_splitting_is_no_tangency(monkeypatch):
    osc = Duffing(alpha=0.1, p=0.1)
    jump = 0.99 * critical_amplitude(osc)
    monkeypatch.setattr(tangency_by_threshold, "highest", lambda frame: np.where(frame.osc.mu > jump, 1e-3, -1e-3))
    with pytest.raises(ConvergenceError, match=r"p = 0\.1.*the splitting jumps instead of vanishing"):
        homoclinic_tangency(osc)


def test_each_member_of_a_family_of_both_methods_gets_its_own():
    osc = Duffing(alpha=0.1, p=[[0.15], [1.0], [0.4]], omega=[1.0, 1.4], mu=0.12)
    tangency, split = homoclinic_tangency(osc), splitting(osc, 1.0)
    assert tangency.shape == split.shape == (3, 2)
    for k in np.ndindex(3, 2):
        one = Duffing(alpha=0.1, p=float(osc.p[k[0], 0]), omega=float(osc.omega[k[1]]), mu=0.12)
        assert homoclinic_tangency(one) == pytest.approx(tangency[k], rel=1e-9)
        assert splitting(one, 1.0) == pytest.approx(split[k], abs=1e-10)


def test_orbits_that_come_to_rest_in_the_well_neither_stop_the_search_nor_matter_to_a_member_beside():
    """They creep past v = 0 at x > 1. A member alone has other segments of the saddle orbit than in a family."""
    osc = Duffing(alpha=[0.1, 0.1, 0.1, 0.16, 0.16, 0.16], p=[0.1, 0.1, 0.1, 0.05, 0.1, 0.3])
    osc = replace(osc, omega=np.array([0.2, 0.25, 2.5, 1.175, 1.175, 1.175]))
    together = homoclinic_tangency(osc)
    assert np.all(np.abs(together / critical_amplitude(osc) - 0.975) < 0.016)
    for member, mu in enumerate(together):
        assert homoclinic_tangency(osc.members([member])) == pytest.approx(mu, rel=1e-9)


@pytest.mark.parametrize("p", [0.1, 0.3])
@pytest.mark.parametrize("alpha", [0.01, 0.2])
def test_no_orbit_of_the_unstable_manifold_goes_over_at_weaker_forcing_down_to_half_the_tangency(alpha, p):
    osc = Duffing(alpha=alpha, p=p)
    weaker = homoclinic_tangency(osc) * np.append(np.linspace(0.5, 0.99, 25), 0.999)
    assert np.all(highest(forward_frame(replace(osc, mu=weaker))) < 0)


def test_a_phase_at_which_the_orbits_come_to_rest_instead_of_turning_is_named():
    osc = Duffing(alpha=0.2, p=0.1, mu=0.2777)
    assert splitting(osc, np.pi / 2) > -1e-3
    with pytest.raises(ConvergenceError, match=r"alpha = 0\.2.*at the phase 0: orbits .* come to rest in the well"):
        splitting(osc, [np.pi / 2, 0.0])


def test_jump_of_the_crossings_time_is_no_crossing(monkeypatch):
    frame = forward_frame(Duffing(alpha=0.1, p=0.1, mu=0.15))
    t = tangency_by_threshold.crossing(frame, np.array([1.0]), np.array([0]))  # there is one
    assert 1 < t[0] < 1.6
    free = tangency_by_threshold.launched

    def late(frame, place, member):
        found = free(frame, place, member)
        return found._replace(t=found.t - 0.5 * (place > 0.4))

    monkeypatch.setattr(tangency_by_threshold, "launched", late)
    skipped = late(frame, np.array([0.4]), np.array([0])).t[0] - 0.25
    with pytest.raises(ConvergenceError, match=r"p = 0\.1.*no first crossing"):
        tangency_by_threshold.crossing(frame, np.array([skipped]), np.array([0]))


def test_prototypes_ratios_at_small_p_are_reproduced():
    """An independent program, before this one, found these ratios of the tangency to Eq. 13 at omega = 1."""
    osc = Duffing(alpha=0.1, p=[0.1, 0.2])
    np.testing.assert_allclose(homoclinic_tangency(osc) / critical_amplitude(osc), [0.97931, 0.98576], atol=1e-5)


@pytest.mark.parametrize(("p", "alpha"), [(0.05, 0.1), (0.1, 0.01), (0.1, 0.2), (0.3, 0.1)])
def test_splitting_is_negative_below_the_tangency_and_positive_somewhere_above_at_small_p(p, alpha):
    osc = Duffing(alpha=alpha, p=p)
    mu = homoclinic_tangency(osc)
    phases = np.linspace(0.5, 3.0, 60)  # round pi/2, where it is largest
    low, high = splitting(replace(osc, mu=mu * np.array([1 - 1e-3, 1 + 1e-3])), phases).max(axis=0)
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
