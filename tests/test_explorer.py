"""The explorer's data are the package's own results, rounded; its page is one piece that needs nothing else."""

import json
import re

import numpy as np
import pytest

from book.pages import explorer, widgets
from duffing import Duffing, lyapunov_spectrum, paper, poincare_section, splitting


@pytest.fixture(scope="module")
def story():
    return explorer.stories(p=(1.0,), amplitudes=(0.02, 0.25, 0.3))[0]


def case(story, mu):
    return next(one for one in story["cases"] if one["mu"] == mu)


def test_the_points_are_the_poincare_section_of_the_same_time(story):
    last = explorer.SETTLED + explorer.POINTS
    osc = Duffing(p=1.0, mu=0.3)
    expected = poincare_section(osc, paper.START, 4, transient=last - 4, method="rk4")
    np.testing.assert_allclose(np.array(case(story, 0.3)["points"])[:, -1] / explorer.SCALE, expected[:, -1], atol=6e-4)


def test_a_periodic_path_closes_and_a_chaotic_one_has_no_period(story):
    for one in story["cases"]:
        path = np.array(one["path"])
        closes = np.abs(path[:, 0] - path[:, -1]).max() <= 2
        assert closes == (one["period"] > 0)
    assert case(story, 0.25)["period"] == 0 and case(story, 0.25)["exponent"] > 0.1
    assert len(case(story, 0.25)["points"][0]) == explorer.POINTS


def test_the_exponent_is_that_of_the_package(story):
    alone = lyapunov_spectrum(Duffing(p=1.0, mu=0.3), paper.START, explorer.SETTLED, 40, k=1, method="rk4")
    assert case(story, 0.3)["exponent"] == pytest.approx(alone.exponents[0], abs=1e-4)


def test_the_splitting_changes_sign_at_the_tangency(story):
    greatest = {one["mu"]: max(one["splitting"]) for one in story["cases"] if one["splitting"] is not None}
    assert all((value > 0) == (mu > story["tangency"]) for mu, value in greatest.items() if value > 100 or value < -100)
    assert greatest[0.02] < -100 and greatest[0.25] > 100
    one = case(story, 0.25)["splitting"]
    assert one[8] / 1e6 == pytest.approx(splitting(Duffing(p=1.0, mu=0.25), np.pi / 2), abs=1e-6)


def test_the_history_begins_at_the_papers_start(story):
    assert all(one["history"][0] == round(paper.START[0] * explorer.SCALE) for one in story["cases"])
    assert all(len(one["history"]) == explorer.HISTORY * explorer.PER_PERIOD_HISTORY + 1 for one in story["cases"])


def test_at_the_papers_small_exponent_only_a_force_too_weak_to_leave_the_hump_has_no_splitting():
    story = explorer.stories(p=(0.1,), amplitudes=(0.02, 0.25))[0]
    assert 0.97 < story["tangency"] / story["mu_c"] < 0.99
    assert case(story, 0.02)["splitting"] is None
    one = case(story, 0.25)["splitting"]
    assert one[8] / 1e6 == pytest.approx(splitting(Duffing(p=0.1, mu=0.25), np.pi / 2), abs=1e-6)
    assert all(one["splitting"] is not None for one in story["cases"] if one["mu"] > 0.06)


def test_the_page_holds_its_data_and_asks_the_network_for_nothing(story):
    page = widgets.widget("explorer", [story]).data
    held = re.search(r'type="application/json"[^>]*>(.*?)</script>', page, re.S)[1]
    assert json.loads(held) == json.loads(json.dumps([story]))
    assert not re.search(r"https?://|\bimport\b|\bfetch\(", page)
    assert len(page) < 100_000


def test_data_cannot_end_the_script_that_holds_them():
    assert "</script><b>" not in widgets.widget("explorer", ["</script><b>"]).data
