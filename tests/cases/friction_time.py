"""Cases of the figures of the friction time: error against work from made-up arrays, as `case` says."""

from dataclasses import replace

import numpy as np

from book.figures import friction_time as figures
from book.studies import friction_pictures as pictures
from duffing import paper

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


def _crossing():
    turn = pictures.path(replace(paper.OSCILLATOR, mu=0.27), paper.START, 1.4, 2.8, points=300)
    return {"t": turn.t, "s": turn.s, "rows": np.array([turn.x, turn.v, turn.damping])}


def _creep():
    period = paper.OSCILLATOR.period
    slip = pictures.path(replace(paper.OSCILLATOR, mu=0.08), paper.START, 20 * period, 22 * period, points=300)
    return {"periods": slip.t / period, "x": slip.x, "damping": slip.damping, "force": slip.force}


def near(data, reference):
    """To a line's width: Y is steep in time where v crosses zero."""
    for name, expected in reference.items():
        np.testing.assert_allclose(data[name], expected, atol=1e-4, err_msg=name)


CASES = {
    "crossing": Case(_crossing, lambda d: figures.crossing(d["t"], d["s"], d["rows"]), near),
    "creep": Case(_creep, lambda d: figures.creep(d["periods"], d["x"], d["damping"], d["force"]), near),
    "work_precision": Case(_work, _draw_work, to_roundoff),
}
