"""Basins of attraction on a grid of starts, with what was not resolved as a label of its own."""

from typing import NamedTuple

import numpy as np

from .. import checks
from .attractors import UNRESOLVED, find_attractors, settle

# What the label of a basin says whatever else attracts at the same parameters: the colours of pictures go by it.
# Two in a place, the second for all but the smallest orbit.
KINDS = (
    "left well",
    "left well, larger orbit",
    "right well",
    "right well, larger orbit",
    "round both wells",
    "round both, other",
    "chaotic",
    "unresolved",
)


class Basins(NamedTuple):
    """Where the starts of a grid end.

    x (nx,), v (nv,) : the grid; phase : of the forcing at the start (radian)
    labels (nv, nx) : index into attractors, or UNRESOLVED (-1)
    periods (nv, nx) : forcing periods until the start was caught, infinite where it was not
    attractors : tuple of `duffing.basins.attractors.Attractor`, their points at phase 0
    """

    x: np.ndarray
    v: np.ndarray
    phase: float
    labels: np.ndarray
    periods: np.ndarray
    attractors: tuple

    @property
    def shares(self):
        """Parts of the grid in each attractor's basin, the unresolved part last: (attractors + 1,), with the sum 1."""
        counts = np.bincount(np.where(self.labels == UNRESOLVED, len(self.attractors), self.labels).ravel())
        return np.append(counts, np.zeros(len(self.attractors) + 1 - counts.size)) / self.labels.size

    @property
    def kinds(self):
        """Index into KINDS of every attractor and, last, of the unresolved: (attractors + 1,)."""
        kinds = []
        for one in self.attractors:
            kind = 2 * ("left", "right", "both").index(one.place) if one.period else KINDS.index("chaotic")
            kinds.append(kind + (one.period > 0 and kind in kinds))
        return np.array([*kinds, KINDS.index("unresolved")])


def basins(
    osc, x, v, attractors=None, periods=200, phase=0.0, executor=None, progress=None, checkpoint=None, **options
):
    """Basins of the starts (x, v) on a grid at the forcing phase `phase`.

    osc : a single oscillator; x (nx,), v (nv,) increasing
    attractors : as from `find_attractors`, which is asked by default; those met on the way are added
    periods : forcing periods after which a start is left unresolved
    executor, progress, checkpoint : as for `settle`
    options, errors : method and options as for `duffing.flow.integrate`
    """
    x, v = checks.times(x, "x"), checks.times(v, "v")
    known = find_attractors(osc, **options) if attractors is None else attractors
    starts = np.reshape(np.meshgrid(x, v), (2, -1))
    run = {"executor": executor, "progress": progress, "checkpoint": checkpoint}
    settled = settle(osc, starts, known, periods, phase, **run, **options)
    grid = (v.size, x.size)
    return Basins(x, v, phase, settled.labels.reshape(grid), settled.periods.reshape(grid), settled.attractors)


def changed(one, other):
    """The part of the grid on which two Basins disagree, attractors being matched by their nearest points.

    Labels of attractors that only one of them has differ; unresolved agrees with unresolved.
    """
    if one.labels.shape != other.labels.shape:
        raise ValueError(f"the grids have the shapes {one.labels.shape} and {other.labels.shape}: must be the same")
    match = [_counterpart(attractor, one.attractors) for attractor in other.attractors]
    return float(np.mean(one.labels != np.array([*match, UNRESOLVED])[other.labels]))


def _counterpart(attractor, attractors):
    """Number of the same attractor in the list, or one that no label has."""
    for number, one in enumerate(attractors):
        near = np.hypot(*(one.points[:, :1] - attractor.points)).min() < 1e-2
        if one.place == attractor.place and one.period == attractor.period and near:
            return number
    return UNRESOLVED - 1
