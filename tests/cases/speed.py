"""Cases of the figures of cost: made-up arrays."""

import numpy as np

from book.figures import speed as figures

from .case import Case, to_roundoff

NAMES = ("one", "two", "three")
ABSCISSAE = {"log": np.geomspace(1, 100, 4), "linear": np.linspace(0.1, 0.9, 4)}


def _medians():
    return {"0.1": np.array([1.5, 20.0, np.nan]), "1.0": np.array([0.5, 3.0, 40.0])}


def _draw_ratios(d):
    return figures.ratios(NAMES, {float(p): values for p, values in d.items()})


def _costs():
    return {
        f"{kernel} {scale}": 1 + k + x / 30
        for k, kernel in enumerate(figures.KERNELS)
        for scale, x in ABSCISSAE.items()
    }


def _draw_growth(d):
    series = {
        ("size", scale): {kernel: (x, d[f"{kernel} {scale}"]) for kernel in figures.KERNELS}
        for scale, x in ABSCISSAE.items()
    }
    return figures.cost_growth(series)


CASES = {
    "ratios": Case(_medians, _draw_ratios, to_roundoff),
    "cost_growth": Case(_costs, _draw_growth, to_roundoff),
}
