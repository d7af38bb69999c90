"""Cases of the figures of bifurcations, as in `case`.

The points of a branch depend on the last bits of every step before; what is compared is the curve, at equal steps of
its length, to the width of a line. Located bifurcations do not depend on them.
"""

import numpy as np

from book.figures import bifurcations as figures
from book.studies import bifurcations as study
from book.studies.followed import amplitude, at_exponent, curves, marks, stroboscopic
from duffing import Duffing, critical_amplitude, homoclinic_tangency

from .case import Case, to_roundoff

P = (0.1, 1.0)
FOUR = (study.IN_WELL, study.LARGE, study.SADDLE, study.THIRD)


def resampled(parameter, value, stable, points=40):
    """A curve at equal steps of its length: rows of the parameter, of the values and of the stability."""
    rows = np.vstack([parameter, np.atleast_2d(value), stable.astype(float)])
    length = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(rows[:-1], axis=1), axis=0)))
    return np.array([np.interp(np.linspace(0, length[-1], points), length, row) for row in rows])


def packed(followed, value, names, label):
    """Curves of these names as arrays named after them and their place: the pictures' lines."""
    chosen = [one for one in followed if one.name in names]
    return {f"{label}|{k}|{name}": resampled(*rest) for k, (name, *rest) in enumerate(curves(chosen, value))}


def unpacked(data, label):
    parts = [(key.split("|")[2], rows) for key, rows in data.items() if key.startswith(f"{label}|")]
    return [(name, rows[0], rows[1:-1], rows[-1] > 0.5) for name, rows in parts]


def packed_marks(followed):
    return np.array([(kind == "fold", *rest) for kind, *rest in marks(followed)])


def unpacked_marks(rows):
    return [("fold" if fold else "flip", where, value) for fold, where, value in rows]


def near_curves(data, reference):
    for name, expected in reference.items():
        # The last row of a curve is its stability, which changes between two of these points.
        rows = slice(None, -1) if "|" in name else slice(None)
        np.testing.assert_allclose(data[name][rows], expected[rows], atol=3e-3, err_msg=name)


def _branches():
    data = {}
    for p in P:
        chosen = at_exponent(study.branches(), p)
        data |= packed(chosen, amplitude, FOUR, f"{p:g}")
        data[f"marks {p:g}"] = packed_marks(chosen)
        data[f"mu_c {p:g}"] = np.array([critical_amplitude(Duffing(p=p))])
    return data


def _draw_branches(data):
    cases = {p: (unpacked(data, f"{p:g}"), unpacked_marks(data[f"marks {p:g}"]), data[f"mu_c {p:g}"][0]) for p in P}
    return figures.branch_panels(cases, last=0.5)


def _overlay():
    data = packed(at_exponent(study.branches(), 1.0), stroboscopic, FOUR[:2], "1")
    # Below mu_c, where no fractal boundary decides by the last bits which well a start ends in.
    found = study.brute_force(1.0, first=0.04, last=0.06, forcings=5, transient=150)
    for name, points in found.items():
        data[name] = np.array(points)
    return data


def _draw_overlay(data):
    brute = {name: data[name] for name in ("many starts", "forward sweep", "backward sweep")}
    return figures.overlay({1.0: (brute, unpacked(data, "1"))})


def _loci():
    data = {}
    for k, one in enumerate(study.loci_in_p()):
        data[f"locus|{k}|{one.name}"] = resampled(one.p, one.mu, np.zeros(one.p.size))
    p, touched = np.linspace(0.05, 3, 30), np.array([0.5, 1.0, 2.0])
    tangency = homoclinic_tangency(Duffing(p=touched))
    return data | {"p": p, "mu_c": critical_amplitude(Duffing(p=p)), "p touched": touched, "tangency": tangency}


def _draw_loci(data):
    lines = [(name, p, mu[0]) for name, p, mu, _ in unpacked(data, "locus")]
    return figures.loci(lines, data["p"], data["mu_c"], data["p touched"], data["tangency"])


def _in_well():
    return {"distance": np.arange(5) * 1e-4, "exponent": np.array([0.01, 0.02, -0.01, 0.03, np.nan])}


def _accumulations():
    return {"x": np.array([0.1, 0.5, 1.0]), "ratio": np.array([1.1, 0.9, 1.4])}


def _draw_accumulations(d):
    curves = {0.1: (d["x"], d["ratio"]), 1.0: (d["x"], 1.5 * d["ratio"])}
    return figures.accumulations((d["x"], d["ratio"] ** 2), curves, {0.1: (d["x"], d["ratio"][::-1])})


CASES = {
    "branches": Case(_branches, _draw_branches, near_curves),
    "overlay": Case(_overlay, _draw_overlay, near_curves),
    "loci": Case(_loci, _draw_loci, near_curves),
    "in_well": Case(
        _in_well,
        lambda d: figures.in_well_chaos({0.1: (d["distance"], d["exponent"]), 1.0: (d["distance"], 2 * d["exponent"])}),
        to_roundoff,
    ),
    "accumulations": Case(_accumulations, _draw_accumulations, to_roundoff),
}
