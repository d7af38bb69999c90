"""What both front ends of `follow` share: members, tolerances, threads and the names of failures."""

import math
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from . import checks
from .compiled import compiled
from .creep import at_rest
from .dop853 import STAGES
from .errors import ConvergenceError, DivergedError
from .follow import CREEP, DIVERGED, DONE, MOVE, NO_CROSSING, PAST_UNKNOWN, STUCK, TOO_MANY_STEPS
from .friction_time import ETA2, OMEGA, XI1, M, N, P, W, X, force, variable

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


def members(osc, state, shape):
    """Parameters (6, N), starts (2, N) and N for a family of the shape."""
    columns = osc.columns()
    size = math.prod(shape)
    if columns.shape[1] != size:
        columns = np.repeat(columns, size, axis=1)
    return columns, checks.state(state, (size,) if np.shape(state) == (2, size) else shape), size


def tolerances(rtol, atol, max_steps, switch=0.6):
    """The four numbers that control the steps, checked, in the order that `follow` takes them."""
    switch = checks.positive("switch", switch)
    if switch > 0.6:
        raise ValueError(f"switch = {switch}: must be a number in (0, 0.6]")
    return checks.positive("rtol", rtol), checks.positive("atol", atol), checks.count("max_steps", max_steps), switch


def in_parallel(run, size, threads):
    """run(slice of the members) on up to `threads` threads (None: the processors) until all are done."""
    threads = os.cpu_count() if threads is None else checks.count("threads", threads)
    parts = [slice(i, i + _BLOCK) for i in range(0, size, _BLOCK)]
    if threads == 1 or len(parts) == 1:
        for part in parts:
            run(part)
    else:
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(run, parts))


def raise_failures(status, columns):
    """The named error of the first member that failed."""
    failed = np.flatnonzero(status != DONE)
    if failed.size:
        kind, reason = _FAILURES[status[failed[0]]]
        names = ("alpha", "p", "mu", "omega", "delta", "gamma")
        member = ", ".join(f"{n} = {v:g}" for n, v in zip(names, columns[:, failed[0]], strict=True))
        raise kind(f"{failed.size} of {status.size} members fail; the first, {member}: {reason}")


@compiled
def workspace():
    """Arrays K, y, new, carry, tally, frame for one trajectory after another."""
    return np.zeros((STAGES, 8)), np.zeros(8), np.zeros(8), np.zeros(2), np.zeros(3, dtype=np.int64), np.zeros(3)


@compiled
def start(q, x, v, y, carry):
    """Set y to the state (x, v) with the identity as tangents, and carry to a careful first step."""
    y[:] = 0.0
    y[X], y[W], y[XI1], y[ETA2] = x, variable(q, v), 1.0, 1.0
    carry[MOVE], carry[CREEP] = 0.05 / q[OMEGA], 0.0
    if q[P] > 1.0 and at_rest(q, x, force(q, x, 0.0), v):
        q[M], q[N] = 1.0, q[P]  # at rest without force w would stay what it is for ever: take v itself
