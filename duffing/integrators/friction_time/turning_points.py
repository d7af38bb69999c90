"""Turning points: the next or the last crossing of v = 0, landed on exactly, with its derivatives by the start."""

import math
from typing import NamedTuple

import numpy as np

from ... import checks
from ...oscillator import Duffing
from .batches import integrate_members, members, tolerances
from .block import W
from .scheduler import ANGLE, AT_T, AT_X, R11, R12, R22


class TurningPoint(NamedTuple):
    """First crossings of v = 0 by N trajectories.

    t, x : (N,) time and position
    dt, dx : (2, N) their derivatives by the start's x and v (at fixed starting time), or None
    """

    t: np.ndarray
    x: np.ndarray
    dt: np.ndarray | None = None
    dx: np.ndarray | None = None


def to_turning_point(
    osc, state, t0, direction=1, beyond=-math.inf, within=None, derivatives=False, rtol=1e-11, atol=1e-13,
    max_steps=None, threads=None,
):  # three lines for eleven arguments  # fmt: skip
    """First crossing of v = 0 with x > beyond after (direction = 1) or before (-1) the start, landed on exactly.

    Parameters
    ----------
    osc : Duffing, one for all starts or a family
    state : (2,) or (2, *family), for a single oscillator also (2, N): the starts
    t0 : the time of the starts, one for all or (N,) each its own
    within : the longest time to look for it (default: 50 forcing periods)
    max_steps : the most steps in that time; its default is that of `adaptive.integrate`
    derivatives : whether to return dt and dx, too. To first order x does not depend on when it is met, since v = 0
        there: dx is the first row of the tangent map, dt minus the second divided by the force.

    Returns a `TurningPoint`; times of the starts themselves at v = 0 do not count.

    Raises ValueError for invalid input, DivergedError, ConvergenceError (none found in time, or
    derivatives are asked for where the velocity passes through zero in a creep, which erases a direction).
    """
    state = np.asarray(state)
    shape = osc.shape if osc.shape or state.ndim < 2 else state.shape[1:]
    columns, state, size = members(osc, state, shape)
    t0 = np.asarray(checks.parameter("t0", t0, allowed="finite times"))
    if t0.size not in (1, size):
        raise ValueError(f"t0 has shape {t0.shape}: must be one time or {size}")
    t0 = np.broadcast_to(t0.ravel(), size)
    if direction not in (1, -1):
        raise ValueError(f"direction = {direction!r}: must be 1 or -1")
    control = tolerances(rtol, atol, max_steps)
    longest = np.broadcast_to(100 * np.pi / columns[3] if within is None else checks.positive("within", within), size)

    times = np.stack([t0, t0 + direction * longest], axis=1)
    tangents = 2 * bool(derivatives)
    results, _ = integrate_members(columns, state, times, max_steps, W, float(beyond), tangents, control, threads)
    last = results[:, 0]
    t, x = t0 + last[AT_T], last[AT_X]
    if not derivatives:
        return TurningPoint(t, x)
    # The tangent map is Q R with Q the rotation by the frame's angle: rows of (x, v).
    a, b, r11, r22 = np.cos(last[ANGLE]), np.sin(last[ANGLE]), np.exp(last[R11]), np.exp(last[R22])
    pull = Duffing(*columns).force(x, t)
    dx = np.array([a * r11, a * r11 * last[R12] - b * r22])
    dt = -np.array([b * r11, b * r11 * last[R12] + a * r22]) / pull
    return TurningPoint(t, x, dt, dx)
