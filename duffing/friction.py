"""The accurate integrator: every p > 0, forward and backward, with both tangent vectors, creep included.

Front end of `follow`, which steps in friction time (`friction_time`) with an embedded pair of order eight
(`dop853`) and in creeps with an implicit method of order nine (`creep`).
"""

import math
import os
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from . import checks
from .creep import at_rest
from .dop853 import STAGES
from .errors import ConvergenceError, DivergedError
from .follow import (
    CREEP,
    DIVERGED,
    DONE,
    EVALUATIONS,
    LOG1,
    LOG2,
    MOVE,
    NO_CROSSING,
    PASSAGES,
    PAST_UNKNOWN,
    SHEAR,
    STUCK,
    TOO_MANY_STEPS,
    follow,
)
from .friction_time import (
    ETA1,
    ETA2,
    OMEGA,
    START,
    XI1,
    M,
    N,
    P,
    S,
    T,
    W,
    X,
    compiled,
    force,
    parameters,
    variable,
    velocity,
)
from .orbit import Orbit

_BLOCK = 4  # trajectories a task: they differ in cost, so blocks are small
_FAILURES = {
    DIVERGED: (DivergedError, "the solution leaves every bound"),
    TOO_MANY_STEPS: (ConvergenceError, "more than max_steps steps were needed"),
    PAST_UNKNOWN: (
        ConvergenceError,
        "backward in time the solution stays on the slow branch of a creep, where every past ends: it has none",
    ),
    STUCK: (ConvergenceError, "the velocity passes through zero in a creep, where no turning point is distinguished"),
    NO_CROSSING: (ConvergenceError, "no turning point was found in time"),
}


class TurningPoint(NamedTuple):
    """First crossings of v = 0 by N trajectories.

    t, x : (N,) time and position
    dt, dx : (2, N) their derivatives by the start's x and v (at fixed starting time), or None
    """

    t: np.ndarray
    x: np.ndarray
    dt: np.ndarray | None = None
    dx: np.ndarray | None = None


def integrate(osc, state, t, tangents=0, rtol=1e-10, atol=1e-12, max_steps=100_000, switch=0.6, threads=None):
    """Solutions at the times t, each step's error of (x, v) below atol + rtol |(x, v)|.

    Parameters
    ----------
    osc : Duffing, a single oscillator or a family of N members, any p > 0
    state : (2,) or (2, *family) or (2, N), (x, v) at t[0]
    t : (n,) for all members or (n, N), increasing or decreasing times, met exactly
    tangents : 0, 1 or 2 tangent vectors; growth and propagators are of each interval. The state does not depend on it.
    max_steps : for each interval
    switch : relaxation times an explicit step, 0 < switch <= 0.6, above which a creep is followed by implicit steps;
        the cost depends on it, the result does not
    threads : at most so many at once (default: the processors); the result is the same to the last bit

    Returns
    -------
    Orbit : with friction_time (n - 1, N), annihilations (n - 1, N), evaluations (N,) of the force. Where a creep
        through zero force annihilates a tangent direction (p <= 1/2), friction_time is infinite, growth[1] = -inf.
        Backward, friction_time is negative.

    Raises
    ------
    ValueError : for invalid input
    DivergedError : when a solution leaves every bound
    ConvergenceError : when max_steps do not suffice, or backward in time where a creep has erased the past
    """
    columns, state, size = _members(osc, state, osc.shape)
    t = _times(t, size)
    tangents = checks.count("tangents", tangents, least=0)
    if tangents > 2:
        raise ValueError(f"tangents = {tangents}: must be 0, 1 or 2")
    control = _control(rtol, atol, max_steps, switch)

    n = t.shape[1]
    q = parameters(columns)
    states = np.empty((size, 2, n))
    states[:, :, 0] = state.T
    frames = np.zeros((size, 3, n - 1))
    angles = np.zeros((size, n))
    friction_time = np.zeros((size, n - 1))
    annihilations = np.zeros((size, n - 1), dtype=np.int64)
    evaluations, status = np.zeros(size, dtype=np.int64), np.zeros(size, dtype=np.int64)

    def run(part):
        _orbits(
            q[part], t[part], tangents, control,
            states[part], frames[part], angles[part], friction_time[part], annihilations[part],
            evaluations[part], status[part],
        )  # fmt: skip

    _parallel(run, size, threads)
    _raise(status, columns)
    frames = np.moveaxis(frames, 0, -1)
    return Orbit(
        np.moveaxis(states, 0, -1),
        frames[:tangents],
        _propagators(frames, angles.T) if tangents == 2 else None,
        friction_time.T,
        annihilations.T,
        evaluations,
    )


def to_turning_point(
    osc, state, t0, direction=1, beyond=-math.inf, within=None, derivatives=False, rtol=1e-11, atol=1e-13,
    max_steps=100_000, threads=None,
):  # fmt: skip
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
    columns, state, size = _members(osc, state, shape)
    t0 = np.asarray(checks.parameter("t0", t0, allowed="finite times"))
    if t0.size not in (1, size):
        raise ValueError(f"t0 has shape {t0.shape}: must be one time or {size}")
    t0 = np.broadcast_to(t0.ravel(), size)
    if direction not in (1, -1):
        raise ValueError(f"direction = {direction!r}: must be 1 or -1")
    control = _control(rtol, atol, max_steps)
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
        )  # fmt: skip

    _parallel(run, size, threads)
    _raise(status, columns)
    return TurningPoint(*found, *derivative) if derivatives else TurningPoint(*found)


@compiled
def _orbits(q, times, tangents, control, states, frames, angles, friction_time, annihilations, evaluations, status):
    K, y, new, carry, tally, frame = _workspace()
    for i in range(len(q)):
        q[i, START] = times[i, 0]
        _start(q[i], states[i, 0, 0], states[i, 1, 0], y, carry)
        tally[:] = 0
        for j in range(times.shape[1] - 1):
            q[i, START], y[T], y[S], frame[:] = times[i, j], 0.0, 0.0, 0.0
            span, before = times[i, j + 1] - times[i, j], tally[PASSAGES]
            carry[MOVE] = math.copysign(carry[MOVE], span)
            status[i] = follow(q[i], y, T, span, (0.0, 0.0), carry, tangents, control, frame, tally, K, new)
            frames[i, :, j] = frame
            if status[i] != DONE:
                break
            states[i, 0, j + 1], states[i, 1, j + 1] = y[X], velocity(q[i], y[W])
            friction_time[i, j], annihilations[i, j] = y[S], tally[PASSAGES] - before
            angles[i, j + 1] = math.atan2(y[ETA1], y[XI1])
        evaluations[i] = tally[EVALUATIONS]


@compiled
def _turning_points(q, state, direction, beyond, longest, tangents, control, found, derivative, status):
    K, y, new, carry, tally, frame = _workspace()
    for i in range(len(q)):
        _start(q[i], state[0, i], state[1, i], y, carry)
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


@compiled
def _workspace():
    return np.zeros((STAGES, 8)), np.zeros(8), np.zeros(8), np.zeros(2), np.zeros(3, dtype=np.int64), np.zeros(3)


@compiled
def _start(q, x, v, y, carry):
    y[:] = 0.0
    y[X], y[W], y[XI1], y[ETA2] = x, variable(q, v), 1.0, 1.0
    carry[MOVE], carry[CREEP] = 0.05 / q[OMEGA], 0.0
    if q[P] > 1.0 and at_rest(q, x, force(q, x, 0.0), v):
        q[M], q[N] = 1.0, q[P]  # at rest without force w would stay what it is for ever: take v itself


def _propagators(frames, angles):
    """Q R Q0^T of each interval, (2, 2, n - 1, N)."""

    def rotation(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    r11, r22 = np.exp(frames[LOG1]), np.exp(frames[LOG2])
    upper = np.array([[r11, r11 * frames[SHEAR]], [np.zeros_like(r11), r22]])
    return np.einsum("ij...,jk...,lk...->il...", rotation(angles[1:]), upper, rotation(angles[:-1]))


def _members(osc, state, shape):
    columns = osc.columns()
    size = math.prod(shape)
    if columns.shape[1] != size:
        columns = np.repeat(columns, size, axis=1)
    return columns, checks.state(state, (size,) if np.shape(state) == (2, size) else shape), size


def _times(t, size):
    """Times (N, n), strictly monotone."""
    t = np.asarray(t)
    columns = t.T if t.ndim == 2 and t.shape[1] == size and t.shape[0] > 0 else [t] * size
    return np.array([_monotone(column) for column in columns]).reshape(size, -1)


def _monotone(t):
    if t.ndim == 1 and t.size > 1 and t.dtype.kind in "iuf" and np.all(np.isfinite(t)):
        if not (np.all(np.diff(t) > 0) or np.all(np.diff(t) < 0)):
            raise ValueError(f"t = {t}: must be strictly increasing or strictly decreasing")
        return t.astype(float)
    return checks.times(t)


def _control(rtol, atol, max_steps, switch=0.6):
    switch = checks.positive("switch", switch)
    if switch > 0.6:
        raise ValueError(f"switch = {switch}: must be a number in (0, 0.6]")
    return checks.positive("rtol", rtol), checks.positive("atol", atol), checks.count("max_steps", max_steps), switch


def _parallel(run, size, threads):
    threads = os.cpu_count() if threads is None else checks.count("threads", threads)
    parts = [slice(i, i + _BLOCK) for i in range(0, size, _BLOCK)]
    if threads == 1 or len(parts) == 1:
        for part in parts:
            run(part)
    else:
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(run, parts))


def _raise(status, columns):
    """The named error of the first member that failed."""
    failed = np.flatnonzero(status != DONE)
    if failed.size:
        kind, reason = _FAILURES[status[failed[0]]]
        names = ("alpha", "p", "mu", "omega", "delta", "gamma")
        member = ", ".join(f"{n} = {v:g}" for n, v in zip(names, columns[:, failed[0]], strict=True))
        raise kind(f"{failed.size} of {status.size} members fail; the first, {member}: {reason}")
