"""The laboratory's page: coefficients of the right order, the paper's runs, one piece that needs no network."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from book.pages import laboratory
from duffing import Duffing, paper

SCRIPTS = sorted((Path(laboratory.__file__).parent).glob("laboratory*.js"))


@pytest.fixture(scope="module")
def page():
    return laboratory.laboratory().data


def test_the_explicit_coefficients_integrate_polynomials_of_degree_seven_exactly():
    table = laboratory.coefficients()
    rows = [np.array(row) for row in table["explicit"]]
    nodes = np.array([0.0, *(row.sum() for row in rows[:-1])])
    last = rows[-1]
    for degree in range(8):
        assert last @ nodes[: last.size] ** degree == pytest.approx(1 / (degree + 1), abs=1e-14)


def test_the_implicit_coefficients_are_those_of_collocation_with_five_stages():
    table = laboratory.coefficients()
    nodes, weights = np.array(table["nodes"]), np.array(table["implicit"])
    assert weights.shape == (5, 5) and nodes[-1] == 1
    for degree in range(5):
        np.testing.assert_allclose(weights @ nodes**degree, nodes ** (degree + 1) / (degree + 1), atol=1e-14)
    for degree in range(9):  # order nine
        assert weights[-1] @ nodes**degree == pytest.approx(1 / (degree + 1), abs=1e-14)


def test_the_buttons_load_the_papers_runs():
    runs = {one["name"]: one for one in laboratory.presets()}
    assert set(runs) == {"Fig. 5a", "Fig. 5b", "Fig. 4a", "Fig. 4b"}
    for one in runs.values():
        x, v, transient = (one["values"][name] for name in ("x", "v", "transient"))
        osc = Duffing(**{k: value for k, value in one["values"].items() if k not in ("x", "v", "transient")})
        assert (x, v) == paper.START and one["periods"] == paper.PERIODS
        assert (osc.alpha, osc.omega, osc.delta, osc.gamma) == (0.1, 1, -1, 1)
        if not one["scan"]:
            assert abs(transient * osc.period - paper.SETTLED) < osc.period / 2
    assert (runs["Fig. 5a"]["values"]["p"], runs["Fig. 5a"]["values"]["mu"]) == (0.1, 0.27)
    assert (runs["Fig. 5b"]["values"]["p"], runs["Fig. 5b"]["values"]["mu"]) == (0.1, 0.25)
    assert (runs["Fig. 4a"]["values"]["p"], runs["Fig. 4b"]["values"]["p"]) == (0.1, 1.0)
    assert {0.25, 0.27} <= set(laboratory.SCAN)


def test_the_page_is_one_piece_that_asks_the_network_for_nothing(page):
    assert not re.search(r"https?://|\bimport\b|\bfetch\(|\brequire\(|<link|<img", page)
    assert len(page) < 100_000
    held = json.loads(re.search(r'type="application/json"[^>]*>(.*?)</script>', page, re.S)[1])
    assert held["table"] == laboratory.coefficients()
    assert not re.search(r"\b(DATA|SCRIPTS|PERIODS)\b", page)


def test_no_script_ends_before_it_should_and_each_holds_one_idea(page):
    assert page.count("<script") == page.count("</script>") == 2
    for path in SCRIPTS:
        text = path.read_text(encoding="utf-8")
        assert text.startswith("// ") and text.count("\n") <= 250, path.name
        assert text in page, path.name
