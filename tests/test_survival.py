"""The exponential law of lifetimes: on samples whose law is known, and on maps whose escape rate is known."""

import numpy as np
import pytest

from book.studies.survival import exponential, law_test, rate, survival
from duffing import ConvergenceError

SEED = 314159


def drawn(mean, size, until, seed=SEED):
    """Lifetimes in whole periods from the exponential law, watched for `until` periods."""
    time = np.ceil(np.random.default_rng(seed).exponential(mean, size)).astype(int)
    return np.minimum(time, until), time < until


def open_tent(slope, size=20_000, until=60):
    """Escape times of x -> slope min(x, 1 - x) from the unit interval, slope > 2, from evenly random starts."""
    x = np.random.default_rng(SEED).uniform(size=size)
    time = np.full(size, until)
    alive = np.ones(size, dtype=bool)
    for n in range(1, until + 1):
        x[alive] = slope * np.minimum(x[alive], 1 - x[alive])
        out = alive & (x > 1)
        time[out], alive = n, alive & ~out
    return time, ~alive


@pytest.mark.parametrize("slope", [3.0, 2.5, 5.0])
def test_open_tent_map_has_its_escape_rate(slope):
    """Even density stays even: 2 / slope of it survives each step, so tau = 1 / ln(slope / 2)."""
    fit = exponential(*open_tent(slope))
    assert abs(fit.mean - 1 / np.log(slope / 2)) < 4 * fit.error
    assert fit.error < 0.02 * fit.mean


def test_mean_lifetime_of_a_censored_sample_is_met_within_its_error():
    """Half of the sample is still alive when the watch ends: dropping or counting them as deaths is off by far."""
    mean = 300.0
    fits = [exponential(*drawn(mean, 1000, 200, seed)) for seed in range(40)]
    off = np.array([(fit.mean - mean) / fit.error for fit in fits])
    assert abs(off.mean()) < 4 / np.sqrt(off.size)
    assert 0.7 < off.std() < 1.35


def test_the_law_has_no_memory():
    time, settled = drawn(50.0, 20_000, 400)
    early, late = exponential(time, settled), exponential(time, settled, since=60)
    assert late.events < early.events
    assert abs(late.mean - 50) < 4 * late.error


def test_survival_curve_is_the_share_of_survivors_where_nothing_is_censored():
    time = np.array([3, 1, 3, 8])
    n, share = survival(time, np.ones(4, dtype=bool))
    np.testing.assert_array_equal(n, [0, 1, 3, 8])
    np.testing.assert_allclose(share, [1, 0.75, 0.25, 0])


def test_survival_curve_counts_the_censored_as_at_risk_until_then():
    """Kaplan and Meier by hand: 1 of 4 dies at 1, one is lost from sight at 2, 1 of the 2 left dies at 5."""
    n, share = survival([1, 2, 5, 6], np.array([True, False, True, False]))
    np.testing.assert_array_equal(n, [0, 1, 5])
    np.testing.assert_allclose(share, [1, 3 / 4, 3 / 8])


def test_survival_curve_of_the_law_is_the_exponential():
    n, share = survival(*drawn(40.0, 20_000, 100))
    np.testing.assert_allclose(share, np.exp(-n / 40), atol=0.015)
    assert n[-1] < 100


def test_rates_of_two_destinations_are_those_of_competing_exponentials():
    draw = np.random.default_rng(SEED)
    first, second = np.ceil(draw.exponential([[200.0], [50.0]], (2, 20_000))).astype(int)
    time = np.minimum(first, second)
    for captured, expected in ((first < second, 1 / 200), (second < first, 1 / 50)):
        value, error = rate(time, captured)
        assert abs(value - expected) < 0.03 * expected  # ties within a period belong to neither: a fortieth
        assert error < 0.03 * expected


def test_a_destination_that_captures_nobody_has_the_rate_zero_below_one_capture():
    assert rate([10, 20], np.array([False, False])) == (0.0, 1 / 30)


def test_law_test_accepts_the_law_and_rejects_another():
    """Of samples of the law itself the probability is even between 0 and 1; without new fits it would be too large."""
    accepted = [
        law_test(*drawn(60.0, 200, 500, seed), until=500, resamples=20, seed=1000 + seed)[1] for seed in range(400)
    ]
    assert abs(np.mean(accepted) - 0.5) < 4 / np.sqrt(12 * 400)
    fixed = 30 + np.random.default_rng(SEED).integers(0, 30, 300)
    assert law_test(fixed, np.ones(300, dtype=bool), resamples=100)[1] == 0


def test_a_sample_without_captures_has_no_mean():
    with pytest.raises(ConvergenceError, match=r"none of 2 orbits was captured in 30 periods"):
        exponential([10, 20], np.array([False, False]))
    with pytest.raises(ConvergenceError, match=r"^since = 50: no orbit"):
        rate([10, 20], np.array([True, False]), since=50)


@pytest.mark.parametrize(
    ("time", "settled", "message"),
    [
        ([1, 2], np.array([True]), "^settled has 1 marks, time has 2 numbers"),
        ([1, 2], np.array([1, 0]), "^settled = "),
        ([], np.array([], dtype=bool), r"^time = \[\]: must be"),
        ([1.5, 2.0], np.array([True, True]), "^time = "),
        ([-1, 2], np.array([True, True]), "^time = "),
    ],
)
def test_bad_samples_are_named(time, settled, message):
    with pytest.raises(ValueError, match=message):
        exponential(time, settled)
