"""The figures of the chapter on basins, for the regression of `test_figures`: small data, drawn as in the book.

Labels may differ where the boundary is near: another processor's last bit decides there. A dimension is a slope over
scales and does not notice.
"""

import numpy as np

from book.figures import basins as figures
from book.studies import basins as basin_study
from duffing.basins.basins import KINDS
from duffing.basins.boundary import neighbourhood
from duffing.basins.fates import NAMES

from .case import Case

EPS = 10.0 ** np.arange(-4, -1.9, 0.5)


def _basins():
    data = {}
    for ratio in (0.9, 2.0):
        found = basin_study.picture(1.0, ratio, size=48)
        data[f"kinds {ratio}"] = found.kinds[found.labels]
        data[f"points {ratio}"] = np.concatenate([one.points for one in found.attractors], axis=1)
    return data


def _draw_basins(data):
    x, v = (np.linspace(*ends, 48) for ends in basin_study.FRAME)
    curve = np.array([np.linspace(-1, 1, 20), np.linspace(0.5, -0.5, 20)])
    cases = [
        (f"{ratio}", x, v, data[f"kinds {ratio}"], [data[f"points {ratio}"]], [curve] if ratio < 1 else [])
        for ratio in (0.9, 2.0)
    ]
    return figures.basin_pictures(cases, KINDS)


def _near_basins(data, reference):
    for ratio, most in ((0.9, 0.005), (2.0, 0.2)):
        assert np.mean(data[f"kinds {ratio}"] != reference[f"kinds {ratio}"]) <= most
        np.testing.assert_allclose(data[f"points {ratio}"], reference[f"points {ratio}"], atol=1e-6)


def _section():
    mu, x = np.linspace(0.1, 0.2, 15), np.linspace(-1.5, 1.5, 20)
    return {"mu": mu, "x": x, "fates": basin_study.section(mu, x, p=1.0, periods=60)}


def _near_section(data, reference):
    assert np.mean(data["fates"] != reference["fates"]) <= 0.15


def _uncertain():
    return {f"{ratio}": neighbourhood(basin_study.strips(1.0, ratio, most=8000), EPS) for ratio in (0.9, 1.2)}


def _dimensions():
    ratios = (0.9, 1.02, 1.5)
    values, errors, _ = basin_study.line_dimensions(1.0, ratios, most=15_000)
    return {"line": np.array([ratios, values, errors])}


def _close(tolerance):
    def compare(data, reference):
        for name, expected in reference.items():
            np.testing.assert_allclose(data[name], expected, rtol=tolerance, atol=tolerance, err_msg=name)

    return compare


CASES = {
    "basins": Case(_basins, _draw_basins, _near_basins),
    "basin_section": Case(
        _section, lambda d: figures.fate_section(d["mu"], d["x"], d["fates"], NAMES, (0.15,)), _near_section
    ),
    "uncertain_part": Case(
        _uncertain,
        lambda d: figures.uncertain_part([(name, EPS, part) for name, part in d.items()]),
        _close(0.05),
    ),
    "boundary_dimension": Case(
        _dimensions,
        lambda d: figures.boundary_dimension({1.0: d["line"]}, {1.0: d["line"][:, :2]}, {1.0: 1.0004}),
        _close(0.03),
    ),
}
