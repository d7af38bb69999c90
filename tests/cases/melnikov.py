"""The sketch of why M measures a distance."""

from dataclasses import replace

import numpy as np

from book.figures import melnikov as figures
from book.studies.melnikov_distance import at_outermost_point
from duffing import Duffing, critical_amplitude

from .case import Case
from .paper import evenly


def _distance():
    osc = Duffing(alpha=0.05, p=1.0)
    found = at_outermost_point(replace(osc, mu=2 * critical_amplitude(osc)))
    return {
        "loop": found.loop,
        "unstable": evenly(found.unstable),
        "stable": evenly(found.stable),
        "ends": found.ends,
        "times": np.array(found.times),
        "energies": np.array(found.energies),
    }


def _draw_distance(d):
    return figures.distance(*(d[name] for name in ("loop", "unstable", "stable", "ends", "times", "energies")))


def _near(data, reference):
    for name, expected in reference.items():
        np.testing.assert_allclose(data[name], expected, atol=3e-3 if name == "energies" else 2e-4, err_msg=name)


CASES = {"distance": Case(_distance, _draw_distance, _near)}
