"""Families over cores or a cluster: cut into blocks, mapped, and put together again.

A member's numbers do not depend on its company, so neither do they on the blocks, the workers or the order of arrival.
"""

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from functools import partial

import numpy as np

from .. import checks
from ..blocks import by_exponent
from ..oscillator import Duffing
from .checkpoint import Checkpoint
from .failures import announce, attempted
from .progress import reporting
from .workers import completed, is_executor

# A task is one block, or several in a family so large that there would be more tasks than this: dask's scheduler takes
# milliseconds for a task, a folder of kept tasks should hold no millions of files.
TASKS = 4096
# Seconds to wait after an error for what is nearly done, where it would be kept: dask reports an error at once, but
# has yet to fetch results that were there before it.
GRACE = 1.0


def spread(
    function, osc, state, options, block, threads, inside, executor=None, progress=None, checkpoint=None, rows=None
):
    """What `duffing.blocks.over_blocks` does when it is asked for more than one piece; the arguments as there.

    threads : blocks at once where there is no executor; inside : threads of each block; rows : None, or the shape of
    a member's result, which is NaN where it has no answer
    """
    if executor is not None and not is_executor(executor):
        raise ValueError(f"executor = {executor!r}: must be None, an executor or a function that makes one")
    total = state.shape[1]
    family = _Family(osc, state, block * -(-total // (block * TASKS)))
    # A block with NaN is no result of a run that does not allow them.
    run = options if rows is None else {**options, "on_failure": "nan"}
    store = None if checkpoint is None else Checkpoint(checkpoint, function, run)
    # Threads see it and stop between two blocks; processes are ended, and a cluster is let be.
    stop = threading.Event() if executor is None or isinstance(executor, ThreadPoolExecutor) else None

    def arguments(start):
        return *family.part(start), function, {**options, "threads": inside}, block, stop, rows

    with reporting(progress, total) as report:
        missing = [s for s in family.starts if store is None or not family.restore(s, store, report)]
        source = partial(ThreadPoolExecutor, min(threads, len(family.starts))) if executor is None else executor
        try:
            with closing(completed(source, run_task, arguments, missing, 0.0 if store is None else GRACE)) as results:
                for start, array in results:
                    if store is not None:
                        store.keep(store.key(*family.part(start)), array)
                    family.enter(start, array, report)
        finally:
            if stop is not None:
                stop.set()
    if rows is not None:
        announce(family.result, osc, lambda members: function(osc.members(members), state[:, members], **options))
    return family.result


class _Family:
    """The members in tasks, each known by its start, and the results as they come in."""

    def __init__(self, osc, state, size):
        self.columns, self.state, self.size = checks.model(osc).columns(), state, size
        self.order = by_exponent(self.columns)
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


def run_task(columns, state, function, options, block, stop, rows=None):
    """What a worker does: one block of its task after the other. What it returns once stopped nobody takes."""
    results = []
    for start in range(0, state.shape[1], block):
        if stop is not None and stop.is_set():
            return None
        members = slice(start, start + block)
        results.append(_on_block(function, Duffing(*columns[:, members]), state[:, members], options, rows))
    return np.concatenate(results, axis=-1)


def _on_block(function, osc, state, options, rows):
    def some(members):
        return function(osc.members(members), np.ascontiguousarray(state[:, members]), **options)

    if rows is None:
        return function(osc, np.ascontiguousarray(state), **options)
    return attempted(some, np.arange(state.shape[1]), rows)
