"""How cost grows: with trajectories, periods, p, tolerance, and what a second thread gives. All are ratios."""

import os
import statistics
import time

import numpy as np

from duffing.integrators import rk4
from duffing.integrators.friction_time import adaptive as friction
from vectorized import processors

from .rewrites import START
from .sweep import family


def task(integrate, p, members, periods, threads=1, **options):
    """run() for state and one tangent of a family of the sweep."""
    osc = family(p, members)
    t = osc.period * np.arange(periods + 1)
    return lambda: integrate(osc, START, t, tangents=1, threads=threads, **options)


def relative(tasks, unit, rounds, clock=time.process_time):
    """Times per work of tasks, dict key -> (run, work), over that of the key `unit`: dict key -> median of rounds."""
    for run, _ in tasks.values():
        run()
    ratios = {key: [] for key in tasks}
    for _ in range(rounds):
        times = {}
        for key, (run, work) in tasks.items():
            start = clock()
            run()
            times[key] = (clock() - start) / work
        for key, seconds in times.items():
            ratios[key].append(seconds / times[unit])
    return {key: float(f"{statistics.median(found):.3g}") for key, found in ratios.items()}


def measure(rounds, quick=False):
    """dict of a series' name -> dict of its values -> cost, as described in `TITLES`."""
    most, far = (64, 10) if quick else (4096, 100)
    kernels = {"rk4": rk4.integrate, "friction": friction.integrate}
    found = {}
    for name, integrate in kernels.items():
        few = 8 if name == "friction" else 1
        sizes = [n for n in (1, 8, 64, 512, 4096) if n <= most // few]
        found[f"{name}, trajectories"] = relative(
            {n: (task(integrate, 0.1, n, 10), n) for n in sizes}, sizes[-1], rounds
        )
        lengths = [n for n in (1, 10, 100) if n <= far]
        found[f"{name}, periods"] = relative(
            {n: (task(integrate, 0.1, 64 // few, n), n) for n in lengths}, lengths[-1], rounds
        )
        exponents = (0.1, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0)
        found[f"{name}, p"] = relative({p: (task(integrate, p, 256 // few, 10), 1) for p in exponents}, 1.0, rounds)
    tolerances = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
    found["friction, tolerance"] = relative(
        {r: (task(friction.integrate, 0.1, 32, 10, rtol=r, atol=r / 100), 1) for r in tolerances}, 1e-10, rounds
    )
    if len(_processors()) > 1:
        for name, integrate in kernels.items():
            work = {n: (task(integrate, 0.1, 1024 if name == "rk4" else 64, 10, threads=n), 1) for n in (1, 2)}
            found[f"{name}, threads"] = relative(work, 1, rounds, time.perf_counter)
    return found


def _processors():
    return os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else range(processors.available())


TITLES = {
    "trajectories": "p = 0.1: time for a trajectory, by the number of trajectories; the most = 1",
    "periods": "p = 0.1: time for a period, by the number of periods; the most = 1",
    "p": "time by p; p = 1 is 1",
    "tolerance": "p = 0.1: time by the relative tolerance; 1e-10 is 1",
    "threads": "p = 0.1: elapsed time by threads; one thread = 1",
}
