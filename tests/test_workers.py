"""Workers that die cost their blocks a retry, not the sweep; a block that goes on killing them is named."""

from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, ThreadPoolExecutor
from time import sleep
from unittest import mock

import numpy as np
import pytest
from sweep_cases import PLANE, context, kills_its_worker, marked, marks, starts

from duffing import Duffing
from duffing.blocks import over_blocks
from duffing.errors import LostWorkerError
from duffing.sweep import workers


def run(executor, mu, **more):
    return over_blocks(kills_its_worker, PLANE, starts(PLANE), {"mu": mu, **more}, block=4, executor=executor)


def pool():
    return ProcessPoolExecutor(2, mp_context=context())


def test_a_worker_that_dies_costs_a_retry_and_the_pool_is_made_again(tmp_path):
    np.testing.assert_array_equal(run(pool, 0.1, folder=tmp_path), marked(PLANE, starts(PLANE)))
    assert (tmp_path / "killed").exists()


def test_a_pool_that_was_given_is_replaced_by_one_like_it_with_a_warning(tmp_path):
    with pool() as given, pytest.warns(RuntimeWarning, match=r"^workers of executor = .* died"):
        result = run(given, PLANE.mu[4, 0], folder=tmp_path)
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))


def test_a_block_that_goes_on_killing_its_worker_is_named_and_the_others_are_kept(tmp_path):
    fatal = float(PLANE.mu[7, 0])
    log = tmp_path / "log"
    with pytest.raises(LostWorkerError, match=r"^workers died 3 times .* computed 1 members.* p = 2, mu = 0.255556"):
        over_blocks(
            kills_at_two, PLANE, starts(PLANE), {"mu": fatal},
            block=1, executor=pool, checkpoint=tmp_path / "kept",
        )  # what, and how  # fmt: skip
    # The block is one of 40: all others, or all but a few that were not yet begun, are there.
    assert len(list((tmp_path / "kept").glob("*.block"))) >= 30
    assert not log.exists()


def kills_at_two(osc, state, threads, mu):
    return kills_its_worker(osc, state, threads, mu) if osc.p[0] == 2 else marks(osc, state, threads)


class Mortal(Executor):
    """A pool of one thread that dies of a task that raises SystemExit, and everything that waits dies with it."""

    def __init__(self):
        self.pool, self.dead = ThreadPoolExecutor(1), False

    def submit(self, function, /, *arguments):
        if self.dead:
            raise BrokenExecutor("dead")
        return self.pool.submit(self.run, function, *arguments)

    def run(self, function, *arguments):
        if self.dead:
            raise BrokenExecutor("dead")
        try:
            return function(*arguments)
        except SystemExit:
            self.dead = True
            raise BrokenExecutor("dead") from None

    def shutdown(self, wait=True, *, cancel_futures=False):
        self.pool.shutdown(wait, cancel_futures=cancel_futures)


def test_the_block_to_blame_is_found_among_hundreds_that_were_under_way():
    made, done = [], set()

    def make():
        made.append(Mortal())
        return made[-1]

    def fatal(osc, state, threads):
        if osc.mu[0] == 123:
            raise SystemExit
        done.add(osc.mu[0])
        return state

    osc = Duffing(mu=np.arange(600.0))
    with pytest.raises(LostWorkerError, match=r"^workers died 3 times .* computed 1 members, .* mu = 123,"):
        over_blocks(fatal, osc, starts(osc), {}, block=1, executor=make)
    # It died with all that were handed over, with a group of suspects, and three times alone.
    assert 4 <= len(made) <= 6
    assert set(range(123)) <= done


def test_after_the_suspects_the_others_are_many_under_way_again(tmp_path):
    most, made = [], []

    class Counting(Mortal):
        def submit(self, function, /, *arguments):
            future = super().submit(function, *arguments)
            most[-1] = max(most[-1], self.pool._work_queue.qsize())
            return future

    def make():
        most.append(0)
        made.append(Counting())
        return made[-1]

    def fatal_once(osc, state, threads):
        sleep(1e-3)
        if osc.mu[0] == 5 and len(made) == 1:
            raise SystemExit
        return state

    osc = Duffing(mu=np.arange(400.0))
    with mock.patch.object(workers, "IN_FLIGHT", 64):
        result = over_blocks(fatal_once, osc, starts(osc), {}, block=1, executor=make)
    np.testing.assert_array_equal(result, starts(osc))
    assert len(made) == 2
    assert most[1] > 32


def test_an_executor_that_cannot_be_made_again_says_what_to_give_instead():
    executor = Mortal()
    executor.dead = True
    with pytest.raises(LostWorkerError, match="give a function that makes one"):
        over_blocks(marks, PLANE, starts(PLANE), {}, block=1, executor=executor)
