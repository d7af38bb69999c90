"""The accurate integrator: every p > 0, forward and backward, with both tangent vectors, creep included.

Front end of `follow`, which steps in friction time (`friction_time`) with an embedded pair of order eight
(`dop853`) and in creeps with an implicit method of order nine (`creep`).
"""

import math

import numpy as np

from . import checks
from .compiled import compiled
from .errors import DivergedError
from .flight import in_parallel, members, raise_failures, start, tolerances, workspace
from .follow import DONE, EVALUATIONS, LOG1, LOG2, MOVE, PASSAGES, SHEAR, follow
from .friction_time import ETA1, START, XI1, S, T, W, X, parameters, velocity
from .orbit import Orbit


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
    columns, state, size = members(osc, state, osc.shape)
    t = _times(t, size)
    tangents = checks.count("tangents", tangents, least=0)
    if tangents > 2:
        raise ValueError(f"tangents = {tangents}: must be 0, 1 or 2")
    control = tolerances(rtol, atol, max_steps, switch)

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
        )  # inputs and outputs, a line each  # fmt: skip

    in_parallel(run, size, threads)
    raise_failures(status, columns)
    frames = np.moveaxis(frames, 0, -1)
    return Orbit(
        np.moveaxis(states, 0, -1),
        frames[:tangents],
        _propagators(frames, angles.T) if tangents == 2 else None,
        friction_time.T,
        annihilations.T,
        evaluations,
    )


@compiled
def _orbits(q, times, tangents, control, states, frames, angles, friction_time, annihilations, evaluations, status):
    K, y, new, carry, tally, frame = workspace()
    for i in range(len(q)):
        q[i, START] = times[i, 0]
        start(q[i], states[i, 0, 0], states[i, 1, 0], y, carry)
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


def _propagators(frames, angles):
    """Q R Q0^T of each interval, (2, 2, n - 1, N)."""

    def rotation(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    if np.any(frames[LOG1] > 700):
        raise DivergedError("the tangent map of an interval overflows: ask for the solution at more times")
    r11, r22 = np.exp(frames[LOG1]), np.exp(frames[LOG2])
    upper = np.array([[r11, r11 * frames[SHEAR]], [np.zeros_like(r11), r22]])
    return np.einsum("ij...,jk...,lk...->il...", rotation(angles[1:]), upper, rotation(angles[:-1]))


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
