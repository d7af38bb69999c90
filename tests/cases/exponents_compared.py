"""Regression cases of the figures that compare the exponents: at p = 1 by the paper's step, the same everywhere."""

from types import SimpleNamespace

import numpy as np

from book.figures import exponents_compared as figures
from book.studies import comparison as study

from .case import Case, to_roundoff
from .window_ends import within


def _compared():
    mu, ratio, found = study.compared(1.0, (0.23, 0.245, 0.26), 10, 6)
    return {"mu": mu, "ratio": ratio, **found._asdict()}


def _draw_compared(data):
    found = SimpleNamespace(**data)
    curve = (found.mu, found.ratio, found.dissipated, found.spread, found.exponent, found.error, found.share > 0.2)
    return figures.exponents_compared({1.0: curve})


def _strong():
    mu = (0.23, 0.245, 0.26)
    return {"mu": np.array(mu), "share": study.chaotic_starts(mu, 1.0, 4, 3, periods=80).share}


CASES = {
    "compared": Case(_compared, _draw_compared, to_roundoff),
    "strong": Case(
        _strong,
        lambda d: figures.strong_forcing({1.0: (d["mu"], d["share"])}),
        within(),
    ),
}
