"""When a cluster pays: the estimate against a run played through task by task."""

import heapq
from concurrent.futures import ThreadPoolExecutor

import pytest

from duffing import Duffing
from duffing.sweep import families as sweep
from duffing.sweep.cost import Workers, block_seconds, pays_from, seconds, workers


def played(blocks, block, by):
    """Each task is handed over when the one before it was, and done by the first worker that is free."""
    size = -(-blocks // sweep.TASKS)
    free, clock, end = [by.start] * by.count, by.start, 0.0
    while blocks > 0:
        clock += by.task
        done = max(clock, heapq.heappop(free)) + min(size, blocks) * block
        heapq.heappush(free, done)
        blocks, end = blocks - size, max(end, done)
    return end


@pytest.mark.parametrize("blocks", [1, 7, 100, 4096, 30_000])
@pytest.mark.parametrize("by", [Workers(2, 0.0, 1e-4), Workers(10, 5.0, 0.01), Workers(1000, 30.0, 0.002)])
def test_the_estimate_is_that_of_a_run_played_through_up_to_its_last_tasks(blocks, by):
    size = -(-blocks // sweep.TASKS)
    slack = 2 * size * 0.2 + by.count * by.task  # the last task of each worker, and the first round's handing over
    assert abs(seconds(blocks, 0.2, by) - played(blocks, 0.2, by)) <= slack


def test_a_cluster_pays_from_the_size_at_which_both_take_equally_long():
    here, there = Workers(2, 0.0, 0.0), Workers(10, 8.0, 0.0)
    # B 0.2 / 2 = 8 + B 0.2 / 10 at B = 100
    assert pays_from(0.2, here, there) == 101
    assert pays_from(0.2, there, there) is None
    assert pays_from(0.2, here, Workers(2, 8.0, 0.0)) is None


def test_handing_over_bounds_the_speed_of_a_large_cluster_and_larger_tasks_lift_the_bound():
    by = Workers(1000, 0.0, 0.01)
    assert seconds(sweep.TASKS, 0.2, by) == pytest.approx(sweep.TASKS * 0.01)
    many = 1000 * sweep.TASKS
    assert seconds(many, 0.2, by) == pytest.approx(many * 0.2 / 1000)


def test_what_is_measured_is_a_block_and_a_task():
    members, time = block_seconds(Duffing(p=1.0, mu=0.2), periods=20, transient=0, method="rk4", repeats=1)
    assert members % 64 == 0
    assert time > 0
    found = workers(lambda: ThreadPoolExecutor(2), 2, tasks=10)
    assert found.count == 2
    assert found.start > 0
    assert found.task > 0
