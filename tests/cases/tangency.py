"""Cases of the figures of the tangency: made-up arrays, as `case` says."""

import numpy as np

from book.figures import tangency as figures

from .case import Case, to_roundoff

P = np.array([0.1, 0.5, 1.0, 2.0])


def _phases():
    phase = np.linspace(0, 2 * np.pi, 60)
    return {
        "phase": phase,
        "curves": np.array([np.cos(phase) - a for a in (0.4, 0.3, 0.2, 0.1)]),
        "theory": np.cos(phase),
    }


def _correction():
    alpha = np.geomspace(0.01, 0.3, 6)
    signed = np.array([alpha, -(alpha**2), alpha - 0.05, 0.1 * alpha])
    return {"alpha": alpha, "correction": signed}


def _frequency():
    omega = np.linspace(0.2, 2.4, 30)
    some = omega[::7]
    return {"omega": omega, "some": some, "ratio": np.outer(P, 1 / omega), "tangency": 1.1 * np.outer(P, 1 / some)}


def _plane():
    alpha, p = np.geomspace(0.01, 1, 12), np.linspace(0.05, 1, 15)
    return {"alpha": alpha, "p": p, "ratio": np.outer(alpha ** (1 / 3), 1.2 - p), "marked": np.array([0.1, 0.1])}


CASES = {
    "collapse": Case(
        _phases,
        lambda d: figures.collapse(d["phase"], dict(zip((0.4, 0.3, 0.2, 0.1), d["curves"], strict=True)), d["theory"]),
        to_roundoff,
    ),
    "tangency_correction": Case(
        _correction, lambda d: figures.tangency_correction(d["alpha"], P, d["correction"]), to_roundoff
    ),
    "tangency_against_frequency": Case(
        _frequency,
        lambda d: figures.tangency_against_frequency(d["omega"], P, d["ratio"], d["some"], d["tangency"]),
        to_roundoff,
    ),
    "frontier": Case(
        _plane, lambda d: figures.frontier(d["p"], d["alpha"], d["ratio"], tuple(d["marked"])), to_roundoff
    ),
}
