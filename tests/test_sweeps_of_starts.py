"""Basins, fates, lifetimes and diagrams go through `sweep`: bit for bit the same in blocks, elsewhere, and resumed."""

from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
from sweep_cases import context

from book.studies import basins as basin_study
from book.studies import transients as transient_study
from duffing import Duffing, blocks, poincare_section
from duffing.basins.attractors import find_attractors, settle
from duffing.basins.basins import basins
from duffing.basins.fates import classify
from duffing.orbits.diagram import bifurcation_diagram
from duffing.sweep.checkpoint import Checkpoint
from duffing.transients.lifetimes import lifetimes

LOOSE = {"rtol": 1e-6, "atol": 1e-8}
RK4 = {"method": "rk4", "steps_per_period": 100}
STARTS = np.random.default_rng(8).uniform(-1, 1, (2, 60))
FAMILY = Duffing(p=np.tile([0.3, 1.0, 2.0], 20), mu=np.linspace(0.2, 0.3, 60))
# Two of three attractors are known at first: the search for the third comes between two sweeps.
KNOWN = find_attractors(Duffing(mu=0.2), **RK4)[1:]
CHAOS = Duffing(p=0.1, mu=0.27)


def _settled(**run):
    return settle(Duffing(mu=0.2), STARTS, KNOWN, phase=1.0, **run, **RK4)[:2]


def _in_chaos(**run):
    return settle(CHAOS, STARTS, CHAOTIC, periods=70, **run, **LOOSE)[:2]


def _basins(**run):
    grid = np.linspace(-1, 1, 8)
    return basins(Duffing(mu=0.2), grid, grid, KNOWN, **run, **RK4)[3:5]


def _lifetimes(**run):
    return lifetimes(FAMILY, STARTS, 120, tangents=1, **run, **LOOSE)


def _without_growth(**run):
    return lifetimes(FAMILY, STARTS, 120, **run, **LOOSE)


def _fates(**run):
    return (classify(FAMILY, STARTS, 12, **run, **LOOSE),)


def _points(**run):
    return (poincare_section(FAMILY, STARTS, 5, 4, phase=2.0, **run),)


def _diagram(**run):
    return bifurcation_diagram(Duffing(p=[0.5, 1.0]), [0.2, 0.25, 0.3], STARTS[:, :10], 6, 3, **run, **LOOSE)


CASES = [_settled, _in_chaos, _basins, _lifetimes, _without_growth, _fates, _points, _diagram]
CHAOTIC = find_attractors(CHAOS, STARTS, **LOOSE)


@pytest.fixture(scope="module")
def processes():
    with ProcessPoolExecutor(2, mp_context=context()) as pool:
        yield pool


def _same(one, other):
    assert len(one) == len(other) > 0
    for a, b in zip(one, other, strict=True):
        np.testing.assert_array_equal(a, b)


def test_the_cases_say_something():
    """Labels found before and after a search, chaos among them; captured orbits and others; several fates."""
    assert {0, 2} <= set(_settled()[0]) and max(_settled()[1]) > 32
    assert [one.period for one in CHAOTIC] == [1, 0] and set(_in_chaos()[0]) == {0, 1}
    assert {True, False} == set(_lifetimes().settled) and len(set(_fates()[0])) >= 3


def test_a_stay_in_chaos_counts_on_over_a_search():
    """After 20 periods on end it is caught; the sweep ends, and goes on after a search, at the period 32."""
    label, period = settle(CHAOS, np.random.default_rng(8).uniform(-1, 1, (2, 200)), CHAOTIC, periods=51, **LOOSE)[:2]
    assert np.any(period[label == 1] > 32)


@pytest.mark.parametrize("case", CASES)
def test_in_blocks_on_threads(case, monkeypatch):
    whole, seen = case(), []
    monkeypatch.setattr(blocks, "BLOCK_SECONDS", 1e-9)  # the smallest blocks
    _same(case(progress=lambda done, total: seen.append((done, total))), whole)
    assert len(seen) > 2 and seen[-1][0] == seen[-1][1]


@pytest.mark.parametrize("case", CASES)
def test_in_processes(case, processes, monkeypatch):
    whole = case()
    monkeypatch.setattr(blocks, "BLOCK_SECONDS", 1e-9)
    _same(case(executor=processes), whole)


@pytest.mark.parametrize("case", CASES)
def test_resumed_from_what_an_interrupted_run_has_kept(case, tmp_path, monkeypatch):
    whole = case()
    monkeypatch.setattr(blocks, "BLOCK_SECONDS", 1e-9)

    class Interrupted(Exception):
        pass

    def interrupt(done, total):
        if done > total / 2:
            raise Interrupted

    with pytest.raises(Interrupted):
        case(checkpoint=tmp_path, progress=interrupt)
    before = {path: path.stat().st_mtime_ns for path in tmp_path.glob("*.block")}
    assert before
    _same(case(checkpoint=tmp_path), whole)
    after = {path: path.stat().st_mtime_ns for path in tmp_path.glob("*.block")}
    assert len(after) > len(before) and before.items() <= after.items()
    monkeypatch.setattr(Checkpoint, "keep", None)  # nothing is left to compute
    _same(case(checkpoint=tmp_path), whole)


def test_the_studies_of_the_book_pass_on_how_they_run(tmp_path):
    pictures = [basin_study.picture(1.0, ratio=2.0, size=12, **run) for run in ({}, {"checkpoint": str(tmp_path)})]
    _same(pictures[0][3:5], pictures[1][3:5])
    kept = len(list(tmp_path.glob("*.block")))
    assert kept > 0
    escapes = [transient_study.escape((0.26,), columns=3, rows=2, **run) for run in ({}, {"checkpoint": str(tmp_path)})]
    _same(*escapes)
    assert len(list(tmp_path.glob("*.block"))) > kept
