"""The data of the basin explorer are the package's basins, letter by letter."""

import re
from dataclasses import replace

import numpy as np
import pytest

from book.pages import basin_explorer, widgets
from duffing import Duffing, poincare_section
from duffing.basins.basins import basins


@pytest.fixture(scope="module")
def picture():
    return basin_explorer.pictures(amplitudes=(0.05,))[0]


def test_the_letters_are_the_labels_of_the_basins(picture):
    x, v = (np.linspace(*picture[name], picture[size]) for name, size in (("x", "columns"), ("v", "rows")))
    found = basins(Duffing(p=1.0, mu=0.05), x, v[10:12], periods=120, **basin_explorer.OPTIONS)
    letters = np.array(list(picture["labels"])).reshape(v.size, x.size)[10:12]
    np.testing.assert_array_equal(letters, np.array(list("AB"))[found.labels])


def test_an_attractors_round_closes_and_holds_its_points(picture):
    assert [one["name"] for one in picture["attractors"]] == ["left well, period 1", "right well, period 1"]
    for one in picture["attractors"]:
        curve, points = np.array(one["path"]), np.array(one["points"])
        assert np.abs(curve[:, 0] - curve[:, -1]).max() <= 1
        np.testing.assert_allclose(curve[:, 0], points[:, 0], atol=1)


def test_a_start_ends_on_the_attractor_of_its_letter(picture):
    osc = replace(Duffing(p=1.0), mu=0.05)
    number = 50 * picture["columns"] + 100
    x = np.linspace(*picture["x"], picture["columns"])[100]
    v = np.linspace(*picture["v"], picture["rows"])[50]
    late = poincare_section(osc, (x, v), 1, transient=300, method="rk4")[:, 0]
    attractor = picture["attractors"]["AB".index(picture["labels"][number])]
    np.testing.assert_allclose(late, np.array(attractor["points"])[:, 0] / basin_explorer.SCALE, atol=1e-3)


def test_the_page_asks_the_network_for_nothing(picture):
    assert not re.search(r"https?://|\bimport\b|\bfetch\(", widgets.widget("basin_explorer", [picture]).data)
