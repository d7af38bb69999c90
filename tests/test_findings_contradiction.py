"""What the chapter on the contradiction concludes in words, held against its numbers."""

import numpy as np
import pytest

from book.claims import contradiction as findings_contradiction
from book.studies import comparison as comparison_study
from book.studies import transients as transient_study


def test_at_equal_forcing_the_exponent_of_chaos_is_smaller_at_small_p_beyond_doubt():
    exponents, errors = comparison_study.equal_forcing()
    k = comparison_study.P.index(1.0)
    assert exponents[0] + 4 * np.hypot(errors[0], errors[k]) < exponents[k]


@pytest.mark.parametrize("measure", [comparison_study.equal_forcing, comparison_study.equal_energy])
def test_chaos_at_small_p_has_the_smallest_exponent_of_the_four(measure):
    exponents, errors = measure()
    assert exponents.shape == (len(comparison_study.P),) and comparison_study.P[0] == 0.1
    assert np.all(exponents[1:] - exponents[0] > 3 * np.hypot(errors[1:], errors[0]))


def test_under_strong_forcing_there_is_chaos_at_small_p_and_none_at_p_one_and_two():
    small, *smooth = (comparison_study.chaotic_starts((comparison_study.MU_STRONG,), p) for p in (0.1, 1.0, 2.0))
    assert small.share[0] > 0.1 and small.largest[0] > 2 * comparison_study.CHAOTIC
    assert all(one.share[0] == 0 and one.largest[0] < 0 for one in smooth)


def test_where_two_exponents_are_chaotic_at_one_multiple_of_the_critical_amplitude_the_small_one_is_less_so():
    found = comparison_study.at_equal_ratio(comparison_study.RATIOS[-1:])
    assert np.flatnonzero(found.share[0]).tolist() == [0, comparison_study.P.index(2.0)]
    assert found.exponent[0, 0] + 4 * np.hypot(found.error[0, 0], found.error[0, -1]) < found.exponent[0, -1]


def test_the_fold_comes_before_the_crisis_at_small_p_and_after_it_at_p_one():
    folds, crises = findings_contradiction.window_ends()
    resolution = transient_study.ABOVE / 2**6
    assert folds[0] + 10 * resolution < crises[0]
    assert crises[1] + 10 * resolution < folds[1]
    assert folds[0] > folds[1] and crises[0] > crises[1]  # Melnikov's order


def test_the_common_forcing_is_in_the_window_of_chaos_at_small_p():
    folds, crises = findings_contradiction.window_ends()
    assert folds[0] < comparison_study.MU_EQUAL < crises[0]
