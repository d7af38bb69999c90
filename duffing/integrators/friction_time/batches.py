"""What both front ends of `run_lanes` share: members, tolerances, threads and the names of failures."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from ... import checks
from ...errors import ConvergenceError, DivergedError
from .. import processors
from .block import WIDTH
from .equations import parameters
from .scheduler import AT_T, RESULTS, run_lanes
from .step_control import DIVERGED, DONE, NO_CROSSING, PAST_UNKNOWN, STUCK, TOO_MANY_STEPS

_MOST = 256  # members of a part at most
# Steps of an interval where the caller sets no bound. The motion needs ten to some hundred in a period, the linear
# damping of a large alpha, whose steps follow its relaxation, about 10 alpha. The last ends what never would within
# half an hour or so.
_STEPS, _STEPS_OF_A_PERIOD, _MOST_STEPS = 1e5, 1e4, 1e9
_MOST_P = 1e4  # beyond it steps across |v| = 1, where the damping sets in like a wall, become endless
_FAILURES = {
    DIVERGED: (DivergedError, "the solution leaves every bound"),
    TOO_MANY_STEPS: (ConvergenceError, "too many steps"),
    PAST_UNKNOWN: (
        ConvergenceError,
        "backward in time the solution stays on the slow branch of a creep, where every past ends: it has none",
    ),
    STUCK: (ConvergenceError, "the velocity passes through zero in a creep, where no turning point is distinguished"),
    NO_CROSSING: (ConvergenceError, "no turning point was found in time"),
}


def members(osc, state, shape):
    """Parameters (6, N), starts (2, N) and N for a family of the shape."""
    columns = osc.columns()
    size = math.prod(shape)
    if columns.shape[1] != size:
        columns = np.repeat(columns, size, axis=1)
    return columns, checks.state(state, (size,) if np.shape(state) == (2, size) else shape), size


def tolerances(rtol, atol, switch=0.6):
    """The three numbers that control the steps, checked, in the order that `run_lanes` takes them."""
    switch = checks.positive("switch", switch)
    if switch > 0.6:
        raise ValueError(f"switch = {switch}: must be a number in (0, 0.6]")
    return checks.positive("rtol", rtol), checks.positive("atol", atol), switch


def most_steps(max_steps, columns, times):
    """The most steps (N, n - 1) of each interval of the times (N, n): max_steps, or if it is None what follows from
    the interval's length.

    That is at least 1e5, and 1e4 for each period of what is fastest: the forcing, the linear spring, or the cubic
    spring where it balances the forcing amplitude.
    """
    if max_steps is not None:
        return np.full((times.shape[0], times.shape[1] - 1), float(checks.count("max_steps", max_steps)))
    _, _, mu, omega, delta, gamma = np.abs(columns)
    fastest = np.maximum(np.maximum(omega, np.sqrt(delta)), np.cbrt(mu) * gamma ** (1 / 6))
    with np.errstate(over="ignore"):
        periods = np.abs(np.diff(times, axis=1)) / (2 * np.pi) * fastest[:, None]
        return np.clip(_STEPS_OF_A_PERIOD * periods, _STEPS, _MOST_STEPS)


def integrate_members(columns, states, times, max_steps, event, beyond, tangents, control, threads):
    """Results of `run_lanes` for all members, (9, n - 1, N), and the number of force evaluations (N,).

    columns (6, N), states (2, N), times (N, n); max_steps : of an interval, or None
    event, beyond, tangents, control : as for `run_lanes`
    threads : at most so many at once (None: the processors that the process may use)

    Raises the named error of the first member that fails.
    """
    alpha, p = columns[:2]
    least = np.finfo(float).eps / control[0]  # w = |v|^p holds v to a relative eps / p
    allowed = (alpha == 0) | ((p >= least) & (p <= _MOST_P))
    if not np.all(allowed):
        bad = p[allowed.argmin()]
        raise ValueError(f"p = {bad}: must be from {least:.1e} (for rtol = {control[0]}) to {_MOST_P:g}")
    threads = processors.available() if threads is None else checks.count("threads", threads)
    size, intervals = times.shape[0], times.shape[1] - 1
    # One layout in memory, for which the kernel is compiled once.
    rows, starts, times = parameters(columns), np.ascontiguousarray(states.T), np.ascontiguousarray(times)
    steps = most_steps(max_steps, columns, times)
    results = np.zeros((size, intervals, len(RESULTS)))
    status, evaluations = np.full(size, DONE), np.zeros(size, dtype=np.int64)

    def run(part):
        out = results[part], status[part], evaluations[part]
        run_lanes(rows[part], starts[part], times[part], steps[part], event, beyond, tangents, control, *out)

    # Parts long enough that lanes seldom idle at their ends, short enough to balance and to interrupt.
    step = min(max(-(-size // (4 * threads)), min(4 * WIDTH, -(-size // threads))), _MOST) if threads > 1 else _MOST
    parts = [slice(i, i + step) for i in range(0, size, step)] if intervals > 0 else []
    if threads == 1 or len(parts) < 2:
        for part in parts:
            run(part)
    else:
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(run, parts))
    _raise_failures(status, columns, times, steps, results, control)
    return results.transpose(2, 1, 0), evaluations


def _raise_failures(status, columns, times, steps, results, control):
    """The named error of the first member that failed."""
    failed = np.flatnonzero(status != DONE)
    if failed.size:
        first = failed[0]
        kind, reason = _FAILURES[status[first]]
        if status[first] == TOO_MANY_STEPS:
            k = np.argmin(results[first, :, AT_T] != 0)  # the first interval that has no results
            reason = (
                f"max_steps = {steps[first, k]:.0f} steps do not reach from t = {times[first, k]:g} to "
                f"t = {times[first, k + 1]:g}: give a larger max_steps, or a larger rtol (it is {control[0]:g})"
            )
        names = ("alpha", "p", "mu", "omega", "delta", "gamma")
        member = ", ".join(f"{n} = {v:g}" for n, v in zip(names, columns[:, first], strict=True))
        raise kind(f"{failed.size} of {status.size} members fail; the first, {member}: {reason}")
