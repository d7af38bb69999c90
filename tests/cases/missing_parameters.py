"""Cases of the figures of the missing parameters: made-up arrays, as `case` says."""

import numpy as np

from book.figures import missing_parameters as figures

from .case import Case, to_roundoff


def _maps():
    alpha, omega = np.linspace(0.05, 0.3, 6), np.linspace(0.4, 1.6, 7)
    spread = np.abs(np.subtract.outer(alpha, 0.1 * omega))
    criteria = np.array([spread < limit for limit in (0.05, 0.1, 0.15, 0.2, 0.22)])
    return {"alpha": alpha, "omega": omega, "criteria": criteria, "chosen": np.array([alpha[1], omega[3]])}


def _draw_maps(d):
    named = {f"criterion {number}": agrees for number, agrees in enumerate(d["criteria"])}
    return figures.scan_map(d["alpha"], d["omega"], named, tuple(d["chosen"]))


CASES = {
    "scan_map": Case(_maps, _draw_maps, to_roundoff),
}
