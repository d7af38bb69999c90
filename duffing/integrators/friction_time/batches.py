"""What both front ends of `run_lanes` share: members, tolerances, threads and the names of failures."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from ... import checks
from ...errors import ConvergenceError, DivergedError
from ...oscillator import Duffing
from vectorized import processors
from .block import WIDTH
from .equations import parameters
from .scheduler import AT_T, RESULTS, run_lanes
from .step_control import DIVERGED, DONE, NO_CROSSING, PAST_UNKNOWN, STUCK, TOO_MANY_STEPS

_MOST = 256  # members of a part at most
# Where the caller sets no bound, so many steps are allowed in an interval, and so many more for each period gone in it:
# of the forcing, of the linear spring, or of the cubic one where it balances the forcing amplitude, whichever is the
# shortest. Time that no longer goes on, where a solution becomes infinite, ends an interval of any length. The motion
# needs ten to some hundred steps in a period; a large alpha with p = 1, whose relaxation they follow, about 10 alpha.
# Where the periods of an interval are so many that it could take more than the last, some minutes, each has less.
_STEPS, _STEPS_OF_A_PERIOD, _MOST_STEPS = 100_000, 10_000, 10**8
_MOST_P = 1e4  # beyond it steps across |v| = 1, where the damping sets in like a wall, become endless
_FAILURES = {
    DIVERGED: (DivergedError, "the solution leaves every bound"),
    TOO_MANY_STEPS: (ConvergenceError, "too many steps"),
    PAST_UNKNOWN: (
        ConvergenceError,
        "backward in time the solution stays on the slow branch of a creep, where every past ends: it has none",
    ),
    STUCK: (ConvergenceError, "the velocity passes through zero in a creep, where a turning point has no derivatives"),
    NO_CROSSING: (ConvergenceError, "no turning point was found in time"),
}


def members(osc, state, shape):
    """Parameters (6, N), starts (2, N) and N for a family of the shape."""
    columns = osc.columns()
    size = math.prod(shape)
    if columns.shape[1] != size:
        columns = np.repeat(columns, size, axis=1)
    return columns, checks.state(state, (size,) if np.shape(state) == (2, size) else shape), size


def tolerances(rtol, atol, max_steps, switch=0.6):
    """The four numbers that control the steps, checked, in the order that `run_lanes` takes them."""
    switch = checks.positive("switch", switch)
    if switch > 0.6:
        raise ValueError(f"switch = {switch}: must be a number in (0, 0.6]")
    most = _STEPS if max_steps is None else checks.count("max_steps", max_steps)
    return checks.positive("rtol", rtol), checks.positive("atol", atol), most, switch


def _pace(max_steps, columns, times):
    """By how much the bound on a member's steps grows for each unit of time, (N,): not at all if max_steps is given."""
    if max_steps is not None:
        return np.zeros(columns.shape[1])
    _, _, mu, omega, delta, gamma = np.abs(columns)
    fastest = np.maximum(np.maximum(omega, np.sqrt(delta)), np.cbrt(mu) * gamma ** (1 / 6))
    with np.errstate(over="ignore"):
        longest = np.abs(np.diff(times, axis=1)).max(axis=1, initial=1e-290)
        return np.minimum(_STEPS_OF_A_PERIOD / (2 * np.pi) * fastest, _MOST_STEPS / longest)


def integrate_members(columns, states, times, max_steps, event, beyond, tangents, control, threads):
    """Results of `run_lanes` for all members, (9, n - 1, N), and the number of force evaluations (N,).

    columns (6, N), states (2, N), times (N, n); max_steps : of an interval, or None for the default
    event, beyond, tangents, control : as for `run_lanes`
    threads : at most so many at once (None: the processors that the process may use)

    Raises the named error of the first member that fails.
    """
    alpha, p = columns[:2]
    least = np.finfo(float).eps / control[0]  # w = |v|^p holds v to a relative eps / p
    allowed = (alpha == 0) | ((p >= least) & (p <= _MOST_P))
    if not np.all(allowed):
        bad = p[allowed.argmin()]
        raise ValueError(f"p = {bad}, rtol = {control[0]}: p must be from 2.2e-16 / rtol = {least:.1e} to {_MOST_P:g}")
    threads = processors.available() if threads is None else checks.count("threads", threads)
    size, intervals = times.shape[0], times.shape[1] - 1
    # One layout in memory, for which the kernel is compiled once.
    rows, starts, times = parameters(columns), np.ascontiguousarray(states.T), np.ascontiguousarray(times)
    pace = _pace(max_steps, columns, times)
    results = np.zeros((size, intervals, len(RESULTS)))
    status, evaluations = np.full(size, DONE), np.zeros(size, dtype=np.int64)

    def run(part):
        out = results[part], status[part], evaluations[part]
        run_lanes(rows[part], starts[part], times[part], pace[part], event, beyond, tangents, control, *out)

    # Parts long enough that lanes seldom idle at their ends, short enough to balance and to interrupt.
    step = min(max(-(-size // (4 * threads)), min(4 * WIDTH, -(-size // threads))), _MOST) if threads > 1 else _MOST
    parts = [slice(i, i + step) for i in range(0, size, step)] if intervals > 0 else []
    if threads == 1 or len(parts) < 2:
        for part in parts:
            run(part)
    else:
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(run, parts))
    _raise_failures(status, columns, times, max_steps, results, control)
    return results.transpose(2, 1, 0), evaluations


def _raise_failures(status, columns, times, max_steps, results, control):
    """The named error of the first member that failed."""
    failed = np.flatnonzero(status != DONE)
    if failed.size:
        first = failed[0]
        kind, reason = _FAILURES[status[first]]
        if status[first] == TOO_MANY_STEPS:
            k = np.argmin(results[first, :, AT_T] != 0)  # the first interval that has no results
            default = f" (by default {_STEPS} and {_STEPS_OF_A_PERIOD} a period)" if max_steps is None else ""
            reason = (
                f"max_steps = {max_steps}{default} is too few steps from t = {times[first, k]:g} to "
                f"t = {times[first, k + 1]:g}: give a larger max_steps, or a larger rtol (it is {control[0]:g})"
            )
        member = Duffing(*columns[:, first]).named()
        raise kind(f"{failed.size} of {status.size} members fail; the first, {member}: {reason}")
