"""A sweep on a cluster: dask's scheduler and two worker processes."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from dask.distributed import Client, LocalCluster
from sweep_cases import PLANE, diverges_at, kills_its_worker, marked, marks, starts

from duffing import DivergedError, Duffing, blocks, lyapunov_spectrum
from duffing.blocks import over_blocks
from duffing.errors import LostWorkerError


@pytest.fixture(scope="module")
def client():
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster,
        Client(cluster) as client,
    ):
        # dask gives up a worker that dies as it starts, which one that a task kills can seem to do: have it replaced.
        cluster.adapt(minimum=2, maximum=2)
        client.wait_for_workers(2)
        yield client


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_exponents_are_bit_for_bit_those_computed_here(method, client, monkeypatch):
    osc = Duffing(p=np.array([[0.5], [1.0]]), mu=np.linspace(0.1, 0.3, 21))
    options = {"periods": 9, "transient": 2, "method": method}
    here = lyapunov_spectrum(osc, **options)
    monkeypatch.setattr(blocks, "BLOCK_SECONDS", 0.01)
    there = lyapunov_spectrum(osc, executor=client.get_executor(), **options)
    for ours, same in zip(there, here, strict=True):
        np.testing.assert_array_equal(ours, same)


def test_an_error_arrives_with_its_type_and_message_and_finished_blocks_are_kept(client, tmp_path):
    with pytest.raises(DivergedError, match=r"^no solution at mu = 0.3$"):
        over_blocks(
            diverges_at, PLANE, starts(PLANE), {"mu": 0.3},
            block=4, executor=client.get_executor(), checkpoint=tmp_path,
        )  # what, and how  # fmt: skip
    # Three of ten blocks fail, the first of them after four others were handed over.
    assert 4 <= len(list(tmp_path.glob("*.block"))) <= 7


def test_a_worker_that_is_killed_costs_a_retry_and_not_the_sweep(client, tmp_path):
    options = {"mu": 0.1, "folder": str(tmp_path), "after": 1.0}
    result = over_blocks(kills_its_worker, PLANE, starts(PLANE), options, block=4, executor=client.get_executor())
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))
    assert (tmp_path / "killed").exists()


def test_a_worker_killed_from_outside_between_blocks_is_replaced(client, tmp_path):
    killed = []

    def kill(done, total):
        if not killed:
            killed.append(next(iter(client.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)

    options = {"log": str(tmp_path / "log")}
    executor = client.get_executor()
    result = over_blocks(marks, PLANE, starts(PLANE), options, block=1, executor=executor, progress=kill)
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))
    assert len(killed) == 1


def test_a_block_that_goes_on_killing_its_worker_is_named(client):
    fatal = float(PLANE.mu[7, 0])
    options = {"mu": fatal, "after": 1.0}
    with pytest.raises(LostWorkerError, match=r"^workers died .* computed 4 members, the first with .* p = "):
        over_blocks(kills_its_worker, PLANE, starts(PLANE), options, block=4, executor=client.get_executor())


def test_the_program_in_the_chapter_gives_the_same_bits(tmp_path):
    text = (Path(__file__).parents[1] / "chapters" / "scale.md").read_text(encoding="utf-8")
    # The imports and the call: the first two cells.
    shown = re.findall(r"^```\{code-cell\}[^\n]*\n(?::tags:[^\n]*\n)?(.*?)^```", text, re.S | re.M)[:2]
    (program,) = re.findall(
        r"^```python\n(from dask.distributed import Client, LocalCluster\n.*?)^```", text, re.S | re.M
    )
    script = tmp_path / "program.py"
    # The cells stand under the guard, too: workers import the program.
    guarded = "".join(f"    {line}\n" for cell in shown for line in cell.splitlines())
    script.write_text(
        f"import sys\nif __name__ == '__main__':\n{guarded}{program}"
        "    print(np.array_equal(there, here), there.shape, np.unique(there).size)\n",
        encoding="utf-8",
    )
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=120, encoding="utf-8")
    assert done.stdout == "True (1, 10, 100) 1000\n", done.stderr
