"""What the chapter on the contradiction concludes in words, held against its numbers."""

import numpy as np

from duffing.book import comparison_study, findings_contradiction, transient_study


def test_at_equal_forcing_the_exponent_of_chaos_is_smaller_at_small_p_beyond_doubt():
    (small, linear), errors = findings_contradiction.equal_forcing()
    assert small + 4 * np.hypot(*errors) < linear


def test_the_fold_comes_before_the_crisis_at_small_p_and_after_it_at_p_one():
    folds, crises = findings_contradiction.window_ends()
    resolution = transient_study.ABOVE / 2**6
    assert folds[0] + 10 * resolution < crises[0]
    assert crises[1] + 10 * resolution < folds[1]
    assert folds[0] > folds[1] and crises[0] > crises[1]  # Melnikov's order


def test_the_common_forcing_is_in_the_window_of_chaos_at_small_p():
    folds, crises = findings_contradiction.window_ends()
    assert folds[0] < comparison_study.MU_EQUAL < crises[0]
