"""A family piece by piece: how large a block of it is, and one block after the other.

A member's numbers do not depend on its company, so neither do they on the blocks. Executors, progress and checkpoints
are the work of `sweep`, which is imported when it is called for.
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from vectorized import processors

from . import checks
from .flow import METHODS, POLICIES
from .oscillator import Duffing

BLOCK = 256  # members, where the caller knows nothing better
WAVE = 4096  # blocks handed to the threads at a time
# Seconds of one core in a block: far above the cost of handing one over (a few milliseconds at worst), and short
# enough that an interrupted run, whose blocks under way come to their end, is over within a second (if it is not asked
# for so many thousand periods that the fewest members take longer).
BLOCK_SECONDS = 0.2
# Roughly the seconds that a member takes for a period: by Runge-Kutta, with 500 steps, and in friction time. There it
# varies by ten, with tolerance, forcing and p.
_RK4, _FRICTION_TIME = 5e-6, 5e-5
# Members that they advance by one instruction, and in one go. In friction time a block has no more than 16, half of the
# kernel's lanes: twice as many gain a few parts in a hundred, and where they creep they take too long for a block.
_RK4_LANES, _FRICTION_LANES = (8, 64), (8, 16)


def block_of(seconds, groups=(1,)):
    """Members in a block, where one takes about so many seconds.

    groups : numbers of members, rising, that are advanced side by side: the block is made of the largest that fits
    """
    size = min(4096, int(BLOCK_SECONDS / seconds))
    group = max((g for g in groups if g <= size), default=groups[0])
    return max(1, size // group) * group


def block_for(periods, method="auto", steps_per_period=500, **_):
    """Members in a block that is followed for so many periods; method and options as for `duffing.flow.integrate`."""
    if checks.choice("method", method, METHODS) != "rk4":
        return block_of(periods * _FRICTION_TIME, _FRICTION_LANES)
    # A steps_per_period that is no number is refused later, by the integrator.
    steps = steps_per_period if isinstance(steps_per_period, int) and steps_per_period > 0 else 500
    return block_of(periods * _RK4 * steps / 500, _RK4_LANES)


def over_blocks(
    function, osc, state, options, *, block=BLOCK, dwindling=False, executor=None, progress=None, checkpoint=None,
    on_failure="raise", rows=None,
):  # the problem, then how it is run  # fmt: skip
    """function(osc, state, threads=..., **options) over a family of N members, block by block.

    function : returns an array whose last axis is the members' (as many as it is given, whatever their number)
    state : (2, N), or more rows if the function takes them
    options : passed on; "threads" among them is the number of threads at once here, or in each block of an executor
    block : members in a block; a matter of speed, as all that follows
    dwindling : the function drops members on its way: with little left of each block many small blocks are slow, so
        that the family is cut only for an executor, progress or checkpoint
    executor : any concurrent.futures executor (threads, processes, dask's `Client.get_executor()`), or a function
        without arguments that makes one; None is threads here
    progress : True, a bar where somebody watches; or called as progress(done, total) with numbers of members
    checkpoint : a folder for finished tasks, from which the same call goes on where an earlier one ended
    on_failure : "raise", or "nan": members without an answer are NaN, and one warning says so; rows : a member's shape

    Returns the array over all members, the same bit for bit whatever the block, executor and checkpoint. Memory beyond
    it and the family is that of the tasks under way, at most `workers.IN_FLIGHT`.

    Raises ValueError for an invalid executor, progress or checkpoint; LostWorkerError when a task goes on killing its
    worker; and what the function raises. Whatever ends the run, finished tasks stay in the checkpoint.
    """
    options = dict(options)
    threads = options.pop("threads", None)
    here = processors.available() if threads is None else checks.count("threads", threads)
    checks.count("block", block)
    lenient = checks.choice("on_failure", on_failure, POLICIES) == "nan"
    if executor is None and progress is None and checkpoint is None and not lenient:
        columns = checks.model(osc).columns()
        if dwindling or state.shape[1] <= 2 * here * block:
            # Little work is left whole to the integrator, which has threads of its own, in the caller's thread.
            return _in_threads(function, columns, state, {**options, "threads": here}, state.shape[1], 1)
        return _in_threads(function, columns, state, {**options, "threads": 1}, block, here)
    from .sweep.families import spread  # no figure of the paper asks for what it can do

    inside = here if executor is not None and threads is not None else 1
    rows = rows if lenient else None
    return spread(function, osc, state, options, block, here, inside, executor, progress, checkpoint, rows)


def by_exponent(columns):
    """The order (N,) in which members of one exponent p stand side by side: the kernels share its table of powers."""
    return np.argsort(columns[1], kind="stable")


def _in_threads(function, columns, state, options, block, threads):
    order, result = by_exponent(columns), None

    def run(start):
        members = order[start : start + block]
        return members, function(Duffing(*columns[:, members]), np.ascontiguousarray(state[:, members]), **options)

    def enter(members, rows):
        nonlocal result
        if result is None:
            result = np.empty((*rows.shape[:-1], order.size), rows.dtype)
        result[..., members] = rows

    if block >= order.size:
        enter(*run(0))
        return result
    with ThreadPoolExecutor(threads) as pool:
        try:
            for wave in range(0, order.size, WAVE * block):  # a bounded number waits at a time
                for done in pool.map(run, range(wave, min(wave + WAVE * block, order.size), block)):
                    enter(*done)
        except BaseException:  # an error, or Ctrl-C: what has not begun never does
            pool.shutdown(cancel_futures=True)
            raise
    return result
