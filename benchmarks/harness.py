"""Timing side by side: interleaved rounds, a base timed next to everybody, and no time without a right answer."""

import statistics
import time
import warnings
from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Contestant(NamedTuple):
    """name; prepare() returns the function that is timed (compiling is not); work it does, in any unit, common to all;
    check(answer) returns what is wrong with its answer, or None."""

    name: str
    prepare: Callable
    work: float
    check: Callable


class Result(NamedTuple):
    """name; ratios of its time for the work to the base's, one a round (empty: no time counts); what happened."""

    name: str
    ratios: tuple
    remark: str

    def summary(self):
        """Median and range as a line of text, or what happened instead."""
        if not self.ratios:
            return self.remark
        line = f"{statistics.median(self.ratios):9.3g}   ({min(self.ratios):.3g} to {max(self.ratios):.3g})"
        return f"{line}   {self.remark}".rstrip()

    def record(self):
        """The same as a dictionary for the stored record."""
        if not self.ratios:
            return {"remark": self.remark}
        ends = {"median": statistics.median(self.ratios), "least": min(self.ratios), "greatest": max(self.ratios)}
        return {name: float(f"{value:.3g}") for name, value in ends.items()} | {"remark": self.remark}


def compare(base, others, rounds, clock=time.process_time):
    """Results of the others, in their order; one that fails, or ever answers wrongly, is listed with what happened.

    Everybody runs once first, unmeasured. Then in each round everybody runs between two runs of the base, whose mean is
    what its time is divided by: a machine that slows down slows both. A wrong base raises an ArithmeticError.
    """
    run, wrong = _first(base)
    if wrong:
        raise ArithmeticError(f"{base.name}: {wrong}")
    runs, ratios = {}, {other.name: [] for other in others}
    remarks = dict.fromkeys(ratios, "")
    for other in others:
        runs[other.name], remarks[other.name] = _first(other)
    for _ in range(rounds):
        before = _timed(base, run, clock)[1]
        for other in others:
            if not remarks[other.name]:
                wrong, seconds = _timed(other, runs[other.name], clock)
                after = _timed(base, run, clock)[1]
                ratios[other.name].append(seconds / ((before + after) / 2))
                remarks[other.name], before = wrong, after
    return [Result(name, () if remarks[name] else tuple(found), remarks[name]) for name, found in ratios.items()]


def agreement(expected, tolerance):
    """A check for `Contestant`: an answer (rows, N) equals the last rows of expected to within the tolerance of each.

    expected : (k, N), rows <= k; tolerance : (k,). An answer that is not finite is wrong.
    """
    tolerance = np.asarray(tolerance, dtype=float)

    def check(answer):
        rows = len(answer)
        off = np.abs(answer - expected[-rows:]).max(axis=1)
        for size, allowed in zip(off, tolerance[-rows:], strict=True):
            if not size <= allowed:
                return f"a wrong answer, by {size:.1g} (allowed: {allowed:g})"
        return None

    return check


def _first(contestant):
    """(the function to time, what is wrong with it or "")."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what a solver complains of shows in its answer
            run = contestant.prepare()
            return run, contestant.check(run()) or ""
    except ImportError as error:
        return None, f"not installed ({error.name})" if error.name else f"not installed: {error}"
    except Exception as error:  # whatever other software does on failing: it is told, and the rest goes on
        return None, f"fails: {' '.join(str(error).split())[:120] or type(error).__name__}"


def _timed(contestant, run, clock):
    """(what is wrong with the answer or "", time for a unit of work)."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # as above
        start = clock()
        answer = run()
        seconds = clock() - start
    return contestant.check(answer) or "", seconds / contestant.work
