"""The cast of orbits: where a letter stands on a branch."""

import numpy as np
import pytest

from book.studies import cast
from book.studies.bifurcations import IN_WELL, SADDLE

# A branch that turns back twice: three orbits between mu = 1 and 2.
TURNS = (IN_WELL, np.array([0.0, 2.0, 1.0, 3.0]), np.array([0.0, 1.0, 2.0, 4.0]), np.ones(4, dtype=bool))


def test_a_branch_is_met_as_often_as_it_passes_a_forcing():
    assert cast.met(TURNS, 1.5) == pytest.approx([0.75, 1.5, 2.5])
    assert cast.met(TURNS, 2.5) == pytest.approx([3.5])
    assert cast.met(TURNS, 3.5) == []


def test_letters_count_the_orbits_from_the_smallest_and_none_stands_where_no_orbit_is():
    places = {"S": (IN_WELL, 1.5, 0), "R": (IN_WELL, 1.5, -1), "H": (SADDLE, 1.5, 0)}
    letters = cast.letters([TURNS], places)
    assert [letter for letter, *_ in letters] == ["S", "R"]
    assert [value for *_, value in letters] == pytest.approx([0.75, 2.5])
