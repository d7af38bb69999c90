"""Results kept for the process cannot be changed by one reader for all others."""

import numpy as np
import pytest

from book.remember import remembered


def test_a_result_is_computed_once_whether_asked_for_with_a_list_an_array_or_a_tuple():
    calls = []

    @remembered
    def squares(values):
        calls.append(values)
        return np.array(values) ** 2, {"sum": np.array([sum(values)])}

    for values in ((1, 2), [1, 2], np.array([1, 2])):
        np.testing.assert_array_equal(squares(values)[0], [1, 4])
    assert calls == [(1, 2)]


def test_returned_arrays_are_read_only():
    result = remembered(lambda: (np.zeros(2), {"a": np.zeros(2)}))()
    for array in (result[0], result[1]["a"]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
