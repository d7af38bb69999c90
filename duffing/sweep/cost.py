"""What a sweep costs in blocks and tasks, measured, and from it when a cluster pays.

Workers take blocks as they get free; one process hands tasks over, one after another. A run of B blocks in T tasks on n
workers therefore takes about start + max(T task, B block / n): whichever of the two queues is the longer.
"""

import time
from typing import NamedTuple

import numpy as np

from ..lyapunov import block_members, lyapunov_spectrum
from ..oscillator import Duffing
from . import families as sweep


class Workers(NamedTuple):
    """count of workers; start (seconds) until the first is ready; task (seconds) that handing over one more takes."""

    count: int
    start: float
    task: float


def block_seconds(osc, repeats=3, **options):
    """(members, seconds of one core) of a block of `lyapunov_spectrum(family, **options)`: the least of the repeats.

    osc : one oscillator; the block's family has forcings from its own to 2 % more
    Processor time, so that what else the machine does hardly counts.
    """
    members = block_members(**options)
    mu = osc.mu * np.linspace(1.0, 1.02, members)
    family = Duffing(osc.alpha, osc.p, mu, osc.omega, osc.delta, osc.gamma)
    times = []
    for _ in range(repeats):
        start = time.process_time()
        lyapunov_spectrum(family, threads=1, history=False, **options)
        times.append(time.process_time() - start)
    return members, min(times)


def workers(make, count, tasks=200):
    """The Workers of the executor that make() gives, measured on empty blocks; it is shut down again.

    Cutting the family, sending blocks and entering their results are all in `task`.
    """
    start = time.perf_counter()
    with make() as executor:
        _empty_sweep(executor, 1)
        ready = time.perf_counter()
        _empty_sweep(executor, tasks)
        return Workers(count, ready - start, (time.perf_counter() - ready) / tasks)


def seconds(blocks, block, by):
    """Time of a run of so many blocks, of `block` seconds each, by the Workers `by`."""
    return by.start + max(min(blocks, sweep.TASKS) * by.task, block, blocks * block / by.count)


def pays_from(block, here, there, most=10**12):
    """The number of blocks from which the Workers `there` are sooner done than those `here`; None if there is none."""

    def pays(blocks):
        return seconds(blocks, block, there) < seconds(blocks, block, here)

    if not pays(most):
        return None
    too_few, enough = 0, most
    while enough - too_few > 1:
        middle = (too_few + enough) // 2
        too_few, enough = (too_few, middle) if pays(middle) else (middle, enough)
    return enough


def _empty_sweep(executor, tasks):
    members = 64 * tasks
    osc = Duffing(mu=np.linspace(0.1, 0.3, members))
    sweep.over_blocks(_nothing, osc, np.zeros((2, members)), {}, block=64, executor=executor)


def _nothing(osc, state, threads):
    return state
