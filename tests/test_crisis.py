"""The crisis: its saddle orbits against another method, the sign of the distance against where orbits really go."""

from dataclasses import replace

import numpy as np
import pytest

from book.studies import small_p
from duffing import ConvergenceError, Duffing, saddle_orbit, trajectory
from duffing.transients.crisis import beyond, crisis, crisis_above, distance_to_basin_boundary, large_saddle, saddles
from duffing.transients.lifetimes import both_wells, lifetimes

LINEAR = Duffing(p=1.0, mu=np.array([0.242, 0.250]))  # one before the crisis at p = 1, one after it
STEP = {"method": "rk4"}


def half_map(osc, state):
    t = np.array([0.0, osc.period / 2])
    return -trajectory(osc, state, t, rtol=1e-12, atol=1e-14)[:, 1]


@pytest.fixture(scope="module")
def found():
    return saddles(LINEAR, large_saddle(Duffing(p=1.0, mu=0.245)))


def test_inner_saddle_orbit_is_that_of_multiple_shooting(found):
    other = saddle_orbit(LINEAR)
    np.testing.assert_allclose(found.inner, other.state, atol=1e-9)
    np.testing.assert_allclose(found.multipliers**2, other.multipliers, rtol=1e-6)
    across = found.unstable[0] * other.unstable[1] - found.unstable[1] * other.unstable[0]
    np.testing.assert_allclose(across, 0, atol=1e-7)


def test_large_saddle_orbit_is_symmetric_closed_and_repels_across_its_border(found):
    osc = replace(LINEAR, mu=0.242)
    state, normal = found.outer[:, 0], found.normal[:, 0]
    np.testing.assert_allclose(half_map(osc, state), state, atol=1e-9)
    h = 1e-5
    steps = (h * np.eye(2)).tolist()
    derivative = np.transpose([(half_map(osc, state + s) - half_map(osc, state - s)) / (2 * h) for s in steps])
    np.testing.assert_allclose(np.abs(normal @ derivative), found.expansion[0] * np.abs(normal), rtol=1e-5)
    assert found.expansion[0] > 1
    assert normal @ state < 0  # towards x = 0
    assert np.linalg.det(derivative) == pytest.approx(np.exp(-osc.alpha * osc.period / 2), rel=1e-6)


def test_orbits_reach_the_large_orbit_exactly_where_the_distance_is_negative(found):
    distance = distance_to_basin_boundary(LINEAR, found, points=300, **STEP)
    assert distance[0] > 0 > distance[1]
    starts = small_p.starts(12, 8)
    family = Duffing(p=1.0, mu=np.repeat(LINEAR.mu, 96))
    lived = lifetimes(family, np.tile(starts, 2), 3000, **STEP)
    wander = lived.time > 20  # the others start in a basin's interior
    large = (both_wells(family, lived, **STEP) & wander).reshape(2, 96)
    assert not large[0].any()
    assert large[1].mean() > 0.3


def test_a_finer_sample_of_the_manifold_comes_nearer(found):
    coarse, fine = (distance_to_basin_boundary(LINEAR, found, points=n, **STEP) for n in (60, 600))
    assert np.all(fine <= coarse + 1e-3)
    assert np.all(fine > coarse - 0.15)


def test_the_paths_of_both_integrators_come_as_near(found):
    """Off by their errors after some periods of chaos, of which the coarse tip of the manifold has seen few."""
    exact, step = (
        distance_to_basin_boundary(LINEAR, found, points=100, periods=9, **options) for options in ({}, STEP)
    )
    np.testing.assert_allclose(exact, step, atol=5e-3)


def test_crisis_lies_where_the_distance_changes_its_sign(found):
    osc = Duffing(p=np.array([1.0]))
    mu = crisis(osc, [0.242], [0.250], found.outer[:, :1], steps=3, points=200, **STEP)
    bracket = replace(osc, p=1.0, mu=mu[0] + 0.0005 * np.array([-1, 1]))  # a bracket of 0.008 in 2^3 parts
    ends = distance_to_basin_boundary(bracket, saddles(bracket, found.outer[:, 0]), points=200, **STEP)
    assert ends[0] > 0 > ends[1]


def test_what_cannot_be_found_is_named(found):
    with pytest.raises(ConvergenceError, match=r"^mu = 0\.05: no large saddle orbit"):
        large_saddle(Duffing(p=1.0, mu=0.05))
    with pytest.raises(ConvergenceError, match=r"^mu from 0\.24 to 0\.243: distances .* are no bracket"):
        crisis(Duffing(p=np.array([1.0])), [0.240], [0.243], found.outer[:, :1], steps=1, points=100, **STEP)
    with pytest.raises(ConvergenceError, match=r"^mu = 0\.242: no point comes within"):
        distance_to_basin_boundary(LINEAR, found, points=20, periods=1, **STEP)
    with pytest.raises(ValueError, match=r"^points = 0"):
        distance_to_basin_boundary(LINEAR, found, points=0)


def test_a_crisis_searched_for_from_below_is_the_one_bisected_in_a_bracket():
    osc, outer = Duffing(p=1.0, mu=np.array([0.0])), large_saddle(Duffing(p=1.0, mu=0.235))
    found = crisis_above(osc, 0.235, outer, step=0.01, steps=4, points=200, **STEP)
    bracketed = crisis(osc, 0.235, 0.255, outer, steps=5, points=200, **STEP)
    np.testing.assert_allclose(found, bracketed, atol=1e-9)
    assert np.isinf(crisis_above(osc, 0.235, outer, step=0.005, tries=2, points=100, **STEP)[0])
    with pytest.raises(ConvergenceError, match=r"mu = 0.255: W\^U reaches beyond the border there already"):
        crisis_above(osc, 0.255, outer, points=100, **STEP)


def test_a_manifold_that_stays_away_from_the_border_does_not_reach_beyond_it(found):
    np.testing.assert_array_equal(beyond(LINEAR, found, points=200, **STEP), [False, True])
    early = Duffing(p=1.0, mu=np.array([0.2]))
    away = saddles(early, large_saddle(Duffing(p=1.0, mu=0.2)))
    assert not beyond(early, away, points=100, **STEP)[0]
    with pytest.raises(ConvergenceError, match="no point comes within"):
        distance_to_basin_boundary(early, away, points=100, **STEP)
