"""Regression cases of the figures of the two ends of the window: at p = 1 by the paper's step.

What has gone through Newton's method before it went through chaos differs by round-off and is compared as such.
"""

import numpy as np

from book.figures import window_ends as figures
from book.studies import transients as study
from duffing import Duffing, critical_amplitude

from .case import Case

BELOW_FOLD = (np.array([3e-3, 1e-4]), np.array([40.0, 110.0]), np.array([3.0, 6.0]))


def _edge():
    mu = (0.240, 0.244, 0.249)
    return {"mu": np.array(mu), "distance": study.edge(mu, p=1.0, points=100, method="rk4")}


def _passage():
    distance = (1e-3, 3e-4, 1e-4)
    return {"distance": np.array(distance), "periods": study.passage_time(distance, p=1.0)}


def _order():
    p = np.array([0.5, 1.0])
    crises = study.crises((0.5, 1.0), points=80, steps=3)
    return {
        "p": p,
        "mu_c": critical_amplitude(Duffing(p=p)),
        "folds": study.folds((0.5, 1.0))[0],
        "crises": crises,
    }


def within(**tolerances):
    """Comparison with an absolute tolerance for each array."""

    def compare(data, reference):
        for name, expected in reference.items():
            np.testing.assert_allclose(data[name], expected, atol=tolerances.get(name, 1e-12), err_msg=name)

    return compare


CASES = {
    "edge": Case(
        _edge,
        lambda d: figures.distances_to_basin_boundary({1.0: (d["mu"], d["distance"])}),
        within(distance=0.02),
    ),
    "passage": Case(
        _passage,
        lambda d: figures.passage(d["distance"], d["periods"], (d["distance"][0], d["periods"][0]), BELOW_FOLD),
        within(periods=1),
    ),
    "order": Case(
        _order,
        lambda d: figures.order_of_events(d["p"], d["mu_c"], d["folds"], d["crises"]),
        within(folds=1e-7, crises=1.1e-3),  # a step of the bisection
    ),
}
