"""Attractors and the labels of starts, where they are known: by energy, by a linear equation, by symmetry, by time."""

from dataclasses import replace

import numpy as np
import pytest

from duffing import Duffing, lyapunov_spectrum, poincare_section
from duffing.basins.attractors import UNRESOLVED, Attractor, Cells, find_attractors, settle

RK4 = {"method": "rk4", "steps_per_period": 100}
THREE = Duffing(mu=0.2)  # an orbit in each well and a large one round both


@pytest.fixture(scope="module")
def three():
    return find_attractors(THREE, **RK4)


def grid(columns=24, rows=16):
    return np.reshape(np.meshgrid(np.linspace(-1.6, 1.6, columns), np.linspace(-1.2, 1.2, rows)), (2, -1))


def test_without_forcing_a_start_below_the_saddle_ends_in_its_own_well():
    osc, states = Duffing(), grid()
    states = states[:, osc.energy(*states) < 0]
    attractors = find_attractors(osc, states[:, ::9], **RK4)
    assert [one.name for one in attractors] == ["left well, period 1", "right well, period 1"]
    np.testing.assert_allclose([one.points[:, 0] for one in attractors], [[-1, 0], [1, 0]], atol=1e-6)
    np.testing.assert_array_equal(settle(osc, states, attractors, **RK4).labels, states[0] > 0)


@pytest.mark.parametrize(("alpha", "x"), [(1e-4, 1.13), (1e-4, 1.35), (1e-3, 1.35)])
def test_regular_motion_that_weak_damping_has_not_ended_is_no_chaos(alpha, x):
    """A found failure: its tangents grow in proportion to time, here evenly enough for three standard errors."""
    assert find_attractors(Duffing(alpha=alpha, mu=0.02), [[x], [0.1]], periods=40) == ()


def test_without_damping_chaos_is_no_attractor():
    osc, start = Duffing(alpha=0.0, mu=0.2), (1.2, 0.3)
    assert lyapunov_spectrum(osc, start, k=1).exponents > 0.05
    assert find_attractors(osc, np.reshape(start, (2, 1)), periods=40) == ()


def test_multipliers_at_the_bottom_of_a_well_are_those_of_the_linear_equation():
    right = find_attractors(Duffing(), **RK4)[1]
    np.testing.assert_allclose(np.abs(right.multipliers), np.exp(-0.1 * np.pi), rtol=1e-6)


def test_a_linear_oscillator_has_one_attractor_and_every_start_ends_there():
    osc = Duffing(alpha=0.4, mu=0.3, omega=0.7, delta=1.0, gamma=0.0)
    response = 0.3 / (1 - 0.7**2 + 0.4 * 0.7j)
    (only,) = find_attractors(osc, **RK4)
    assert only.name == "both wells, period 1"
    np.testing.assert_allclose(only.points[:, 0], [response.real, (0.7j * response).real], atol=1e-6)
    np.testing.assert_allclose(np.abs(only.multipliers), np.exp(-0.4 * osc.period / 4), rtol=1e-6)  # of the half map
    assert np.all(settle(osc, 3 * grid(), (only,), **RK4).labels == 0)


def test_attractors_are_stroboscopic_points_and_come_with_their_mirror_images(three):
    assert [one.name for one in three] == ["left well, period 1", "right well, period 1", "both wells, period 1"]
    for one in three:
        after = poincare_section(THREE, one.points[:, 0], 1)[:, 0]
        np.testing.assert_allclose(after, one.points[:, 0], atol=1e-7)
    halfway = poincare_section(THREE, three[0].points[:, 0], 1, phase=np.pi)[:, 0]
    np.testing.assert_allclose(-halfway, three[1].points[:, 0], atol=1e-7)


def test_a_label_is_kept_when_the_start_is_followed_much_longer(three):
    states = grid()
    settled = settle(THREE, states, three, **RK4)
    soon = settled.periods <= 15  # later, a chaotic transient has made another orbit of each rounding
    assert soon.mean() > 0.3
    ends = poincare_section(replace(THREE, mu=np.full(states.shape[1], 0.2)), states, 1, 700, **RK4)[:, 0]
    distance = np.array([np.hypot(*(ends - one.points)) for one in three])
    assert np.all(distance.min(axis=0)[soon] < 1e-4)
    np.testing.assert_array_equal(settled.labels[soon], distance.argmin(axis=0)[soon])


def test_in_friction_time_too_a_label_is_kept_when_the_start_is_followed_longer():
    osc, options = Duffing(p=0.5, mu=0.15), {"rtol": 1e-6, "atol": 1e-8}
    states = grid(6, 4)
    attractors = find_attractors(osc, states, **options)
    settled = settle(osc, states, attractors, **options)
    assert np.all(settled.labels != UNRESOLVED) and np.unique(settled.labels).size >= 2
    ends = poincare_section(replace(osc, mu=np.full(24, 0.15)), states, 16, 184, **options)
    distance = [np.hypot(*(ends - one.points[:, :1, None])).min(axis=0) for one in settled.attractors]
    np.testing.assert_array_equal(settled.labels, np.argmin(distance, axis=0))


def test_every_state_of_a_trapping_disk_ends_on_its_attractor(three):
    rng = np.random.default_rng(20261122)
    for one in three:
        angle, radius = rng.uniform(0, 2 * np.pi, 60), np.sqrt(rng.uniform(0, 0.9999, 60))
        circle = np.linalg.solve(np.linalg.cholesky(one.region.form).T, [np.cos(angle), np.sin(angle)])
        states = one.region.centre[:, None] + radius * circle
        assert np.all(one.region.holds(states))
        family = replace(THREE, mu=np.full(60, 0.2))
        ends = poincare_section(family, states, 1, 80)[:, 0]  # by the other integrator
        np.testing.assert_allclose(ends, np.repeat(one.points, 60, axis=1), atol=1e-4)


def test_an_attractor_left_out_of_the_list_is_found_on_the_way(three):
    full = settle(THREE, grid(), three, periods=300, **RK4)
    without = settle(THREE, grid(), three[:2], periods=300, **RK4)
    assert [one.name for one in without.attractors] == [one.name for one in three]
    np.testing.assert_array_equal(without.labels, full.labels)
    assert np.all(full.periods <= without.periods)


def test_what_is_not_caught_in_time_is_unresolved_and_says_so(three):
    short, long = (settle(THREE, grid(), three, periods=n, **RK4) for n in (6, 30))
    assert 0 < np.mean(long.labels == UNRESOLVED) < np.mean(short.labels == UNRESOLVED)
    np.testing.assert_array_equal(np.isinf(short.periods), short.labels == UNRESOLVED)
    assert np.max(short.periods[np.isfinite(short.periods)]) <= 6
    np.testing.assert_array_equal(short.labels != UNRESOLVED, long.periods <= 6)


def test_the_mirrored_start_half_a_period_later_ends_on_the_mirrored_attractor(three):
    here = settle(THREE, grid(), three, **RK4)
    there = settle(THREE, -grid(), three, phase=np.pi, **RK4)
    soon = here.periods <= 15
    assert soon.mean() > 0.3
    np.testing.assert_array_equal(np.array([1, 0, 2])[here.labels[soon]], there.labels[soon])


def test_an_orbit_of_sixteen_periods_is_found_at_the_end_of_a_cascade():
    osc = Duffing(mu=0.08)
    attractors = settle(osc, grid(), **RK4).attractors
    (one,) = (one for one in attractors if one.period == 16 and one.place == "right")
    points = poincare_section(osc, one.points[:, 0], 16)
    np.testing.assert_allclose(points[:, -1], one.points[:, 0], atol=1e-6)
    assert np.min(np.hypot(*(points[:, :-1] - one.points[:, :1]))) > 1e-3
    assert np.max(np.abs(one.multipliers)) < 1


def test_a_chaotic_attractor_catches_what_stays_in_its_cells():
    osc = Duffing(alpha=0.25, mu=0.4)  # the parameters of Guckenheimer and Holmes, Fig. 2.2.5
    (chaos,) = find_attractors(osc, **RK4)
    assert chaos.name == "both wells, chaotic"
    settled = settle(osc, grid(), (chaos,), **RK4)
    assert np.all(settled.labels == 0)
    assert np.min(settled.periods) >= 19 and np.median(settled.periods) < 40


def test_a_chaotic_transient_is_no_attractor():
    osc = Duffing(mu=0.247)
    names = [one.name for one in find_attractors(osc, periods=60, **RK4)]
    assert names == ["left well, period 1", "right well, period 1", "both wells, period 1"]


def test_not_even_one_with_positive_exponents_if_an_orbit_on_it_is_caught(monkeypatch):
    class Positive:
        exponents, error = np.ones(1), np.zeros(1)

    monkeypatch.setattr("duffing.basins.attractors.lyapunov_spectrum", lambda *args, **kwargs: Positive)
    assert all(one.period for one in find_attractors(Duffing(mu=0.247), periods=60, **RK4))


def test_motion_that_nothing_catches_is_no_chaos_without_a_positive_exponent():
    undamped = Duffing(alpha=0.0)  # every orbit closes, none attracts
    assert find_attractors(undamped, np.array([[0.5, 0.8], [0.1, 0.0]]), periods=40, **RK4) == ()


def test_invalid_requests_are_refused_by_name():
    with pytest.raises(ValueError, match=r"^osc has the shape"):
        settle(Duffing(mu=[0.1, 0.2]), grid())
    with pytest.raises(ValueError, match=r"^states has shape"):
        settle(THREE, np.zeros((3, 5)))
    with pytest.raises(ValueError, match=r"^periods = 0"):
        settle(THREE, grid(), periods=0)


def test_two_chaotic_attractors_each_count_their_own_stay():
    """Cells over each well, as of chaos in it: a stay in the one is not ended by not staying in the other."""
    osc = Duffing(mu=0.05)
    left, right = (Cells(np.array([low, -1.0]), np.ones((75, 100), dtype=bool)) for low in (-1.5, 0.0))
    chaos = tuple(Attractor(place, 0, np.empty((2, 0)), 0.5, np.empty(0), region)
                  for place, region in (("left", left), ("right", right)))  # fmt: skip
    states = np.array([[-1.0, 1.0], [0.0, 0.0]])
    for pair, expected in ((chaos, [0, 1]), (chaos[::-1], [1, 0])):
        settled = settle(osc, states, pair, periods=30, **RK4)
        np.testing.assert_array_equal(settled.labels, expected)
        np.testing.assert_array_equal(settled.periods, [19, 19])
