"""The benchmarks' harness: a wrong answer is refused, ratios are what a fake clock makes them. No time is tested."""

import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT))

from benchmarks import precision, rewrites, sweep  # noqa: E402 - their folder is put on the path above
from benchmarks.harness import Contestant, Result, agreement, compare  # noqa: E402 - as above
from book.studies import speed as measured  # noqa: E402 - as above


class Clock:
    """A clock that moves only when somebody works."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now

    def worker(self, *seconds, answer=1.0):
        """run() that takes the seconds given in turn, the last for ever after."""
        left = list(seconds)

        def run():
            self.now += left.pop(0) if len(left) > 1 else left[0]
            return np.array([[answer]])

        return run


RIGHT = agreement(np.array([[1.0]]), (1e-9,))


def contestant(name, run, work=1.0, check=RIGHT):
    return Contestant(name, lambda: run, work, check)


def test_a_ratio_is_time_for_the_work_over_the_mean_of_the_bases_two_neighbouring_times():
    clock = Clock()
    # The first, unmeasured run of each is the first of its times.
    base = contestant("base", clock.worker(9.0, 2.0, 4.0, 4.0, 6.0, 8.0, 10.0), work=2.0)
    a = contestant("a", clock.worker(50.0, 12.0, 28.0), work=4.0)
    b = contestant("b", clock.worker(50.0, 8.0, 18.0), work=1.0)
    first, second = compare(base, [a, b], rounds=2, clock=clock)
    # Base over its work: 1 | a 3 | 2 | b 8 | 2; then 3 | a 7 | 4 | b 18 | 5.
    assert first.ratios == (3 / 1.5, 7 / 3.5)
    assert second.ratios == (8 / 2, 18 / 4.5)


def test_a_wrong_answer_is_refused_and_never_timed():
    clock = Clock()
    base, wrong = contestant("base", clock.worker(1.0)), clock.worker(0.001, answer=1.1)
    (result,) = compare(base, [contestant("fast but wrong", wrong)], rounds=3, clock=clock)
    assert result.ratios == ()
    assert result.summary() == "a wrong answer, by 0.1 (allowed: 1e-09)"
    assert result.record() == {"remark": "a wrong answer, by 0.1 (allowed: 1e-09)"}


def test_an_answer_that_becomes_wrong_in_a_later_round_takes_its_times_away():
    clock, answers = Clock(), iter([1.0, 1.0, 2.0])

    def run():
        clock.now += 1.0
        return np.array([[next(answers)]])

    (result,) = compare(contestant("base", clock.worker(1.0)), [contestant("fickle", run)], rounds=3, clock=clock)
    assert result.ratios == () and "wrong answer" in result.remark


def test_an_answer_that_is_not_finite_is_wrong():
    check = agreement(np.ones((3, 2)), (1.0, 1.0, 1.0))
    assert check(np.ones((3, 2))) is None
    assert "wrong" in check(np.full((3, 2), np.nan))
    assert "wrong" in check(np.array([[np.inf, 1.0]]))


def test_each_row_of_an_answer_has_its_own_tolerance_and_the_last_rows_alone_may_be_given():
    expected = np.array([[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]])
    check = agreement(expected, (1e-9, 1e-9, 1e-3))
    assert check(expected[2:] + 1e-4) is None
    assert check(expected[1:] + 1e-4) is not None
    assert check(expected + np.array([[0.0], [0.0], [1e-4]])) is None


def test_what_is_missing_or_breaks_is_named_and_the_others_are_measured():
    clock = Clock()

    def missing():
        raise ModuleNotFoundError("No module named 'peer'", name="peer")

    def broken():
        raise RuntimeError("the tangent is\n singular")

    others = [
        Contestant("missing", missing, 1.0, RIGHT),
        contestant("broken", broken),
        contestant("sound", clock.worker(3.0)),
    ]
    missing, broken, sound = compare(contestant("base", clock.worker(1.5)), others, rounds=2, clock=clock)
    assert (missing.ratios, missing.remark) == ((), "not installed (peer)")
    assert (broken.ratios, broken.remark) == ((), "fails: the tangent is singular")
    assert sound.ratios == (2.0, 2.0)


def test_a_wrong_base_stops_everything():
    with pytest.raises(ArithmeticError, match="base: a wrong answer"):
        compare(contestant("base", Clock().worker(1.0, answer=2.0)), [], rounds=1)


def test_the_record_of_a_result_is_its_median_and_range():
    assert Result("a", (5.0, 1.0, 2.0), "").record() == {"median": 2.0, "least": 1.0, "greatest": 5.0, "remark": ""}


def test_time_to_an_error_is_interpolated_between_a_coarse_and_a_fine_tolerance():
    points = [(1e-4, None, 1), (1e-8, None, 1)]
    assert precision._time_for(1e-6, points, [1.0, 100.0]) == pytest.approx(10.0)
    assert precision._time_for(1e-9, points, [1.0, 100.0]) == np.inf
    assert precision._time_for(1e-6, [], []) == np.inf


@pytest.mark.parametrize("p", [0.1, 1.0])
def test_kernel_and_rewrites_answer_alike_and_close_to_the_flow_at_p_1(p):
    osc = sweep.family(p, 64)
    expected = rewrites.numpy(osc, rewrites.COMPARED)()
    check = agreement(expected, sweep.SAME_SCHEME)
    for prepare in (sweep.kernel, rewrites.scalar):
        assert check(prepare(osc, 4)()) is None
    if p == 1.0:
        assert agreement(sweep.flow(osc), (1e-4, 1e-4, 1e-4))(expected) is None


def test_the_check_of_the_sweep_refuses_a_scheme_with_another_step():
    osc = sweep.family(1.0, 8)
    check = agreement(rewrites.numpy(osc, rewrites.COMPARED)(), sweep.SAME_SCHEME)
    assert check(rewrites.numpy(osc, rewrites.COMPARED, steps=250)()) is not None


def test_the_stored_record_says_when_where_and_with_what_it_was_measured():
    record = measured.record()
    assert record["date"].endswith("UTC") and record["processor"] and record["rounds"] >= 3
    assert {"python", "numpy", "scipy", "numba"} <= record["versions"].keys()
    for p in ("0.1", "1"):
        for entry in record["sweep"][p].values():
            assert entry["remark"] or 0 < entry["least"] <= entry["median"] <= entry["greatest"]


def small_record():
    done = {"median": 7084.4, "least": 0.9876, "greatest": 1e4, "remark": ""}
    gone = {"remark": "not installed (peer)"}
    return {
        "sweep": {"0.1": {"A": done, "B": gone}, "1": {"A": done, "B": done}},
        "precision": {
            "0.1, state": {"reference confirmed to": 1e-12, "1e-06": {"friction time": done, "A": gone}},
            "1, state": {"reference confirmed to": 1e-12, "1e-06": {"friction time": done, "A": done, "C": done}},
        },
        "growth": {"rk4, p": {"0.1": 2.0, "1.0": 1.0}, "friction, p": {"1.0": 1.0}, "rk4, threads": {"1": 1.0}},
    }


def test_the_pages_table_shows_median_and_range_or_what_happened():
    assert measured.sweep_rows(small_record()) == [
        ("A", "7080 (0.99 to 10000)", "7080 (0.99 to 10000)"),
        ("B", "not installed (peer)", "7080 (0.99 to 10000)"),
    ]
    names, medians = measured.medians(small_record())
    assert names == ["A", "B"]
    assert np.isnan(medians[0.1][1]) and medians[1.0][1] == 7084.4


def test_the_pages_table_of_times_to_an_error_leaves_out_the_unit_and_what_was_not_asked():
    methods, rows = measured.error_rows(small_record())
    assert methods == ["A", "C"]
    assert rows == [
        ("$p = 0.1$, state", "$10^{-6}$", "not installed (peer)", ""),
        ("$p = 1$, state", "$10^{-6}$", "7080 (0.99 to 10000)", "7080 (0.99 to 10000)"),
    ]


def test_the_pages_curves_of_growth_are_those_that_have_an_axis():
    series = measured.growth_series(small_record())
    ((label, scale), curves), *others = series.items()
    assert others == [] and scale == "linear" and "p" in label
    np.testing.assert_array_equal(curves["rk4"], [[0.1, 1.0], [2.0, 1.0]])
    assert curves.keys() == {"rk4", "friction"}


def test_the_page_finds_the_c_program_in_the_stored_record():
    names, medians = measured.medians(measured.record())
    assert np.isfinite(medians[0.1][names.index(measured.C_OVER_LANES)])
