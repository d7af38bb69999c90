"""The window of lasting chaos: its parts joined, its order of events, exact values."""

import numpy as np

from book.studies import window
from book.studies.transients import Escape


def test_parts_of_an_escape_are_joined_in_their_order():
    one = Escape(*np.arange(4.0).reshape(4, 1), np.zeros((2, 1)), np.ones((2, 1)), np.array([5.0]))
    found = window.joined([one, one._replace(mu=np.array([7.0]), small=np.full((2, 1), 3.0))])
    assert found.mu.tolist() == [0.0, 7.0]
    assert found.small.tolist() == [[0.0, 3.0], [0.0, 3.0]]


def test_sign_changes_of_straight_lines_are_their_zeros():
    x = np.array([0.0, 1.0, 3.0, 5.0])
    np.testing.assert_allclose(window.sign_changes(x, np.abs(x - 3) - 1.5), [1.5, 4.5], rtol=1e-15)
    assert window.sign_changes(x, x + 1).size == 0
