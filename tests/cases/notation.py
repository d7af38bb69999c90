"""The cast of orbits: the branches that the bifurcation figures show, with letters."""

import numpy as np

from book.figures import notation as figures
from book.studies import cast as study

from .bifurcations import near_curves, resampled, unpacked, unpacked_marks
from .case import Case


def _cast():
    data = {}
    for p, (branches, marks, letters, crisis) in study.diagram().items():
        data |= {f"{p:g}|{k}|{name}": resampled(*rest) for k, (name, *rest) in enumerate(branches)}
        data[f"marks {p:g}"] = np.array([(kind == "fold", *rest) for kind, *rest in marks])
        data[f"letters {p:g}"] = np.array([where for _, *where in letters])
        data[f"crisis {p:g}"] = np.array([crisis])
    return data


def _draw_cast(data):
    cases = {}
    for p in study.EXPONENTS:
        letters = [(name, *where) for name, where in zip(study.LETTERS, data[f"letters {p:g}"], strict=True)]
        marks = unpacked_marks(data[f"marks {p:g}"])
        # One number a branch, as a figure of amplitudes has it.
        branches = [(name, mu, value[0], stable) for name, mu, value, stable in unpacked(data, f"{p:g}")]
        cases[p] = branches, marks, letters, data[f"crisis {p:g}"][0]
    return figures.cast(cases)


CASES = {"cast": Case(_cast, _draw_cast, near_curves)}
