"""Cases of the book's own figures (figures_beyond.py) for the regression of figures, see figure_cases.py.

What is drawn is the point here: made-up arrays in which no two rows are alike, so that a swapped colour, marker or row,
or one quantity in place of another, alters the picture. The quantities themselves are tested where they are computed.
"""

import numpy as np
from figure_cases import Case, to_roundoff

from duffing.book import figures_beyond

P = np.array([0.1, 0.5, 1.0, 2.0])
MU = np.linspace(0.0, 0.5, 51)


def _maps():
    alpha, omega = np.linspace(0.05, 0.3, 6), np.linspace(0.4, 1.6, 7)
    spread = np.abs(np.subtract.outer(alpha, 0.1 * omega))
    criteria = np.array([spread < limit for limit in (0.05, 0.1, 0.15, 0.2, 0.22)])
    return {"alpha": alpha, "omega": omega, "criteria": criteria, "chosen": np.array([alpha[1], omega[3]])}


def _draw_maps(d):
    named = {f"criterion {number}": agrees for number, agrees in enumerate(d["criteria"])}
    return figures_beyond.scan_map(d["alpha"], d["omega"], named, tuple(d["chosen"]))


def _headline():
    p = np.linspace(0.05, 3.0, 40)
    return {
        "p": p,
        "line": 0.16 / (1 + p),
        "p_on": P,
        "tangency": 0.16 / (1 + P),
        "onset": np.array([0.27, np.nan, 0.24, 0.18]),
    }


def _work():
    evaluations = np.geomspace(1e2, 1e4, 5)
    orders = np.arange(1, 6)[:, None] * np.array([[1.0, 0.5]]).T[:, None]
    return {"evaluations": evaluations, "error": evaluations ** (-orders)}


def _draw_work(d):
    tables = {
        p: {name: (d["evaluations"], error) for name, error in zip(figures_beyond.METHODS, errors, strict=True)}
        for p, errors in zip((1.0, 0.1), d["error"], strict=True)
    }
    return figures_beyond.work_precision(tables)


def _exponents():
    return {"mu": MU, "coarse": 0.2 * np.sin(9 * MU) - 0.1, "mu_exact": MU[5:40], "exact": 0.1 - MU[5:40]}


def _starts():
    exponents = np.array([0.1 - MU, 0.05 * np.cos(20 * MU), MU - 0.3])
    return {"mu": MU, "exponents": exponents, "paper": 0.15 * np.sin(12 * MU)}


def _limit():
    return {"p": P, "mu": np.array([0.1, 0.2, 0.3, 0.4]), "exponents": np.subtract.outer(P / 10, [0.02, 0.1, 0.2, 0.5])}


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
    "scan_map": Case(_maps, _draw_maps, to_roundoff),
    "headline": Case(
        _headline,
        lambda d: figures_beyond.headline(d["p"], d["line"], d["p_on"], d["tangency"], d["p_on"], d["onset"]),
        to_roundoff,
    ),
    "work_precision": Case(_work, _draw_work, to_roundoff),
    "resolved_exponents": Case(
        _exponents,
        lambda d: figures_beyond.resolved_exponents(d["mu"], d["coarse"], d["mu_exact"], d["exact"], 0.1),
        to_roundoff,
    ),
    "many_starts": Case(
        _starts, lambda d: figures_beyond.many_starts(d["mu"], d["exponents"], d["mu"], d["paper"]), to_roundoff
    ),
    "dry_limit": Case(_limit, lambda d: figures_beyond.dry_limit(d["p"], d["exponents"], d["mu"]), to_roundoff),
    "collapse": Case(
        _phases,
        lambda d: figures_beyond.collapse(
            d["phase"], dict(zip((0.4, 0.3, 0.2, 0.1), d["curves"], strict=True)), d["theory"]
        ),
        to_roundoff,
    ),
    "tangency_correction": Case(
        _correction, lambda d: figures_beyond.tangency_correction(d["alpha"], P, d["correction"]), to_roundoff
    ),
    "tangency_against_frequency": Case(
        _frequency,
        lambda d: figures_beyond.tangency_against_frequency(d["omega"], P, d["ratio"], d["some"], d["tangency"]),
        to_roundoff,
    ),
    "frontier": Case(
        _plane, lambda d: figures_beyond.frontier(d["p"], d["alpha"], d["ratio"], tuple(d["marked"])), to_roundoff
    ),
}
