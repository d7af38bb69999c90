"""What the basin explorer shows: basins at a few forcings and the attractors' closed paths, ready for JSON."""

from dataclasses import replace

import numpy as np

from duffing import paper
from duffing.basins.attractors import UNRESOLVED
from duffing.basins.basins import basins
from duffing.melnikov import critical_amplitude
from duffing.orbits.periodic import path

from ..remember import remembered

COLUMNS, ROWS, PERIODS = 180, 120, 120
SCALE = 1000  # positions travel as whole thousandths
# Accurate enough that a label is wrong only where no picture of this size could show it; p = 1 in physical time.
OPTIONS = {"method": "rk4", "steps_per_period": 100}
LINEAR = replace(paper.OSCILLATOR, p=1.0)
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@remembered
def pictures(amplitudes=(0.05, 0.1, 0.15, 0.2, 0.24), osc=LINEAR):
    """One entry for each forcing: dict of "mu", "ratio" (mu over mu_c), "columns", "rows", "x" and "v" (first, last),

    labels : rows from the bottom, a string with a letter a start: A for the first attractor ..., "-" for unresolved
    periods : string of the same length, forcing periods until it is caught as a digit of base 36, three a step
    attractors : list of dict of "name", "path" (x and v in thousandths over a round), "points" (stroboscopic ones)
    """
    x, v = np.linspace(-1.8, 1.8, COLUMNS), np.linspace(-1.2, 1.2, ROWS)
    return [_picture(replace(osc, mu=float(mu)), x, v) for mu in amplitudes]


def _picture(osc, x, v):
    found = basins(osc, x, v, periods=PERIODS, **OPTIONS)
    letters = np.array([*LETTERS[: len(found.attractors)], "-"])
    waits = np.minimum(np.where(np.isfinite(found.periods), found.periods, 0) // 3, 35).astype(int)
    return {
        "mu": float(osc.mu),
        "ratio": round(float(osc.mu / critical_amplitude(osc)), 2),
        "columns": int(x.size),
        "rows": int(v.size),
        "x": [float(x[0]), float(x[-1])],
        "v": [float(v[0]), float(v[-1])],
        "labels": "".join(letters[np.where(found.labels == UNRESOLVED, len(found.attractors), found.labels)].ravel()),
        "periods": "".join(np.array(list("0123456789abcdefghijklmnopqrstuvwxyz"))[waits].ravel()),
        "attractors": [_round(osc, one) for one in found.attractors],
    }


def _round(osc, attractor):
    curve = path(osc, attractor.points[:, 0], 2 * attractor.period, 64 * attractor.period) if attractor.period else []
    return {
        "name": attractor.name,
        "path": np.rint(np.multiply(curve, SCALE)).astype(int).tolist(),
        "points": np.rint(attractor.points * SCALE).astype(int)[:, :400].tolist(),
    }
