"""States are followed until an attractor catches them: a periodic one by its trapping disk, chaos by its cells.

A periodic attractor has caught a state that lies in its disk, a chaotic one a state that has stayed in the cells which
it visits for STREAK periods on end. Of an attractor only this region and its period count here.
"""

import numpy as np

from ..flow import integrate

UNRESOLVED = -1
STREAK = 20  # periods on end in a chaotic attractor's cells
_CHUNK = 4  # periods between two looks at the states


def capture(osc, state, regions, first, last, start, **options):
    """Follow a block from the period `first` to `last` or until a region holds it: rows label, when, x, v, streaks.

    state : x, v at the time `start` before the period 0, later at phase 0, and a streak for each region
    regions : (period, Trap or Cells) of each attractor
    """
    one, size = osc.members(0), state.shape[1]
    result = np.array([np.full(size, UNRESOLVED), np.full(size, np.inf), *state])
    live, done = np.arange(size), first
    points = _to_phase_zero(one, state[:2], start, options)[:, None] if first == 0 else None
    while True:
        if points is None:
            step = min(_CHUNK, last - done)
            points, done = points_of(one, result[2:4, live], step, options)[:, 1:], done + step
        label, when, result[4:, live] = first_capture(regions, points, result[4:, live])
        result[2:4, live] = points[:, -1]
        hit = label != UNRESOLVED
        result[0, live[hit]], result[1, live[hit]] = label[hit], done - points.shape[1] + 1 + when[hit]
        live, points = live[~hit], None
        if live.size == 0 or done == last:
            return result


def first_capture(regions, points, streaks):
    """Label and number of the first of the points (2, c, n) that is caught; the streaks (len(regions), n) in cells."""
    label, when = np.full(points.shape[2], UNRESOLVED), np.full(points.shape[2], points.shape[1])
    streaks = streaks.copy()
    for number, (period, region) in enumerate(regions):
        inside = region.holds(points)
        if not period:
            for row in inside:  # a point after the other
                streaks[number] = np.where(row, streaks[number] + 1, 0)
                row[:] = streaks[number] >= STREAK
        first = np.where(inside.any(axis=0), inside.argmax(axis=0), points.shape[1])
        label, when = np.where(first < when, number, label), np.minimum(first, when)
    return label, when, streaks


def points_of(osc, states, periods, options):
    """States (2, periods + 1, n) at each phase 0, from the present one on."""
    return integrate(osc.repeated(states.shape[1]), states, np.arange(periods + 1) * osc.period, **options).states


def _to_phase_zero(osc, states, start, options):
    if start == 0:
        return states
    return integrate(osc.repeated(states.shape[1]), states, np.array([start, osc.period]), **options).states[:, 1]
