"""Regression cases of the figures of transients: at p = 1 by the paper's step, whose bits are the same everywhere."""

from types import SimpleNamespace

import numpy as np

from book.figures import transients as figures
from book.studies import transients as study
from book.studies.survival import exponential, survival

from .case import Case, to_roundoff

FOLD, CRISIS = {1.0: 0.2502}, {1.0: 0.247}  # where the lines are drawn


def _survival():
    time, settled, _ = study.sample(0.24, 1.0, 12, 8)
    n, share = survival(time, settled)
    return {"n": n, "share": share, "mean": np.array(exponential(time, settled, 20).mean)}


def _draw_survival(data):
    return figures.survival_curves({"chaos": (data["n"], data["share"], 20, float(data["mean"]))}, 28)


def _escape():
    found = study.escape((0.1, 0.23, 0.245, 0.249, 0.26), 1.0, 12, 8)
    return {name: part for name, part in found._asdict().items() if name != "wanderers"}


def _draw_lifetimes(data):
    found = SimpleNamespace(**data)
    bound = (np.array([0.235]), np.array([300.0]))  # a triangle
    return figures.mean_lifetimes({1.0: (found.mu, found.mean, found.error)}, FOLD, CRISIS, {1.0: bound})


def _draw_rates(data):
    return figures.capture_rates({1.0: (data["mu"], data["small"], data["large"])}, FOLD, CRISIS)


CASES = {
    "survival": Case(_survival, _draw_survival, to_roundoff),
    "mean_lifetimes": Case(_escape, _draw_lifetimes, to_roundoff),
    "capture_rates": Case(_escape, _draw_rates, to_roundoff),
}
