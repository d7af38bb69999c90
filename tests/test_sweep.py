"""Families in blocks: the same numbers however they are cut and wherever they run."""

import signal
import threading
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial

import numpy as np
import pytest
from sweep_cases import PLANE, context, diverges_at, marked, marks, starts

from duffing import DivergedError, Duffing, blocks, lyapunov, lyapunov_spectrum
from duffing.blocks import block_of, over_blocks
from duffing.lyapunov import averages
from duffing.sweep import families as sweep

FAMILY = Duffing(p=np.array([[0.5], [1.0]]), mu=np.linspace(0.1, 0.3, 21))


class Late(Executor):
    """Runs nothing until `count` tasks are there, then the last first."""

    def __init__(self, count):
        self.count, self.tasks, self.handed_over = count, [], 0

    def submit(self, function, /, *arguments):
        self.tasks.append((Future(), function, arguments))
        future, self.handed_over = self.tasks[-1][0], self.handed_over + 1
        if len(self.tasks) == self.count:
            for future_, function_, arguments_ in reversed(self.tasks):
                future_.set_result(function_(*arguments_))
            self.tasks.clear()
        return future


@pytest.fixture(scope="module")
def processes():
    with ProcessPoolExecutor(2, mp_context=context()) as pool:
        yield pool


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_exponents_are_bit_for_bit_the_same_in_threads_and_in_processes(method, processes, monkeypatch):
    options = {"periods": 9, "transient": 2, "method": method}
    here = lyapunov_spectrum(FAMILY, **options)
    monkeypatch.setattr(blocks, "BLOCK_SECONDS", 0.01)  # blocks of a few members
    with ThreadPoolExecutor(2) as threads:
        for executor in (None, threads, processes, partial(ThreadPoolExecutor, 3)):
            for ours, same in zip(lyapunov_spectrum(FAMILY, executor=executor, **options), here, strict=True):
                np.testing.assert_array_equal(ours, same)


@pytest.mark.parametrize("method", ["auto", "rk4"])
@pytest.mark.parametrize("block", [1, 5, 42, 1000])
def test_exponents_are_bit_for_bit_the_same_for_any_size_of_blocks(method, block, monkeypatch):
    options, calls = {"periods": 9, "transient": 2, "method": method}, []
    whole = lyapunov_spectrum(FAMILY, **options)
    monkeypatch.setattr(lyapunov, "block_for", lambda *arguments, **options: block)
    cut = lyapunov_spectrum(FAMILY, progress=lambda *call: calls.append(call), **options)
    assert len(calls) == -(-42 // block)
    for ours, same in zip(cut, whole, strict=True):
        np.testing.assert_array_equal(ours, same)


def test_the_averages_of_one_member_are_bit_for_bit_those_of_a_family():
    """NumPy's own mean sums in another order when there is one member: seen from some hundred periods on."""
    growth = np.random.default_rng(1).standard_normal((2, 400, 9))
    family = averages(growth, 1.0)
    for i in range(9):
        for alone, all_ in zip(averages(np.ascontiguousarray(growth[..., i : i + 1]), 1.0), family, strict=True):
            np.testing.assert_array_equal(alone, all_[..., i : i + 1])


def test_without_the_history_the_exponents_and_errors_are_the_same():
    full = lyapunov_spectrum(FAMILY, periods=9, transient=2, method="rk4")
    short = lyapunov_spectrum(FAMILY, periods=9, transient=2, method="rk4", history=False)
    assert short.history is None
    np.testing.assert_array_equal(short.exponents, full.exponents)
    np.testing.assert_array_equal(short.error, full.error)


@pytest.mark.parametrize("block", [1, 3, 40, 100])
def test_every_member_comes_back_to_its_place_whatever_the_order_of_arrival(block):
    executor = Late(count=-(-40 // block))
    result = over_blocks(marks, PLANE, starts(PLANE), {}, block=block, executor=executor)
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))


def test_members_of_a_block_have_one_exponent_where_that_is_possible():
    exponents = []

    def note(osc, state, threads):
        exponents.append(set(osc.p))
        return state

    over_blocks(note, PLANE, starts(PLANE), {}, block=10, progress=lambda *call: None)
    assert sorted(map(sorted, exponents)) == [[0.5], [0.5], [1.0], [2.0]]


def test_a_small_family_is_left_whole_to_the_integrator_and_its_threads():
    calls = []

    def note(osc, state, threads):
        calls.append((state.shape[1], threads))
        return state

    over_blocks(note, PLANE, starts(PLANE), {"threads": 3}, block=10)
    assert calls == [(40, 3)]
    calls.clear()
    over_blocks(note, PLANE, starts(PLANE), {"threads": 3}, block=6)
    assert sorted(calls) == [(4, 1), *[(6, 1)] * 6]


def test_a_family_of_more_blocks_than_a_wave_comes_back_whole(monkeypatch):
    monkeypatch.setattr(blocks, "WAVE", 3)
    result = over_blocks(marks, PLANE, starts(PLANE), {"threads": 2}, block=2)
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))


@pytest.mark.parametrize(("given", "inside"), [({}, 1), ({"threads": 2}, 2)])
def test_a_block_of_an_executor_takes_one_thread_unless_more_are_asked_for(given, inside):
    seen = set()

    def note(osc, state, threads):
        seen.add(threads)
        return state

    with ThreadPoolExecutor(1) as executor:
        over_blocks(note, PLANE, starts(PLANE), given, executor=executor)
    assert seen == {inside}


def test_only_a_bounded_number_of_tasks_is_under_way(monkeypatch):
    monkeypatch.setattr("duffing.sweep.workers.IN_FLIGHT", 5)
    under_way, most = [], []

    class Watched(ThreadPoolExecutor):
        def submit(self, function, /, *arguments):
            under_way.append(super().submit(function, *arguments))
            most.append(sum(not future.done() for future in under_way))
            return under_way[-1]

    def slow(osc, state, threads):
        time.sleep(2e-3)
        return marks(osc, state, threads)

    with Watched(1) as executor:
        result = over_blocks(slow, PLANE, starts(PLANE), {}, block=2, executor=executor)
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))
    assert len(under_way) == 20
    assert max(most) == 5


def test_a_family_of_very_many_blocks_makes_a_bounded_number_of_tasks_and_files(monkeypatch, tmp_path):
    monkeypatch.setattr(sweep, "TASKS", 3)
    executor, log = Late(count=3), tmp_path / "log"
    options = {"log": str(log)}
    result = over_blocks(marks, PLANE, starts(PLANE), options, block=3, executor=executor, checkpoint=tmp_path / "kept")
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))
    assert executor.handed_over == len(list((tmp_path / "kept").iterdir())) == 3
    # 15 + 15 + 10 members in blocks of at most three.
    assert sorted(line.split()[-1] for line in log.read_text(encoding="utf-8").splitlines()) == ["1", *["3"] * 13]


def test_threads_stop_between_two_blocks_of_a_task(monkeypatch):
    monkeypatch.setattr(sweep, "TASKS", 1)
    calls = []

    def interrupted_later(osc, state, threads):
        calls.append(state.shape)
        if len(calls) == 2:
            signal.raise_signal(signal.SIGINT)  # arrives in the main thread
            stopped.wait(60)
        return state

    stopped = threading.Event()
    with ThreadPoolExecutor(1) as executor:
        with pytest.raises(KeyboardInterrupt):
            over_blocks(interrupted_later, PLANE, starts(PLANE), {}, block=1, executor=executor)
        stopped.set()
    assert len(calls) == 2


@pytest.mark.parametrize("where", ["threads", "processes"])
def test_an_error_inside_a_block_arrives_with_its_type_and_message(where, processes):
    executor = processes if where == "processes" else None
    with pytest.raises(DivergedError, match=r"^no solution at mu = 0.1$"):
        over_blocks(diverges_at, PLANE, starts(PLANE), {"mu": 0.1}, block=4, executor=executor)
    with pytest.raises(DivergedError, match=r"alpha = 0.1, p = 1, mu = 0, omega = 1, delta = 1, gamma = -1"):
        family = Duffing(delta=1.0, gamma=np.array([1.0, -1.0]))
        lyapunov_spectrum(family, (3.0, 0.0), periods=5, transient=0, executor=executor)


def test_an_executor_that_a_function_makes_is_shut_down_and_one_that_was_given_is_not():
    made = []

    def make():
        made.append(ThreadPoolExecutor(2))
        return made[-1]

    with ThreadPoolExecutor(1) as given:
        for executor in (make, given):
            over_blocks(marks, PLANE, starts(PLANE), {}, executor=executor)
        given.submit(int).result()
    with pytest.raises(RuntimeError, match="after shutdown"):
        made[0].submit(int)


def test_progress_counts_members_up_to_the_whole_family():
    calls = []
    osc = Duffing(mu=np.linspace(0.1, 0.3, 300))
    over_blocks(marks, osc, starts(osc), {}, block=128, progress=lambda *call: calls.append(call))
    assert {total for _, total in calls} == {300}
    sizes = np.diff([0, *(done for done, _ in calls)])
    assert sorted(sizes) == [44, 128, 128]


def test_blocks_are_short_whole_groups_of_members_and_never_empty():
    assert block_of(blocks.BLOCK_SECONDS / 20.5) == 20
    assert block_of(blocks.BLOCK_SECONDS / 20.5, groups=(8, 64)) == 16
    assert block_of(blocks.BLOCK_SECONDS / 150.5, groups=(8, 64)) == 128
    assert block_of(1e9) == 1
    assert block_of(1e9, groups=(8, 64)) == 8
    assert block_of(1e-12) == 4096


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"executor": 3}, "^executor = 3"),
        ({"executor": "dask"}, "^executor = 'dask'"),
        ({"threads": 0}, "^threads = 0"),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        lyapunov_spectrum(FAMILY, **arguments)
