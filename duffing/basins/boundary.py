"""Where a line of starts crosses the boundary between basins: every strip of it, down to a width.

A thin strip of another basin on the line is a wide one in a later image of the line: the flow stretches it. So the
images, not the line, are what has to be resolved. Cells of the line are halved for as long as their two ends come apart
by more than `reach` at some time; what then lies between two ends of one label is of that label too, however thin the
strips are elsewhere. The work grows with the length of the images and not with the number of cells at the finest width.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .. import checks
from ..errors import ConvergenceError
from ..flow import integrate
from .fates import LAST, LOOKS, classify_path
from .uncertainty import Dimension

_CELLS = 128  # of the line, to begin with
_WIDEST = 3e-3  # distance, of the length of the line, below which a power law is looked for


class Crossings(NamedTuple):
    """left, right (n,) : the ends of the cells that the boundary crosses, ascending, in units of the line's length;
    width : of the cells; starts : number of them that were followed."""

    left: np.ndarray
    right: np.ndarray
    width: float
    starts: int


def crossings(follow, reach=0.2, least=1e-13, most=100_000):
    """The cells of a line of starts whose ends have different labels: Crossings.

    follow : follow(s) with s (n,) in [0, 1] gives the images (2, m, n) at m times and the labels (n,)
    reach : greatest distance of the images of a cell's ends, in (x, v), at which the cell is not halved
    least : width of a cell, in units of the line's length, at which it is not halved any more
    most : starts that are followed; the cells are then wider. Cells of one width are halved together.

    Raises ValueError for invalid input.
    """
    checks.function("follow", follow)
    reach, least = checks.positive("reach", reach), checks.positive("least", least)
    checks.count("most", most, least=_CELLS + 1)
    ends = np.linspace(0.0, 1.0, _CELLS + 1)
    images, labels = follow(ends)
    cells = [(ends[side], images[:, :, side], labels[side]) for side in (slice(None, -1), slice(1, None))]
    width, starts = 1 / _CELLS, ends.size
    while True:
        (left, first, one), (right, second, other) = cells
        live = (np.hypot(*(first - second)).max(axis=0) > reach) | (one != other)
        if width / 2 < least or starts + live.sum() > most or not live.any():
            border = np.flatnonzero(one != other)
            border = border[np.argsort(left[border])]
            return Crossings(left[border], right[border], width, starts)
        cells = [(s[live], image[:, :, live], label[live]) for s, image, label in cells]
        middle = (cells[0][0] + cells[1][0]) / 2
        middles, width, starts = (middle, *follow(middle)), width / 2, starts + middle.size
        cells = [_joined(cells[0], middles), _joined(middles, cells[1])]


def line_of_starts(osc, start, end, periods=12, **options):
    """`follow` for the starts between the states `start` and `end`, each (2,) at phase 0: images and fates (`fates`).

    osc : a single oscillator; options : method and options as for `duffing.flow.integrate`. Down to widths near an
    adaptive integrator's tolerance its own steps are seen; method="rk4" is a smooth map down to rounding.
    """
    start, end = (checks.state(point, (), name) for name, point in (("start", start), ("end", end)))
    checks.single(osc)
    t = osc.period / LOOKS * np.arange(checks.count("periods", periods, least=LAST + 1) * LOOKS + 1)

    def follow(s):
        family = replace(osc, mu=np.full(s.size, osc.mu))
        images = integrate(family, start + s * (end - start), t, **options).states
        return images.astype(np.float32), classify_path(images)  # the images are only compared with `reach`

    return follow


def neighbourhood(found, eps):
    """The part of the line nearer than eps (n,) to a crossing, in units of the line's length: array (n,).

    It goes as eps^(1 - d) with the box-counting dimension d of the crossings; the boundary in the plane has D = 1 + d.
    eps must be at least the cells' width.
    """
    eps = np.atleast_1d(checks.parameter("eps", eps))
    if np.any(eps < found.width):
        raise ValueError(f"eps = {eps}: must be at least the width {found.width:g} of the cells")
    gaps = np.diff((found.left + found.right) / 2)  # a crossing is known to be in the cell, and put in its middle
    return np.minimum(gaps, 2 * eps[:, None]).sum(axis=1) + 2 * eps * (found.left.size > 0)


def boundary_dimension(found):
    """D = 1 + d of the boundary in the plane from its crossings with a line: a Dimension.

    d by the slope of the neighbourhood in steps of half a decade, from four cells up to a thousand times that: D is a
    limit of fine scales, and the saddle makes its stripes finer by some hundred times at once. Not above 3/1000 of the
    line. There are no random numbers in it: the error is the standard deviation of the slope from step to step.

    Raises ConvergenceError where there is no crossing, or less than a decade.
    """
    steps = min(6, int(np.floor(2 * np.log10(_WIDEST / (4 * found.width)) + 1e-9)))
    if steps < 2 or found.left.size == 0:
        raise ConvergenceError(f"{found.left.size} crossings, cells {found.width:g} wide: no decade for a power law")
    x = np.arange(steps + 1) / 2
    size = np.log10(neighbourhood(found, 4 * found.width * 10.0**x))
    return Dimension(float(2 - np.polyfit(x, size, 1)[0]), float(np.std(2 * np.diff(size), ddof=1)))


def _joined(one, other):
    return tuple(np.concatenate(parts, axis=-1) for parts in zip(one, other, strict=True))
