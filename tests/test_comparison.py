"""Chaos compared: averages over the wandering alone, and the energy that the damping takes."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from book.studies import comparison as comparison_study
from book.studies import small_p
from book.studies.transients import starts_between_wells
from book.studies.wandering import dissipated_energy, mean_ratio, wandering
from duffing import Duffing, critical_amplitude, lyapunov_spectrum

STEP = {"method": "rk4"}


def test_energy_taken_from_the_linear_oscillator_in_a_period():
    """The response A cos(omega t - phase) loses pi alpha omega A^2."""
    alpha, mu, delta, omega = 0.4, 0.7, 3.0, 1.3
    osc = Duffing(alpha=alpha, p=1.0, mu=mu, omega=omega, delta=delta, gamma=0.0)
    amplitude = mu / np.hypot(delta - omega**2, alpha * omega)
    taken = dissipated_energy(osc, (0.3, 0.1), 2, transient=40)
    assert taken == pytest.approx(2 * np.pi * alpha * omega * amplitude**2, rel=1e-9)


@pytest.mark.parametrize("p", [0.1, 0.5, 2.0])
def test_energy_taken_balances_the_work_of_the_force(p):
    """Over any time, what the damping takes is the work of mu cos(omega t) less the gain of H0; by SciPy."""
    osc, start = Duffing(p=p, mu=0.3), (0.45, 0.1)

    def rates(t, y):
        return [y[1], osc.acceleration(y[0], y[1], t), osc.mu * np.cos(t) * y[1]]

    end = solve_ivp(rates, (0, 2 * osc.period), [*start, 0.0], method="LSODA", rtol=1e-9, atol=1e-11).y[:, -1]
    balance = end[2] - (osc.energy(end[0], end[1]) - osc.energy(*start))
    assert dissipated_energy(osc, start, 2) == pytest.approx(balance, rel=2e-3)


def test_the_mean_over_runs_of_unequal_length_is_that_of_all_their_periods():
    total, number = (
        np.array([[3.0, 1.0, 0.0], [0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]),
        np.array([[2, 2, 0], [0, 0, 0], [4, 0, 0]]),
    )
    mean, error = mean_ratio(total, number)
    np.testing.assert_array_equal(mean, [1.0, np.nan, 0.5])
    np.testing.assert_array_equal(error, [0.5, np.nan, np.inf])  # runs' means 3/2, 1/2: scatter sqrt(1/2) / sqrt(2)


def test_error_of_the_mean_covers_the_scatter_of_the_means():
    draw = np.random.default_rng(2718)
    number = draw.integers(5, 50, (400, 30))
    total = draw.normal(0.2 * number, 0.5 * np.sqrt(number))
    mean, error = mean_ratio(total, number)
    assert 0.85 < np.mean(error) / np.std(mean) < 1.15
    assert abs(np.mean(mean) - 0.2) < 4 * np.std(mean) / 20


def test_wandering_exponent_is_that_of_orbits_which_have_not_settled():
    osc, starts = Duffing(p=1.0, mu=np.array([0.25])), small_p.starts(16, 8)
    found = wandering(osc, starts, 240, **STEP)
    long = lyapunov_spectrum(Duffing(p=1.0, mu=np.full(128, 0.25)), starts, 120, 20, k=1, **STEP)
    chaotic = long.exponents[0][long.exponents[0] > 0.12]  # regular in the end, the others' averages are lower
    assert 0.05 < found.share[0] < 0.9
    assert abs(found.exponent[0] - chaotic.mean()) < 5 * np.hypot(found.error[0], chaotic.std() / np.sqrt(chaotic.size))


def test_where_nothing_wanders_there_is_no_exponent():
    found = wandering(Duffing(p=1.0, mu=np.array([0.05, 0.25])), small_p.starts(8, 4), 120, **STEP)
    assert found.share[0] == 0
    assert np.isnan(found.exponent[0]) and np.isnan(found.dissipated[0])
    assert np.isfinite(found.exponent[1]) and found.periods[1] > found.periods[0] == 0


def test_at_equal_finds_the_value_on_a_line_and_its_error():
    x = np.array([-2.0, -1.0, 1.0, 2.0, 9.0, 0.0])
    y, error = 3 + 0.5 * x, np.array([0.2, 0.2, 0.2, 0.2, 0.2, np.inf])
    value, spread = comparison_study.at_equal(0.0, x, y, error, within=5)
    assert value == pytest.approx(3)
    assert spread == pytest.approx(0.2 / 2)  # four points, symmetric about the value
    with pytest.raises(ValueError, match=r"^within = 1\.5: must leave at least three points, leaves 2"):
        comparison_study.at_equal(0.0, x, y, error, within=1.5)


def test_chaotic_share_is_one_in_the_window_and_zero_on_regular_motion():
    found = comparison_study.chaotic_starts((0.1, 0.27), 0.1, columns=2, rows=2, periods=60)
    np.testing.assert_array_equal(found.share, [0, 1])
    assert np.isnan(found.exponent[0]) and np.isnan(found.error[0])  # no chaos, no mean
    assert found.largest[0] < 0 < found.exponent[1] < found.largest[1]


def test_the_exponent_of_chaotic_starts_is_the_mean_over_those_alone_with_its_standard_error():
    mu, starts = 0.25, small_p.starts(6, 4)
    found = comparison_study.chaotic_starts((mu,), 1.0, columns=6, rows=4, periods=80)
    alone = lyapunov_spectrum(Duffing(p=1.0, mu=np.full(24, mu)), starts, 80, 40, k=1, **STEP).exponents[0]
    chaotic = alone[alone > comparison_study.CHAOTIC]
    assert 1 < chaotic.size < 24
    assert found.share[0] == chaotic.size / 24 and found.largest[0] == alone.max()
    assert found.exponent[0] == pytest.approx(chaotic.mean(), rel=1e-12)
    assert found.error[0] == pytest.approx(chaotic.std(ddof=1) / np.sqrt(chaotic.size), rel=1e-12)


def test_comparisons_are_the_same_where_finished_blocks_are_kept(tmp_path):
    run = {"checkpoint": str(tmp_path)}
    chaotic = [comparison_study.chaotic_starts((0.25,), 1.0, 3, 2, periods=40, **how) for how in ({}, run)]
    np.testing.assert_array_equal(*(one.largest for one in chaotic))
    kept = len(list(tmp_path.glob("*.block")))
    compared = [comparison_study.compared(1.0, (0.25,), 3, 2, periods=60, **how)[2] for how in ({}, run)]
    np.testing.assert_array_equal(*compared)
    assert 0 < kept < len(list(tmp_path.glob("*.block")))


def test_the_lead_is_that_over_the_nearest_of_the_others():
    exponents, errors = np.array([0.1, 0.2, 0.15]), np.array([0.003, 0.0, 0.004])
    assert comparison_study.lead(exponents, errors) == pytest.approx(10)
    assert comparison_study.lead(exponents[::-1], errors) < 0  # not the smallest


def test_speeds_on_the_response_of_the_linear_oscillator():
    """v = V cos(omega t + phase): |v| > 1 for a share 1 - 2 asin(1 / V) / pi of the time."""
    osc = Duffing(alpha=0.4, p=1.0, omega=1.3, delta=3.0, gamma=0.0)
    mu = 2 * np.hypot(osc.delta - osc.omega**2, osc.alpha * osc.omega) / osc.omega  # V = 2
    state = replace(osc, mu=mu)
    largest, fast = comparison_study.speeds_of(state, np.zeros((2, 3)), 40, 60)
    assert largest == pytest.approx(2, rel=2e-3)
    assert fast == pytest.approx(1 - 2 * np.arcsin(0.5) / np.pi, abs=0.03)
    assert comparison_study.speeds(0.85, 0.1, 3, 2, 20)[1] > comparison_study.speeds(0.268, 0.1, 3, 2, 20)[1] + 0.3


def test_equal_ratios_are_multiples_of_the_critical_amplitude():
    ratios, p = (1.5, 3.3), (1.0, 2.0)
    table = comparison_study.at_equal_ratio(ratios, p, columns=4, rows=3, periods=80)
    assert all(part.shape == (2, 2) for part in table)
    mu = 3.3 * float(critical_amplitude(Duffing(p=1.0)))
    assert table.share[1, 0] == comparison_study.chaotic_starts((mu,), 1.0, columns=4, rows=3, periods=80).share[0] > 0


def test_compared_gives_the_wandering_of_each_forcing():
    mu, ratio, found = comparison_study.compared(1.0, (0.24, 0.26), columns=8, rows=4, periods=120)
    np.testing.assert_allclose(ratio, mu / critical_amplitude(Duffing(p=1.0)))
    alone = wandering(Duffing(p=1.0, mu=np.array([0.26])), starts_between_wells(8, 4), 120, **STEP)
    assert found.exponent[1] == alone.exponent[0]
    assert found.share.shape == found.dissipated.shape == (2,)


def test_the_fixed_step_raises_the_exponent_of_chaos_at_small_p():
    by_step, exact = comparison_study.chaotic_exponents((0.268, 0.272), columns=6, rows=4)
    change = by_step.exponent - exact.exponent
    error = np.hypot(by_step.error, exact.error)
    assert change.mean() > 3 * np.sqrt(np.sum(error**2)) / 2 > 0
    assert change.mean() < 0.03
