"""Cases of the figures of the missing parameters: made-up arrays, as `case` says."""

import numpy as np

from book.figures import missing_parameters as figures

from .case import Case, to_roundoff

PAIRS = ("A: first", "B: second")


def _maps():
    alpha, omega = np.linspace(0.05, 0.3, 6), np.linspace(0.4, 1.6, 7)
    exponent = 0.3 * np.sin(np.add.outer(9 * alpha, 5 * omega))
    logs = np.where(exponent > 0, -30 * np.abs(np.subtract.outer(alpha, 0.12 * omega)), np.nan)
    return {"alpha": alpha, "omega": omega, "exponent": exponent, "bound": logs, "logs": 2 * logs}


def _draw_maps(d):
    panels = {"bound": d["bound"], "all": d["logs"]}
    rings = {"A": (0.1, 1.0), "B": (0.2, 1.2)}
    return figures.likelihood_maps(d["alpha"], d["omega"], d["exponent"], panels, rings)


def _ensembles():
    spread = np.linspace(-1, 1, 9)[:, None] ** 3
    return {"chaotic": np.array([0.16, 0.13]) + 0.02 * spread, "regular": np.array([-0.06, -0.01]) + 0.03 * spread}


def _draw_ensembles(d):
    printed = {"nats": (0.175, -0.023), "bits": (0.121, -0.016)}
    return figures.ensembles(PAIRS, d["chaotic"], d["regular"], printed)


def _onsets():
    p, circles = np.linspace(0.1, 3, 30), np.array([0.1, 1.0, 2.0])
    return {
        "p": p,
        "lines": np.array([0.2 / (1 + p), 0.3 / (1 + p)]),
        "circles": circles,
        "nats": np.array([0.35 - 0.05 * circles, [0.33, np.nan, 0.2]]),
        "bits": np.array([0.31 - 0.04 * circles, [0.3, 0.22, 0.19]]),
    }


def _exponents():
    mu = np.linspace(0, 0.4, 41)
    return {
        "mu": mu,
        "small": np.array([0.2 * np.tanh(30 * (mu - 0.27)), 0.15 * np.tanh(20 * (mu - 0.2))]),
        "linear": np.array([0.1 * np.tanh(30 * (mu - 0.22)), 0.18 * np.tanh(40 * (mu - 0.1))]),
    }


def _draw_exponents(d):
    thresholds = {"nats": 0.1, "bits": 0.07}
    return figures.exponents_beside(PAIRS, d["mu"], {0.1: d["small"], 1.0: d["linear"]}, thresholds)


def _motions():
    t = np.linspace(0, 1500, 901)
    wide = np.array([1.4 * np.cos(t / 9), np.sin(t / 7)])
    return {"t": t, "wide": wide, "narrow": np.array([1 + 0.3 * np.cos(t / 5), 0.3 * np.sin(t / 5)])}


def _draw_portraits(d):
    early, late = (d["wide"][:, :600], d["wide"][:, :600:50]), (d["narrow"][:, 600:], d["narrow"][:, 600::40])
    second = (d["narrow"], d["narrow"][:, ::30])
    return figures.portraits_beside(PAIRS, {"chaos": [(None, early), (None, second)], "rest": [(early, late)] * 2})


def _draw_histories(d):
    wide, narrow = (d["t"], d["wide"][0]), (d["t"], d["narrow"][0])
    return figures.histories_beside(PAIRS, {"chaos": [wide, narrow], "rest": [narrow, wide]}, 1200.0)


CASES = {
    "likelihood_maps": Case(_maps, _draw_maps, to_roundoff),
    "ensembles": Case(_ensembles, _draw_ensembles, to_roundoff),
    "onsets_beside": Case(
        _onsets,
        lambda d: figures.onsets_beside(
            PAIRS, d["p"], d["lines"], d["circles"], {"nats": d["nats"], "bits": d["bits"]}
        ),
        to_roundoff,
    ),
    "exponents_beside": Case(_exponents, _draw_exponents, to_roundoff),
    "portraits_beside": Case(_motions, _draw_portraits, to_roundoff),
    "histories_beside": Case(_motions, _draw_histories, to_roundoff),
}
