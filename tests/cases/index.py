"""Cases of the figures of the first page: made-up arrays, as `case` says."""

import numpy as np

from book.figures import index as figures

from .case import Case, to_roundoff

P = np.array([0.1, 0.5, 1.0, 2.0])


def _headline():
    p = np.linspace(0.05, 3.0, 40)
    return {
        "p": p,
        "line": 0.16 / (1 + p),
        "p_on": P,
        "tangency": 0.16 / (1 + P),
        "onset": np.array([0.27, np.nan, 0.24, 0.18]),
    }


CASES = {
    "headline": Case(
        _headline,
        lambda d: figures.headline(d["p"], d["line"], d["p_on"], d["tangency"], d["p_on"], d["onset"]),
        to_roundoff,
    ),
}
