"""From a laptop to a cluster: what a block and a task cost here, and what follows for larger families.

    python benchmarks/scale.py

Measured on this machine: the time of a block of lambda_1 over amplitudes (the paper's algorithm and friction time), and
what a task adds on threads, processes and a dask cluster of two worker processes. Computed from it (`cost`):
from how many members on a thousand dask workers beat this machine's processors, and what a plane of 4096 x 4096 takes.
"""

import os
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context

from dask.distributed import Client, LocalCluster

from duffing import Duffing
from duffing.sweep.cost import Workers, block_seconds, pays_from, seconds, workers

PLANE = 4096 * 4096
CORES = 1000


@contextmanager
def dask():
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster,
        Client(cluster) as client,
    ):
        yield client.get_executor()


def main():
    executors = {
        "threads": partial(ThreadPoolExecutor, 2),
        "processes": partial(ProcessPoolExecutor, 2, mp_context=get_context("spawn")),
        "dask": dask,
    }
    found = {name: workers(make, 2) for name, make in executors.items()}
    for name, by in found.items():
        print(f"{name:10} ready after {by.start:6.2f} s, a task adds {1e3 * by.task:6.2f} ms")
    here = Workers(os.cpu_count(), 0.0, found["threads"].task)
    there = Workers(CORES, found["dask"].start, found["dask"].task)
    for method in ("rk4", "friction"):
        for p in (0.1, 1.0):
            members, block = block_seconds(Duffing(p=p, mu=0.27), method=method, k=1)
            print(f"\n{method}, p = {p}: a block of {members} members takes {block:.3f} s of one core")
            blocks = -(-PLANE // members)
            least = pays_from(block, here, there)
            print(f"  {CORES} cores pay from", "no size on" if least is None else f"{least * members} members on")
            for name, by in ((f"{here.count} cores here", here), (f"{CORES} cores", there)):
                print(f"  4096 x 4096 on {name}: {seconds(blocks, block, by) / 60:.1f} minutes")


if __name__ == "__main__":
    main()
