"""The regression cases of the figures on the plane: how they are drawn, from made-up arrays; shares by brute force."""

import numpy as np

from book.figures import plane as figures
from book.studies import plane as study

from .case import Case, to_roundoff

GRID = {"values": np.array([0.95, 1.0, 1.05]), "mu": np.array([0.2, 0.25, 0.3, 0.35])}
FORCINGS = (0.2, 0.235, 0.25, 0.26)


def _regions():
    across = np.array([[0, 0, 0], [0, 0.25, 1], [0, 0.5, 1], [0, 0, 0.75]])
    lines = {"fold": [0.29, 0.25, 0.21], "inside": [0.14, 0.15, 0.16], "crisis": [0.26, 0.28, 0.3]}
    return (
        GRID | {"across": across, "critical": np.array([0.21, 0.22, 0.23])} | {k: np.array(v) for k, v in lines.items()}
    )


def _draw_regions(d):
    lines = {name: d[name] for name in ("fold", "inside", "crisis", "critical")}
    panels = [("one", "omega", (d["values"], d["mu"]), d["across"], d["values"], lines)]
    panels.append(("other", "alpha", (d["values"] / 10, d["mu"]), d["across"][:, ::-1], d["values"] / 10, lines))
    return figures.regions(panels, {"alpha": 0.1, "omega": 1.0})


def _apexes():
    return {"alpha": np.array([0.06, 0.1, 0.14]), "small": np.array([1.03, 0.99, 0.96]),
            "linear": np.array([1.04, 1.0, 0.97]), "p": np.array([0.1, 1.0, 3.0])}  # fmt: skip


def _draw_apexes(d):
    over_alpha = {0.1: (d["alpha"], d["small"]), 1.0: (d["alpha"], d["linear"])}
    return figures.apexes(over_alpha, (d["p"], d["linear"]), ((0.1, 1.0), (0.14, 1.05)))


def _pairs():
    found = study.lasting(0.14, 1.05, 1.0, FORCINGS, columns=2, rows=2, periods=200)
    return {"mu": np.array(FORCINGS), "across": found.across, "inside": found.inside}


def _draw_pairs(d):
    marked = np.where(d["across"] > 0, 0.0, 0.5)  # triangles beside the blocks
    one = {0.1: (d["mu"], 1 - d["across"], marked, 0.21), 1.0: (d["mu"], d["across"], d["inside"], 0.23)}
    return figures.pairs({(0.14, 1.05): one, (0.1, 1.0): one})


CASES = {
    "regions": Case(_regions, _draw_regions, to_roundoff),
    "apexes": Case(_apexes, _draw_apexes, to_roundoff),
    "pairs": Case(_pairs, _draw_pairs, to_roundoff),
}
