"""Cases of the figures of the friction time: made-up arrays, as `case` says."""

import numpy as np

from book.figures import friction_time as figures

from .case import Case, to_roundoff


def _work():
    evaluations = np.geomspace(1e2, 1e4, 5)
    orders = np.arange(1, 6)[:, None] * np.array([[1.0, 0.5]]).T[:, None]
    return {"evaluations": evaluations, "error": evaluations ** (-orders)}


def _draw_work(d):
    tables = {
        p: {name: (d["evaluations"], error) for name, error in zip(figures.METHODS, errors, strict=True)}
        for p, errors in zip((1.0, 0.1), d["error"], strict=True)
    }
    return figures.work_precision(tables)


CASES = {
    "work_precision": Case(_work, _draw_work, to_roundoff),
}
