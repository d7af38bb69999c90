"""The accurate integrator: every p > 0, forward and backward, with both tangent vectors, creep included.

Front end of `run_lanes`, which steps in friction time (`equations`) with an embedded pair of order eight
(`dop853`) and in creeps with an implicit method of order nine (`radau`).
"""

import math

import numpy as np

from ... import checks
from ...errors import DivergedError
from ..solution import Solution
from .batches import integrate_members, members, tolerances
from .block import T
from .scheduler import ANGLE, ANNIHILATIONS, AT_S, AT_V, AT_X, R11, R12, R22


def integrate(osc, state, t, tangents=0, rtol=1e-10, atol=1e-12, max_steps=None, switch=0.6, threads=None):
    """Solutions at the times t, each step's error of (x, v) below atol + rtol |(x, v)|.

    Parameters
    ----------
    osc : Duffing, a single oscillator or a family of N members, 2e-16 / rtol < p <= 1e4
    state : (2,) or (2, *family) or (2, N), (x, v) at t[0]
    t : (n,) for all members or (n, N), increasing or decreasing times, met exactly
    tangents : 0, 1 or 2 tangent vectors; growth and propagators are of each interval. The state does not depend on it.
    max_steps : the most steps from one time to the next; by default 100 000, and 10 000 more for each period gone: of
        the forcing, or of the free motion where that is shorter
    switch : relaxation times an explicit step, 0 < switch <= 0.6, above which a creep is followed by implicit steps;
        the cost depends on it, the result does not
    threads : at most so many at once (default: those the process may use); the result is the same to the last bit

    Returns
    -------
    Solution : with friction_time (n - 1, N), annihilations (n - 1, N), evaluations (N,) of the force. Where a creep
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

    results, evaluations = integrate_members(columns, state, t, max_steps, T, -math.inf, tangents, control, threads)
    states = np.concatenate([state[:, None], results[[AT_X, AT_V]]], axis=1)
    return Solution(
        states,
        results[[R11, R22]][:tangents],
        _propagators(results) if tangents == 2 else None,
        results[AT_S],
        results[ANNIHILATIONS].astype(int),
        evaluations,
    )


def _propagators(results):
    """Q R Q0^T of each interval, (2, 2, n - 1, N)."""

    def rotation(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    if np.any(results[R11] > 700):
        raise DivergedError("the tangent map of an interval overflows: ask for the solution at more times")
    angles = np.concatenate([np.zeros_like(results[ANGLE, :1]), results[ANGLE]])
    r11, r22 = np.exp(results[R11]), np.exp(results[R22])
    upper = np.array([[r11, r11 * results[R12]], [np.zeros_like(r11), r22]])
    return np.einsum("ij...,jk...,lk...->il...", rotation(angles[1:]), upper, rotation(angles[:-1]))


def _times(t, size):
    """Times (N, n), strictly monotone for each member."""
    t = np.asarray(t)
    columns = t.T if t.ndim == 2 and t.shape[1] == size and t.shape[0] > 0 else t[None]
    if columns.ndim != 2 or columns.shape[1] < 2 or t.dtype.kind not in "iuf" or not np.all(np.isfinite(columns)):
        checks.times(next((c for c in columns if c.ndim != 1 or not np.all(np.isfinite(c))), columns[0]))
    steps = np.diff(columns.astype(float), axis=1)
    bad = ~(np.all(steps > 0, axis=1) | np.all(steps < 0, axis=1))
    if np.any(bad):
        raise ValueError(f"t = {columns[bad.argmax()]}: must be strictly increasing or strictly decreasing")
    return np.array(np.broadcast_to(columns, (size, columns.shape[1])), dtype=float)
