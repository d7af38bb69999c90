"""Families over cores or a cluster: cut into blocks, mapped, and put together again.

A member's numbers do not depend on its company, so neither do they on the blocks, the workers or the order of arrival.
"""

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import fields
from functools import partial

import numpy as np

from .. import checks
from ..flow import METHODS
from ..integrators import processors
from ..oscillator import Duffing
from .checkpoint import Checkpoint
from .progress import reporting
from .workers import completed, is_executor

BLOCK = 256  # members, where the caller knows nothing better
# Seconds of one core in a block: far above the cost of handing one over (a few milliseconds at worst), and short
# enough that an interrupted run, whose blocks under way come to their end, is over within a second (if it is not asked
# for so many thousand periods that the fewest members take longer).
BLOCK_SECONDS = 0.2
# A task is one block, or several in a family so large that there would be more tasks than this: dask's scheduler takes
# milliseconds for a task, a folder of kept tasks should hold no millions of files.
TASKS = 4096

# Roughly the seconds that a member takes for a period: by Runge-Kutta, with 500 steps, and in friction time. There it
# varies by ten, with tolerance, forcing and p.
_RK4, _FRICTION_TIME = 5e-6, 5e-5
# Members that they advance by one instruction, and in one go. In friction time a block has no more than 16, half of the
# kernel's lanes: twice as many gain a few parts in a hundred, and where they creep they take too long for a block.
_RK4_LANES, _FRICTION_LANES = (8, 64), (8, 16)
# Seconds to wait after an error for what is nearly done, where it would be kept: dask reports an error at once, but
# has yet to fetch results that were there before it.
GRACE = 1.0


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
    function, osc, state, options, *, block=BLOCK, dwindling=False, executor=None, progress=None, checkpoint=None
):
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

    Returns the array over all members, the same bit for bit whatever the block, executor and checkpoint. Memory beyond
    it and the family is that of the tasks under way, at most `workers.IN_FLIGHT`.

    Raises ValueError for an invalid executor, progress or checkpoint; LostWorkerError when a task goes on killing its
    worker; and what the function raises. Whatever ends the run, finished tasks stay in the checkpoint.
    """
    if executor is not None and not is_executor(executor):
        raise ValueError(f"executor = {executor!r}: must be None, an executor or a function that makes one")
    options, total = dict(options), state.shape[1]
    threads = options.pop("threads", None)
    here = processors.available() if threads is None else checks.count("threads", threads)
    checks.count("block", block)
    # Little work that nobody wants to see in parts is left whole to the integrator, which has threads of its own.
    unseen = executor is None and progress is None and checkpoint is None
    whole = unseen and (dwindling or total <= 2 * here * block)
    inside = here if executor is not None and threads is not None else 1
    block = total if whole else block
    family = _Family(osc, state, block * -(-total // (block * TASKS)))
    if whole:  # here, in the caller's thread, where an interrupt arrives at once
        family.enter(0, _run(*family.part(0), function, {**options, "threads": here}, total, None), lambda done: None)
        return family.result
    store = None if checkpoint is None else Checkpoint(checkpoint, function, options)
    # Threads see it and stop between two blocks; processes are ended, and a cluster is let be.
    stop = threading.Event() if executor is None or isinstance(executor, ThreadPoolExecutor) else None

    def arguments(start):
        return *family.part(start), function, {**options, "threads": inside}, block, stop

    with reporting(progress, total) as report:
        missing = [s for s in family.starts if store is None or not family.restore(s, store, report)]
        source = partial(ThreadPoolExecutor, min(here, len(family.starts))) if executor is None else executor
        try:
            with closing(completed(source, _run, arguments, missing, 0.0 if store is None else GRACE)) as results:
                for start, array in results:
                    if store is not None:
                        store.keep(store.key(*family.part(start)), array)
                    family.enter(start, array, report)
        finally:
            if stop is not None:
                stop.set()
    return family.result


class _Family:
    """The members in tasks, each known by its start, and the results as they come in."""

    def __init__(self, osc, state, size):
        self.columns, self.state, self.size = checks.model(osc).columns(), state, size
        # Members with one exponent p side by side: the kernels share its table of powers.
        self.order = np.argsort(self.columns[1], kind="stable")
        self.starts = range(0, state.shape[1], size)
        self.result, self.done = None, 0

    def members(self, start):
        return self.order[start : start + self.size]

    def part(self, start):
        """Parameters (6, n) and states (2, n) of the task."""
        members = self.members(start)
        return np.ascontiguousarray(self.columns[:, members]), np.ascontiguousarray(self.state[:, members])

    def restore(self, start, store, report):
        """Whether the task was in the checkpoint, and is now entered."""
        array = store.load(store.key(*self.part(start)))
        if array is not None:
            self.enter(start, array, report)
        return array is not None

    def enter(self, start, array, report):
        if self.result is None:
            self.result = np.empty((*array.shape[:-1], self.state.shape[1]), array.dtype)
        self.result[..., self.members(start)] = array
        self.done += array.shape[-1]
        report(self.done)


def _run(columns, state, function, options, block, stop):
    """What a worker does: one block of its task after the other. What it returns once stopped nobody takes."""
    names = [field.name for field in fields(Duffing)]
    results = []
    for start in range(0, state.shape[1], block):
        if stop is not None and stop.is_set():
            return None
        members = slice(start, start + block)
        osc = Duffing(**dict(zip(names, columns[:, members], strict=True)))
        results.append(function(osc, np.ascontiguousarray(state[:, members]), **options))
    return np.concatenate(results, axis=-1)
