"""The paper's algorithm in thirty lines of NumPy: the page's own cells, run and compared with the package."""

from pathlib import Path

import jupytext
import matplotlib
import numpy as np
import pytest

from duffing import Duffing, trajectory, two_trajectory_exponent

PAGE = Path(__file__).parents[1] / "chapters" / "thirty_lines.md"
CELLS = [cell.source for cell in jupytext.read(PAGE).cells if cell.cell_type == "code"]


@pytest.fixture(scope="module")
def page():
    names = {}
    with matplotlib.rc_context({"backend": "agg"}):
        for cell in CELLS:
            exec(cell, names)
    names["plt"].close("all")
    return names


def test_it_is_no_more_than_thirty_lines_and_needs_nothing_of_the_package():
    *computing, _ = CELLS
    lines = [line for cell in computing for line in cell.splitlines() if line.strip()]
    assert len(lines) <= 30
    assert "duffing" not in "\n".join(CELLS)


def test_its_path_is_the_packages(page):
    t = np.arange(5 * 500 + 1) * page["h"]
    osc = Duffing(alpha=0.1, p=0.1, mu=page["mu"])
    expected = trajectory(osc, (0.45, 0.1), t, method="rk4", steps_per_period=500)[:, 1:]
    found = page["path"][: t.size - 1].transpose(1, 0, 2)
    np.testing.assert_allclose(found, expected, atol=1e-9)  # chaos enlarges the round-off a hundredfold over this time


def test_its_exponents_are_the_packages_as_far_as_chaos_allows(page):
    osc = Duffing(alpha=0.1, p=0.1, mu=page["mu"])
    expected = two_trajectory_exponent(osc, (0.45, 0.1), periods=239, transient=0, d0=1e-8).exponents[0]
    assert abs(page["exponents"][0] - expected[0]) < 0.04  # chaotic: two samples of one mean
    assert page["exponents"][0] > 0.1 > 0 > page["exponents"][1]
    assert abs(page["exponents"][1] - expected[1]) < 0.06  # a transient of another length in each


def test_its_motion_after_1200_is_chaotic_for_one_forcing_and_in_one_well_for_the_other(page):
    late = page["path"][int(1200 / page["h"]) :, 0]
    assert late[:, 0].min() < -1 and late[:, 0].max() > 1
    assert abs(np.sign(late[:, 1]).sum()) == len(late) and np.ptp(late[:, 1]) < 1
