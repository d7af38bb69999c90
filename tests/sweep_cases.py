"""Functions that the tests of sweeps hand to workers, and pools that start quickly. A worker imports this module."""

import os
import signal
import time
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from duffing import DivergedError, Duffing

PLANE = Duffing(p=np.array([0.5, 1.0, 0.5, 2.0]), mu=np.linspace(0.1, 0.3, 10)[:, None])


def context():
    """How processes are started: from a server that has imported the package once and holds no thread."""
    chosen = get_context("forkserver")
    chosen.set_forkserver_preload(["sweep_cases"])
    return chosen


def marks(osc, state, threads, log=None):
    """Three rows that say which member is where; one line of the log a block."""
    if log is not None:
        with open(log, "a", encoding="utf-8") as file:
            file.write(f"{osc.mu[0]!r} {osc.p[0]!r} {state.shape[1]}\n")
    return np.stack([osc.mu, osc.p, state[0] + threads * 0])


def marked(osc, state):
    """What `marks` gives for the family, and where."""
    columns = osc.columns()
    return np.stack([columns[2], columns[1], state[0]])


def starts(osc):
    """A state of its own for each member."""
    return np.arange(2.0 * osc.columns().shape[1]).reshape(2, -1)


def diverges_at(osc, state, threads, mu):
    """`marks`, but a member with this mu has no solution."""
    if np.any(osc.mu == mu):
        raise DivergedError(f"no solution at mu = {mu:g}")
    return marks(osc, state, threads)


def kills_its_worker(osc, state, threads, mu, folder=None, after=0.0):
    """`marks`, but a block with this mu ends its process, each time or, with a folder to remember it in, once.

    after : seconds, for a worker that has just begun to be at home
    """
    if np.any(osc.mu == mu):
        memory = Path(folder, "killed") if folder else None
        if memory is None or not memory.exists():
            if memory:
                memory.touch()
            time.sleep(after)
            os.kill(os.getpid(), signal.SIGKILL)
    return marks(osc, state, threads)
