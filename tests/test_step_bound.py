"""The bound on steps: by default it grows with the time that is gone, so that long intervals need no option."""

import time

import numpy as np
import pytest

from duffing import ConvergenceError, DivergedError, Duffing, poincare_section, trajectory
from duffing.basins.attractors import settle
from duffing.integrators.friction_time.adaptive import integrate
from duffing.integrators.friction_time.turning_points import to_turning_point
from duffing.orbits.periodic import periodic_orbit

ONE_WELL = Duffing(p=0.7, mu=0.05)
SLOW = Duffing(p=1.0, mu=0.3, omega=0.01)


def test_a_transient_of_thousands_of_periods_is_an_everyday_request():
    points = poincare_section(Duffing(p=0.1, mu=0.3), (0.1, 0), periods=5, transient=3000)
    ones = poincare_section(Duffing(p=0.1, mu=0.3), points[:, 0], periods=4)  # it is settled, on an orbit of period one
    np.testing.assert_allclose(points[:, 1:], ones, atol=1e-8)


@pytest.mark.parametrize("osc", [Duffing(p=0.1, mu=0.1, omega=0.1), SLOW])
def test_many_periods_of_slow_forcing_are_answered(osc):
    late = poincare_section(osc, (0.1, 0), periods=2, transient=1200)
    ones = poincare_section(osc, late[:, 0], periods=1)
    np.testing.assert_allclose(late[:, 1:], ones, atol=1e-8)
    assert 0.1 < np.abs(late[0, 0]) < 1.5


def test_two_times_far_apart_give_the_state_that_many_between_them_give():
    far = trajectory(ONE_WELL, (1.0, 0.0), [0, 2e4])[:, -1]
    near = trajectory(ONE_WELL, (1.0, 0.0), np.linspace(0, 2e4, 101))[:, -1]
    np.testing.assert_allclose(far, near, atol=1e-7)


@pytest.mark.parametrize(
    "osc", [Duffing(alpha=0.0, omega=1e-9), Duffing(alpha=0.0, mu=8.0, omega=1e-9, delta=0.0, gamma=1.0)]
)
def test_free_oscillations_by_the_thousand_within_one_slow_forcing_period_keep_their_energy(osc):
    """The forcing is all but constant, so that H0 - mu x is the energy; the period is that of the spring."""
    x, v = trajectory(osc, (1.5, 0.0), [0, 2e4])
    energy = osc.energy(x, v) - osc.mu * x
    assert energy[1] == pytest.approx(energy[0], rel=1e-5)


def test_a_long_search_for_a_turning_point_ends_in_its_time_not_by_its_steps():
    with pytest.raises(ConvergenceError, match="no turning point was found in time"):
        to_turning_point(Duffing(alpha=0.0), (-0.5, 0.2), 0.0, beyond=0.3, within=3e4)


def test_an_orbit_over_thousands_of_half_periods_is_that_over_two():
    many, two = (periodic_orbit(ONE_WELL, (1.0, 0.0), halves) for halves in (4000, 2))
    np.testing.assert_allclose(many.state, two.state, atol=1e-8)
    np.testing.assert_allclose(many.multipliers, 0.0, atol=1e-300)  # not a NaN, though no normal number


def test_slow_forcing_settles():
    labels, _, attractors = settle(ONE_WELL.members(0, omega=0.01), [[0.9, -0.9], [0, 0]], periods=40)
    assert {attractors[label].place for label in labels} == {"left", "right"}


def test_the_default_bound_on_steps_is_not_met_by_what_an_explicit_one_stops():
    spinning = {"state": (0.9, 0.0), "t": [0, 3000 * np.pi]}
    with pytest.raises(ConvergenceError, match="max_steps = 2000 is"):
        integrate(Duffing(mu=0.3), **spinning, max_steps=2000)
    assert integrate(Duffing(mu=0.3), **spinning).evaluations[0] > 12 * 2000


def test_an_explicit_bound_holds_for_each_interval_by_itself():
    osc, t = Duffing(mu=0.3), 2 * np.pi * np.arange(6)
    steps = np.diff([0, *(integrate(osc, (0.9, 0.0), t[: n + 1]).evaluations[0] // 12 for n in range(1, 6))])
    assert integrate(osc, (0.9, 0.0), t, max_steps=int(steps.max()) + 5).evaluations[0] // 12 == steps.sum()
    assert steps.sum() > 2 * (steps.max() + 5)


def test_the_error_names_the_interval_the_bound_and_what_to_do():
    with pytest.raises(
        ConvergenceError,
        match=r"mu = 0\.27.*max_steps = 10 is too few steps from t = 0\.01 to t = 7: give a larger max_steps, "
        r"or a larger rtol \(it is 1e-09\)",
    ):
        trajectory(Duffing(p=[1.0, 0.1], mu=0.27), (0.9, 0.0), [0, 0.01, 7], max_steps=10, rtol=1e-9)
    with pytest.raises(ConvergenceError, match=r"max_steps = None \(by default 100000 and 10000 a period\) is"):
        integrate(Duffing(alpha=3e4), (0.9, 0.0), [0, 6])  # steps of the relaxation time, 0.7 / alpha


@pytest.mark.parametrize("tangents", [0, 1, 2])
def test_time_that_does_not_go_on_ends_an_interval_of_any_length_by_name_and_soon(tangents):
    """The solution becomes infinite at about t = 2. A bound for the whole of the interval let it spin for minutes."""
    osc = Duffing(alpha=0.03, p=2.12, mu=-0.14, omega=2.36, delta=-1.1, gamma=-0.285)
    begun = time.process_time()
    with pytest.raises((ConvergenceError, DivergedError), match=r"alpha = 0\.03, p = 2\.12"):
        integrate(osc, (0.9, 0.0), [0, 1e7], tangents=tangents, rtol=1e-6, atol=1e-8)
    assert time.process_time() - begun < 60  # a second or two, and compiling; it was an hour


@pytest.mark.parametrize(("omega", "end"), [(1e308, 1.0), (1.0, 1e308), (1.0, 1e-300)])
def test_what_could_take_for_ever_ends_by_name_too(omega, end):
    if end < 1e-99:
        assert integrate(Duffing(omega=omega), (0.9, 0.0), [0, end]).states[0, -1] == 0.9
        return
    with pytest.raises(ConvergenceError, match="max_steps = None"):
        integrate(Duffing(mu=0.1, omega=omega), (0.9, 0.0), [0, end])
