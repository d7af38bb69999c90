"""The case of the planes of lambda_1: made-up arrays."""

import numpy as np

from book.figures import maps as figures

from .case import Case, to_roundoff


def _plane():
    p, mu = np.linspace(0.1, 2.0, 9), np.linspace(0.05, 0.5, 7)
    crosses = np.array([[0.5, 1.0, 1.5], [0.2, 0.15, 0.1]])
    return {
        "p": p,
        "mu": mu,
        "exponent": np.add.outer(mu - 0.3, 0.1 * np.sin(3 * p)),
        "line": 0.4 / (1 + p),
        "crosses": crosses,
    }


def _draw(d):
    return figures.exponent_plane(d["p"], d["mu"], d["exponent"], (d["p"], d["line"]), d["crosses"], "exponent")


CASES = {"exponent_plane": Case(_plane, _draw, to_roundoff)}
