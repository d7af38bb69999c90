"""What the chapter on small p computes: each number against another way to it."""

from dataclasses import replace

import numpy as np
import pytest

from book.studies import small_p
from book.studies.accuracy import CURVES
from duffing import ConvergenceError, lyapunov_spectrum, paper, poincare_section, trajectory


def test_chaos_is_summed_up_by_the_statistics_of_its_positive_runs():
    found = small_p.chaos(columns=4, rows=2)
    family = replace(paper.OSCILLATOR, mu=np.full(8, 0.27))
    runs = lyapunov_spectrum(family, small_p.starts(4, 2), 199, 40, k=1, **CURVES).exponents[0]
    runs = runs[runs > 0]
    assert found.runs == runs.size
    assert found.mean == pytest.approx(runs.mean())
    assert found.spread == pytest.approx(np.std(runs, ddof=1))
    assert found.error == pytest.approx(found.spread / np.sqrt(found.runs))


def test_chaos_without_two_chaotic_runs_says_so():
    with pytest.raises(ConvergenceError, match=r"^mu = 0.2: 0 of 2 runs"):
        small_p.chaos(mu=0.2, columns=2, rows=1)


def test_exponents_of_a_periodic_orbit_are_those_of_a_long_average_and_obey_the_sum_rule():
    mu = (0.2, 0.29)
    orbit = small_p.attracting_orbits(mu)
    average = lyapunov_spectrum(replace(paper.OSCILLATOR, mu=np.array(mu)), paper.START, 400, 200).exponents
    np.testing.assert_allclose(orbit.exponents, average, atol=2e-3)
    assert np.all(orbit.exponents[0] >= orbit.exponents[1])
    assert np.all(orbit.gap < 1e-6)


def test_an_annihilated_direction_of_a_periodic_orbit_has_the_exponent_minus_infinity():
    orbit = small_p.attracting_orbits((0.05,))
    assert orbit.friction_time[0] == np.inf
    assert orbit.exponents[1, 0] == -np.inf
    assert np.isfinite(orbit.exponents[0, 0])


def test_dry_limit_gives_half_the_range_of_x_in_the_last_period():
    _, swing = small_p.dry_limit((0.5,), (0.2,))
    osc = replace(paper.OSCILLATOR, p=0.5, mu=0.2)
    t = osc.period * np.append(0.0, 239 + np.arange(401) / 400)
    x = trajectory(osc, paper.START, t)[0, 1:]
    assert swing[0, 0] == pytest.approx(np.ptp(x) / 2, rel=1e-3)


def test_window_holds_each_start_at_each_forcing():
    mu, exponents = small_p.window(columns=2, rows=1, step=0.01, first=0.26, last=0.27, periods=20)
    np.testing.assert_allclose(mu, [0.26, 0.27])
    osc = replace(paper.OSCILLATOR, mu=0.27)
    alone = lyapunov_spectrum(osc, small_p.starts(2, 1)[:, 1], 20, 40, k=1, **CURVES)
    assert exponents.shape == (2, 2)
    assert exponents[1, 1] == alone.exponents[0]


def test_step_study_holds_every_method_at_every_step():
    study = small_p.step_study((0.2,), factors=(1, 2))
    assert set(study) == {(method, factor) for method in ("tangent", 1e-4, 1e-8) for factor in (1, 2)}
    assert study["tangent", 1][0] != study["tangent", 2][0]


def test_the_range_of_chaos_counts_forcings_and_the_exceptions_among_them():
    part = np.array([0.0, 0.25, 1.0, 0.5, 0.75, 0.0])  # of four starts, at six forcings
    exponents = np.where(np.arange(4)[:, None] < 4 * part, 0.1, -0.1)
    found = small_p.chaotic_range(np.arange(6.0), exponents)
    assert found == (1.0, 4.0, 2.0, 4.0, 2, 1, 0.5)


def test_inside_the_window_of_chaos_an_orbit_of_period_nine_attracts():
    assert small_p.longest_period(0.273) == 9
    points = poincare_section(replace(paper.OSCILLATOR, mu=0.273), paper.START, 10, transient=1500)
    apart = np.linalg.norm(points[:, 1:] - points[:, :1], axis=0)
    assert apart[8] < 1e-6 and apart[:8].min() > 1e-3


def test_one_initial_condition_lies_in_the_basin_of_the_large_orbit_throughout_the_window():
    mu, exponents = small_p.window(step=0.01)
    row = np.ptp(exponents, axis=1).argmin()
    family = replace(paper.OSCILLATOR, mu=mu)
    start = np.repeat(small_p.starts()[:, row, None], mu.size, axis=1)
    x = poincare_section(family, start, 2, transient=400)
    np.testing.assert_allclose(x[:, 0], x[:, 1], atol=1e-8)
    swing = trajectory(family, x[:, -1], family.period * np.arange(401) / 400)[0]
    assert np.all(np.ptp(swing, axis=0) / 2 > 1.5)
    np.testing.assert_allclose(exponents[row], exponents[row].mean(), rtol=0.1)
