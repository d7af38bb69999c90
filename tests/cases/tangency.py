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


def _lobes():
    t = np.linspace(-4, 4, 60)
    loop = np.array([1 / np.cosh(t), -np.tanh(t) / np.cosh(t)])
    return {"loop": loop, "scale": np.array([0.9, 1.0, 1.1])}


def _draw_lobes(d):
    cases = [(f"{s:g}", [d["loop"] * s], [d["loop"]]) for s in d["scale"]]
    return figures.lobes(d["loop"], cases, ((0.9, 1.05), (-0.3, 0.3)))


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


def _parting():
    t, phase = np.linspace(0, 20, 80), np.linspace(0, 2 * np.pi, 40)
    x = np.array([np.cos(t / 3), np.cos(t / 3) - 0.1 * t]).T
    return {
        "t": t,
        "x": x,
        "x_s": np.array(1.02),
        "phase": phase,
        "split": np.array([np.cos(phase) - a for a in (1.2, 1, 0.8)]),
    }


def _against_exponent():
    return {"p": P, "ratios": np.array([0.97 + 0.02 * P, 0.99 + 0.005 * P]), "dry": np.array([0.968, 0.989])}


def _scaled():
    alpha = np.geomspace(1e-4, 0.1, 9)
    return {
        "alpha": alpha,
        "corrections": np.array([-(0.3 + 0.1 * np.sin(np.log(alpha) + s)) * alpha for s in (0, 1, 2)]),
    }


CASES = {
    "collapse": Case(
        _phases,
        lambda d: figures.collapse(d["phase"], dict(zip((0.4, 0.3, 0.2, 0.1), d["curves"], strict=True)), d["theory"]),
        to_roundoff,
    ),
    "lobes": Case(_lobes, _draw_lobes, to_roundoff),
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
    "parting": Case(
        _parting,
        lambda d: figures.parting(
            d["t"], d["x"], float(d["x_s"]), d["phase"], dict(zip((0.9, 1.0, 1.1), d["split"], strict=True))
        ),
        to_roundoff,
    ),
    "ratio_against_exponent": Case(
        _against_exponent,
        lambda d: figures.ratio_against_exponent(
            d["p"], dict(zip((0.1, 0.02), d["ratios"], strict=True)), dict(zip((0.1, 0.02), d["dry"], strict=True))
        ),
        to_roundoff,
    ),
    "scaled_correction": Case(
        _scaled,
        lambda d: figures.scaled_correction(d["alpha"], dict(zip((0, 0.1, 0.2), d["corrections"], strict=True))),
        to_roundoff,
    ),
}
