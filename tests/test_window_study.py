"""The window of lasting chaos: its parts joined, its order of events, exact values."""

import numpy as np
import pytest

from book.studies import window
from book.studies.transients import Escape


def test_parts_of_an_escape_are_joined_in_their_order():
    one = Escape(*np.arange(4.0).reshape(4, 1), np.zeros((2, 1)), np.ones((2, 1)), np.array([5.0]))
    found = window.joined([one, one._replace(mu=np.array([7.0]), small=np.full((2, 1), 3.0))])
    assert found.mu.tolist() == [0.0, 7.0]
    assert found.small.tolist() == [[0.0, 3.0], [0.0, 3.0]]


def test_sign_change_of_a_straight_line_is_its_zero():
    x = np.array([0.0, 1.0, 3.0])
    assert window.sign_change(x, 3 - 2 * x) == pytest.approx(1.5, abs=1e-15)


@pytest.mark.parametrize("y", [[-1.0, 1.0], [1.0, 2.0]])
def test_sign_change_refuses_a_curve_without_one(y):
    with pytest.raises(ValueError, match="must begin above 0"):
        window.sign_change([0.0, 1.0], y)
