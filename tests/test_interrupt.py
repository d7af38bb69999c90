"""Ctrl-C ends a run soon and leaves no process behind."""

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from sweep_cases import PLANE, marked, marks, starts

from duffing.blocks import over_blocks

# A run of many minutes on the executor that the command line names, or one that is not cut into blocks.
SCRIPT = """
import sys
import threading
from functools import partial
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
import numpy as np
from duffing import Duffing, lyapunov_spectrum, two_trajectory_exponent

def started(done, total):
    print("started", flush=True)

def run(executor, progress=started):
    osc = Duffing(p=0.1, mu=np.linspace(0.1, 0.3, 100_000))
    lyapunov_spectrum(osc, method="rk4", executor=executor, progress=progress, history=False)

if __name__ == "__main__":
    kind = sys.argv[1]
    processes = partial(ProcessPoolExecutor, 2, mp_context=get_context("spawn"))
    if kind == "threads":
        run(None)
    elif kind == "pieces":
        lyapunov_spectrum(Duffing(p=0.1, mu=0.2), periods=1, method="rk4")
        threading.Timer(1.0, started, (0, 0)).start()  # in the midst of it
        run(None, progress=None)
    elif kind == "companion":
        two_trajectory_exponent(Duffing(), periods=1)
        threading.Timer(1.0, started, (0, 0)).start()  # in the midst of it
        two_trajectory_exponent(Duffing(p=0.1, mu=0.2), periods=10**6)
    elif kind == "whole":
        from duffing.basins.attractors import settle
        osc, states = Duffing(p=0.1, mu=0.27), np.random.default_rng(0).uniform(-1, 1, (2, 100_000))
        settle(osc, states[:, :4], periods=4)
        threading.Timer(2.0, started, (0, 0)).start()  # in the midst of it
        settle(osc, states, periods=100_000)
    elif kind == "function":
        run(processes)
    elif kind == "processes":
        with processes() as executor:
            run(executor)
    elif kind == "dask":
        from dask.distributed import Client, LocalCluster
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster:
            with Client(cluster) as client:
                run(client.get_executor())
"""


def alive(group):
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.parametrize(
    ("kind", "whom"),
    [
        ("threads", "terminal"),
        ("threads", "kill"),
        ("pieces", "kill"),
        ("pieces", "terminal"),
        ("companion", "kill"),
        ("whole", "kill"),
        ("processes", "terminal"),
        ("function", "kill"),
        ("dask", "terminal"),
    ],
)
def test_an_interrupt_ends_the_run_and_every_process_that_it_started(kind, whom, tmp_path):
    """A terminal interrupts all processes of the group, `kill` the first alone."""
    script = tmp_path / "script.py"
    script.write_text(SCRIPT, encoding="utf-8")
    process = subprocess.Popen(
        [sys.executable, script, kind],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True, encoding="utf-8",
    )  # what, and how  # fmt: skip
    try:
        assert process.stdout.readline() == "started\n"
        (os.killpg if whom == "terminal" else os.kill)(process.pid, signal.SIGINT)
        _, errors = process.communicate(timeout=60 if kind == "dask" else 30)  # on a busy machine, too
        assert process.returncode == -signal.SIGINT
        assert errors.rstrip().endswith("KeyboardInterrupt")
        deadline = time.monotonic() + 10
        while alive(process.pid) and time.monotonic() < deadline:
            time.sleep(0.01)
        assert not alive(process.pid)
    finally:
        if alive(process.pid):
            os.killpg(process.pid, signal.SIGKILL)


@pytest.mark.parametrize("last", [1, 5, 10])
def test_an_interrupt_at_any_block_is_raised_even_where_python_would_forget_it(last, tmp_path):
    """Raised inside a destructor an exception is printed and dropped; dask's futures have destructors."""

    class Interrupts:
        def __del__(self):
            signal.raise_signal(signal.SIGINT)

    def report(done, total):
        if done == 4 * last:
            Interrupts()

    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        over_blocks(marks, PLANE, starts(PLANE), {}, block=4, progress=report, checkpoint=tmp_path)
    assert signal.getsignal(signal.SIGINT) is before is signal.default_int_handler
    assert len(list(tmp_path.iterdir())) == last


def test_in_another_thread_where_signals_are_not_ours_a_sweep_runs_as_well():
    with ThreadPoolExecutor(1) as pool:
        result = pool.submit(over_blocks, marks, PLANE, starts(PLANE), {}, block=4, progress=print).result()
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))
