"""The regression cases of the figures on transients: at p = 1 by the paper's step, whose bits are the same everywhere.

What has gone through Newton's method before it went through chaos differs by round-off and is compared as such.
"""

from types import SimpleNamespace

import numpy as np

from book.figures import contradiction as figures
from book.studies import comparison as comparison_study
from book.studies import transients as transient_study
from duffing import Duffing, critical_amplitude
from duffing.transients.survival import exponential, survival

from .case import Case, to_roundoff

BELOW_FOLD = (np.array([3e-3, 1e-4]), np.array([40.0, 110.0]), np.array([3.0, 6.0]))
FOLD, CRISIS = {1.0: 0.2502}, {1.0: 0.247}  # where the lines are drawn


def _survival():
    time, settled, _ = transient_study.sample(0.24, 1.0, 12, 8)
    n, share = survival(time, settled)
    return {"n": n, "share": share, "mean": np.array(exponential(time, settled, 20).mean)}


def _draw_survival(data):
    return figures.survival_curves({"chaos": (data["n"], data["share"], 20, float(data["mean"]))}, 28)


def _escape():
    found = transient_study.escape((0.1, 0.23, 0.245, 0.249, 0.26), 1.0, 12, 8)
    return {name: part for name, part in found._asdict().items() if name != "wanderers"}


def _draw_lifetimes(data):
    found = SimpleNamespace(**data)
    bound = (np.array([0.235]), np.array([300.0]))  # a triangle
    return figures.mean_lifetimes({1.0: (found.mu, found.mean, found.error)}, FOLD, CRISIS, {1.0: bound})


def _draw_rates(data):
    return figures.capture_rates({1.0: (data["mu"], data["small"], data["large"])}, FOLD, CRISIS)


def _edge():
    mu = (0.240, 0.244, 0.249)
    return {"mu": np.array(mu), "distance": transient_study.edge(mu, p=1.0, points=100, method="rk4")}


def _passage():
    distance = (1e-3, 3e-4, 1e-4)
    return {"distance": np.array(distance), "periods": transient_study.passage_time(distance, p=1.0)}


def _order():
    p = np.array([0.5, 1.0])
    crises = transient_study.crises((0.5, 1.0), points=80, steps=3)
    return {
        "p": p,
        "mu_c": critical_amplitude(Duffing(p=p)),
        "folds": transient_study.folds((0.5, 1.0))[0],
        "crises": crises,
    }


def _compared():
    mu, ratio, found = comparison_study.compared(1.0, (0.23, 0.245, 0.26), 10, 6)
    return {"mu": mu, "ratio": ratio, **found._asdict()}


def _draw_compared(data):
    found = SimpleNamespace(**data)
    curve = (found.mu, found.ratio, found.dissipated, found.spread, found.exponent, found.error, found.share > 0.2)
    return figures.exponents_compared({1.0: curve})


def _strong():
    mu = (0.23, 0.245, 0.26)
    return {"mu": np.array(mu), "share": comparison_study.chaotic_starts(mu, 1.0, 4, 3, periods=80).share}


def within(**tolerances):
    """Comparison with an absolute tolerance for each array."""

    def compare(data, reference):
        for name, expected in reference.items():
            np.testing.assert_allclose(data[name], expected, atol=tolerances.get(name, 1e-12), err_msg=name)

    return compare


CASES = {
    "survival": Case(_survival, _draw_survival, to_roundoff),
    "mean_lifetimes": Case(_escape, _draw_lifetimes, to_roundoff),
    "capture_rates": Case(_escape, _draw_rates, to_roundoff),
    "edge": Case(
        _edge,
        lambda d: figures.edge_distances({1.0: (d["mu"], d["distance"])}),
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
    "compared": Case(_compared, _draw_compared, to_roundoff),
    "strong": Case(
        _strong,
        lambda d: figures.strong_forcing({1.0: (d["mu"], d["share"])}),
        within(),
    ),
}
