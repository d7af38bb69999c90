"""The uncertainty exponent on boundaries whose dimension is known."""

import numpy as np
import pytest

from duffing import ConvergenceError, Duffing
from duffing.basins.fates import classify
from duffing.basins.uncertainty import dimension, uncertain_starts

BOX = ((-1.0, 1.0), (-1.0, 1.0))


def cantor(states):
    """Strips along v over the gaps of the middle-third set of x in [0, 1], labelled by the gap's generation."""
    x, label = states[0].copy(), np.zeros(states.shape[1], dtype=int)
    for generation in range(1, 30):
        gap = (x > 1 / 3) & (x < 2 / 3) & (label == 0)
        label[gap] = generation
        x = np.where(x > 0.5, 3 * x - 2, 3 * x)
    return np.where((states[0] < 0) | (states[0] > 1), -1, label)


def test_a_straight_boundary_has_dimension_one_and_its_uncertain_part_is_exact():
    eps, starts = np.geomspace(1e-3, 0.1, 7), 2**15
    counts = uncertain_starts(lambda states: states[0] > 0.3, BOX, eps, starts)
    np.testing.assert_array_less(np.abs(counts / starts - eps), 4 * np.sqrt(eps / starts))  # 2 eps of a width of 2
    found = dimension(eps, counts, starts)
    assert abs(found.value - 1) < 4 * found.error < 0.2


def test_strips_over_the_middle_third_set_have_its_dimension():
    eps, starts = 3.0 ** -np.arange(5, 11), 2**17  # at larger distances the next term, of order 2^-k, is seen
    found = dimension(eps, uncertain_starts(cantor, ((0.0, 1.0), (0.0, 1.0)), eps, starts), starts)
    assert abs(found.value - (1 + np.log(2) / np.log(3))) < 4 * found.error < 0.1


def test_the_error_is_the_scatter_of_the_dimension_over_seeds():
    eps, starts = np.geomspace(1e-2, 0.1, 5), 2**10
    found = [
        dimension(eps, uncertain_starts(lambda y: y[0] > 0.3, BOX, eps, starts, seed), starts) for seed in range(60)
    ]
    scatter = np.std([one.value for one in found], ddof=1)
    assert scatter == pytest.approx(np.mean([one.error for one in found]), rel=0.4)


def test_the_same_seed_gives_the_same_starts_and_another_seed_others():
    one, same, other = (uncertain_starts(lambda y: y[0] > 0.3, BOX, 0.1, 2**12, seed) for seed in (1, 1, 2))
    assert one == same != other


def test_the_unforced_double_well_has_a_smooth_boundary():
    eps, starts = np.geomspace(1e-3, 0.1, 5), 2**12

    def wells(states):
        return classify(Duffing(), states, 12, method="rk4", steps_per_period=64)

    counts = uncertain_starts(wells, ((-1.5, 1.5), (-1.0, 1.0)), eps, starts)
    found = dimension(eps, counts, starts)
    assert abs(found.value - 1) < 4 * found.error < 0.3


def test_without_uncertain_starts_there_is_no_dimension():
    eps = np.array([0.1, 0.2, 0.3])
    with pytest.raises(ConvergenceError, match=r"^uncertain = "):
        dimension(eps, uncertain_starts(lambda states: states[0] > 5, BOX, eps, 100), 100)


def test_distances_must_be_positive():
    with pytest.raises(ValueError, match=r"^eps = "):
        uncertain_starts(lambda states: states[0] > 0, BOX, [0.1, 0.0])
