"""One figure of the regression: the data behind it, how near they must be, and how it is drawn from them.

Tolerances say what the quantity can promise. Theory: round-off. A path: the first five periods, over which chaos
enlarges the round-off of another processor about a hundredfold, not further. An exponent on regular motion: the noise
of a step that meets the singularity at v = 0. An exponent on chaotic motion, an onset: statistics alone.

Where the point is how a figure is drawn, the data are made-up arrays in which no two rows are alike, so that a swapped
colour, marker or row, or one quantity in place of another, alters the picture. The quantities themselves are tested
where they are computed.
"""

from typing import NamedTuple

import numpy as np


class Case(NamedTuple):
    """compute() -> dict of arrays; draw(data) -> Figure; compare(data, reference) raises AssertionError."""

    compute: object
    draw: object
    compare: object


def to_roundoff(data, reference):
    for name, expected in reference.items():
        np.testing.assert_allclose(data[name], expected, rtol=1e-12, atol=1e-14, err_msg=name)
