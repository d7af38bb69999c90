"""The presets of the chapters on transients and the window: small sizes, each number by another way."""

from dataclasses import replace

import numpy as np
import pytest

from book.studies import plane
from book.studies import transients as transient_study
from book.studies.survival import exponential
from duffing import ConvergenceError, paper, poincare_section, saddle_orbit, trajectory

STEP = {"method": "rk4"}


def test_a_multiplier_is_one_at_the_fold_and_the_orbits_are_gone_above_it():
    mu, state = transient_study.folds((0.1, 1.0))
    h = 1e-5
    for p, forcing, point in zip((0.1, 1.0), mu, state.T, strict=True):
        osc = replace(paper.OSCILLATOR, p=p, mu=forcing)
        around = point[:, None] + h * np.array([[0, 1, -1, 0, 0], [0, 0, 0, 1, -1]])
        options = {"rtol": 1e-12, "atol": 1e-14}
        image = poincare_section(replace(osc, mu=np.full(5, forcing)), around, 1, **options)[:, 0]
        np.testing.assert_allclose(image[:, 0], point, atol=1e-8)
        derivative = np.array([image[:, 1] - image[:, 2], image[:, 3] - image[:, 4]]).T / (2 * h)
        assert abs(np.linalg.det(derivative - np.eye(2))) < 1e-4
        # Above the fold the motion may wander and come near again: it does not stay.
        late = [poincare_section(replace(osc, mu=forcing + d), point, 50, transient=250).T for d in (-1e-4, 1e-4)]
        away = [np.hypot(*(points - point).T) for points in late]
        assert away[0].max() < 0.05 < away[1].max()


def test_the_place_of_the_fold_is_passed_in_a_time_of_the_power_minus_one_half():
    periods = transient_study.passage_time((1.6e-4, 4e-5, 1e-5))
    np.testing.assert_allclose(periods[1:] / periods[:-1], 2.0, rtol=0.12)  # whole periods, and the way there
    with pytest.raises(ConvergenceError, match=r"^longest = 30: not long enough"):
        transient_study.passage_time((1e-5,), longest=30)


def test_rates_of_both_destinations_add_up_to_the_whole():
    found = transient_study.escape((0.25,), 1.0, 12, 8, periods=2000)
    share = found.small[0, 0] + found.large[0, 0]
    assert found.mean[0] == pytest.approx(-1 / np.log1p(-share))
    assert found.small[0, 0] > 0 < found.large[0, 0]
    time, settled, large = transient_study.sample(0.25, 1.0, 12, 8, periods=2000)
    assert found.mean[0] == exponential(time, settled, transient_study.SINCE).mean
    assert settled.all() and np.all(time[large] > 0)


def test_small_orbits_capture_below_the_window_large_ones_above_it():
    found = transient_study.escape((0.264, 0.283), columns=8, rows=4, periods=300)
    assert found.small[0, 0] > 0 == found.large[0, 0]
    assert found.large[0, 1] > 0 == found.small[0, 1]


def test_in_the_window_there_is_a_lower_bound_only_and_where_nothing_wanders_there_is_none():
    found = transient_study.escape((0.1, 0.270), columns=4, rows=3, periods=60)
    assert np.isnan(found.mean).all() and np.isnan(found.bound[0]) and np.isnan(found.small[0, 0])
    assert found.bound[1] == pytest.approx(12 * (60 - transient_study.SINCE) / np.log(20))


def test_crises_lie_between_a_forcing_without_and_one_with_captures_by_the_large_orbit():
    at = transient_study.crises((1.0,), points=200, steps=3)[0]
    found = transient_study.escape((at - 0.003, at + 0.003), 1.0, 16, 8, periods=1000)
    assert found.large[0, 0] == 0 < found.large[0, 1]


def test_crisis_at_small_p_lies_between_chaos_that_stays_and_chaos_that_the_large_orbit_captures():
    at = transient_study.crises((0.1,), points=200, steps=3)[0]
    found = transient_study.escape((at - 0.003, at + 0.004), columns=8, rows=5, periods=600)
    assert np.all(found.wanderers == 40)  # no small orbit is left
    assert np.isnan(found.mean[0]) and found.bound[0] > 1000
    assert found.large[0, 0] == found.small[0, 0] == found.small[0, 1] == 0 < found.large[0, 1]
    assert found.mean[1] + 3 * found.error[1] < 600


def test_the_crisis_at_small_p_has_the_digits_that_are_printed():
    at = transient_study.crises((0.1,))[0]
    assert transient_study.crises((0.1,), points=1600)[0] == at  # and 400 points put it 0.0006 too high
    below, above = plane.lasting(0.1, 1.0, 0.1, (at - 2.5e-4, at + 6e-4), columns=4, rows=3, periods=9000).across
    assert below == 1 and above < 0.5


def test_wanderers_are_the_starts_that_rates_and_means_are_taken_from():
    found = transient_study.escape((0.15, 0.264), columns=10, rows=6, periods=300)
    times = [transient_study.sample(mu, columns=10, rows=6, periods=300)[0] for mu in (0.15, 0.264)]
    late = [time[time > transient_study.SINCE] for time in times]
    np.testing.assert_array_equal(found.wanderers, [part.size for part in late])
    assert found.wanderers[0] < found.wanderers[1] < 60
    exposure = np.sum(late[1] - transient_study.SINCE)
    assert found.small[0, 1] == pytest.approx(np.sum(late[1] < 300) / exposure)


def test_edge_falls_with_the_forcing():
    distance = transient_study.edge((0.268, 0.272, 0.277), points=100, **STEP)
    assert distance[0] > distance[1] > 0 > distance[2]


def test_the_papers_motion_lives_as_long_as_it_jumps():
    by_step, _ = transient_study.sample_of_the_paper()
    osc = replace(paper.OSCILLATOR, mu=paper.MU_REGULAR)
    points = poincare_section(osc, paper.START, paper.PERIODS, **STEP)
    away = np.flatnonzero(np.hypot(*(points - points[:, -1:])) > 0.1)
    assert by_step == away[-1] + 2  # point k is number k + 1, and the next one is inside


def test_large_are_those_round_both_wells_that_repeat_themselves_each_period():
    """At this forcing all starts end round both wells, most on the large orbit and some on one of two periods."""
    _, settled, large = transient_study.sample(0.27, 2.0, 8, 5, periods=400)
    family = replace(paper.OSCILLATOR, p=2.0, mu=np.full(40, 0.27))
    points = poincare_section(family, transient_study.starts_between_wells(8, 5), 2, transient=600, **STEP)
    repeats = np.hypot(*(points[:, 1] - points[:, 0])) < 1e-6
    assert settled.all() and 0 < repeats.sum() < 40
    np.testing.assert_array_equal(large, repeats)


def test_a_passage_ends_with_the_first_period_after_which_the_orbit_is_away():
    distance = (1e-3, 3e-4)
    periods = transient_study.passage_time(distance)
    mu, state = transient_study.folds((0.1,))
    for number, above in zip(periods.tolist(), distance, strict=True):
        osc = replace(paper.OSCILLATOR, mu=mu[0] + above)
        times = osc.period * np.arange(number + 1)
        away = np.hypot(*(trajectory(osc, state[:, 0], times, rtol=1e-8, atol=1e-10) - state))
        assert away[:-1].max() < 0.1 < away[-1]


def test_starts_between_the_wells_fill_their_box():
    starts = transient_study.starts_between_wells(5, 3)
    assert starts.shape == (2, 15)
    np.testing.assert_array_equal(starts.min(axis=1), [-1.0, -0.4])
    np.testing.assert_array_equal(starts.max(axis=1), [1.0, 0.4])


def test_lifetimes_below_the_fold_level_off():
    """At 1e-4 and 1e-6 below the fold they agree, where a crisis would let them grow without bound."""
    mean, error = transient_study.below_fold((1e-4, 1e-6), columns=12, rows=12, periods=800)
    assert abs(mean[0] - mean[1]) < 4 * np.hypot(*error)
    mu = transient_study.folds((0.1,))[0][0]
    time, settled, _ = transient_study.sample(float(mu - 1e-4), columns=12, rows=12, periods=800)
    assert mean[0] == exponential(time, settled, transient_study.SINCE).mean


def test_the_fixed_step_moves_the_crisis_at_small_p_by_no_more_than_its_resolution():
    exact, stepped = (transient_study.crises((0.1,), by_step=by)[0] for by in (False, True))
    assert abs(exact - stepped) <= 0.008 / 2**6


def test_the_exponent_of_the_crisis_is_that_of_the_saddle_orbits_multipliers():
    """At p = 1 Liouville's theorem gives the smaller multiplier: l1 l2 = exp(-alpha T)."""
    (gamma,) = transient_study.crisis_exponent((1.0,))
    mu = transient_study.crises((1.0,))[0]
    larger = np.log(abs(saddle_orbit(replace(paper.OSCILLATOR, p=1.0, mu=mu)).multipliers[0]))
    assert gamma == pytest.approx(0.5 + larger / (larger + 0.1 * 2 * np.pi), abs=1e-5)
