"""Turning points: the next or the last crossing of v = 0, landed on exactly, with its derivatives by the start."""

import math
from typing import NamedTuple

import numpy as np

from . import checks
from .compiled import compiled
from .flight import in_parallel, members, raise_failures, start, tolerances, workspace
from .follow import LOG1, LOG2, MOVE, SHEAR, follow
from .friction_time import ETA1, OMEGA, START, XI1, S, T, W, X, force, parameters


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
    max_steps=100_000, threads=None,
):  # three lines for eleven arguments  # fmt: skip
    """First crossing of v = 0 with x > beyond after (direction = 1) or before (-1) the start, landed on exactly.

    Parameters
    ----------
    osc : Duffing, one for all starts or a family
    state : (2,) or (2, *family), for a single oscillator also (2, N): the starts
    t0 : the time of the starts, one for all or (N,) each its own
    within : the longest time to look for it (default: 50 forcing periods)
    derivatives : whether to return dt and dx, too. To first order x does not depend on when it is met, since v = 0
        there: dx is the first row of the tangent map, dt minus the second divided by the force.

    Returns a `TurningPoint`; times of the starts themselves at v = 0 do not count.

    Raises ValueError for invalid input, DivergedError, ConvergenceError (none found in time, or it lies in a creep).
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
    longest = np.broadcast_to(
        100 * np.pi / columns[OMEGA] if within is None else checks.positive("within", within), size
    )

    q = parameters(columns)
    q[:, START] = t0
    found, derivative = np.zeros((2, size)), np.zeros((2, 2, size))
    status = np.zeros(size, dtype=np.int64)

    def run(part):
        _turning_points(
            q[part], state[:, part], direction, float(beyond), longest[part], 2 * bool(derivatives), control,
            found[:, part], derivative[:, :, part], status[part],
        )  # inputs and outputs, a line each  # fmt: skip

    in_parallel(run, size, threads)
    raise_failures(status, columns)
    return TurningPoint(*found, *derivative) if derivatives else TurningPoint(*found)


@compiled
def _turning_points(q, state, direction, beyond, longest, tangents, control, found, derivative, status):
    K, y, new, carry, tally, frame = workspace()
    for i in range(len(q)):
        start(q[i], state[0, i], state[1, i], y, carry)
        y[T], y[S], frame[:] = 0.0, 0.0, 0.0
        carry[MOVE] *= direction
        limit = (beyond, longest[i])
        status[i] = follow(q[i], y, W, 0.0, limit, carry, tangents, control, frame, tally, K, new)
        found[0, i], found[1, i] = q[i, START] + y[T], y[X]
        r11, r22 = math.exp(frame[LOG1]), math.exp(frame[LOG2])
        # The tangent map is Q R with Q the rotation by the frame's angle: rows of (x, v).
        a, b = y[XI1], y[ETA1]
        pull = force(q[i], y[X], y[T])
        derivative[1, 0, i], derivative[1, 1, i] = a * r11, a * r11 * frame[SHEAR] - b * r22
        derivative[0, 0, i], derivative[0, 1, i] = -b * r11 / pull, -(b * r11 * frame[SHEAR] + a * r22) / pull
