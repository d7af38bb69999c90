"""The work-precision comparison: its reference, and the promise that friction time is cheaper at small p."""

from dataclasses import replace

import numpy as np
import pytest

from book.studies import friction_time as precision
from book.studies.friction_time import WorkPrecision, evaluations_for
from duffing import paper, trajectory

OSC = replace(paper.OSCILLATOR, mu=0.27)
END = 3 * OSC.period


@pytest.mark.parametrize(("p", "tolerance"), [(0.1, 1e-10), (1.0, 1e-10)])
def test_reference_does_not_move_with_its_tolerance_or_its_variable(p, tolerance):
    osc = replace(OSC, p=p)
    states = [
        precision.reference_state(osc, paper.START, END, rtol=rtol, m=m)
        for rtol, m in ((1e-13, 15.0), (1e-12, 15.0), (1e-13, 19.0))
    ]
    assert np.max(np.ptp(states, axis=0)) < tolerance


@pytest.mark.parametrize("p", [0.1, 0.5, 1.0])
def test_adaptive_integrator_reaches_the_independent_reference_after_three_periods(p):
    osc = replace(OSC, p=p)
    reference = precision.reference_state(osc, paper.START, END)
    ours = trajectory(osc, paper.START, np.array([0.0, END]), rtol=1e-12, atol=1e-14)[:, -1]
    assert np.max(np.abs(ours - reference)) < 1e-9


def test_friction_time_needs_fewer_evaluations_than_scipy_for_a_billionth_at_small_p():
    reference = precision.reference_state(OSC, paper.START, END)
    table = precision.work_precision(OSC, paper.START, END, reference)
    need = {name: evaluations_for(curve, 1e-9) for name, curve in table.items()}
    assert need["friction time"] < min(need["SciPy DOP853"], need["SciPy LSODA"], need["SciPy Radau"])
    assert need["Runge-Kutta 4, fixed step"] == np.inf


def test_fixed_step_runge_kutta_has_order_four_at_p_1_and_about_one_at_small_p():
    steps = np.array([1000, 2000, 4000, 8000])
    orders = {}
    for p in (0.1, 1.0):
        osc = replace(OSC, p=p)
        reference = precision.reference_state(osc, paper.START, END)
        ends = [trajectory(osc, paper.START, [0.0, END], method="rk4", steps_per_period=int(n))[:, -1] for n in steps]
        error = np.max(np.abs(np.array(ends) - reference), axis=1)
        orders[p] = -np.polyfit(np.log(steps), np.log(error), 1)[0]
    assert orders[1.0] == pytest.approx(4.0, abs=0.3)
    assert 0.5 < orders[0.1] < 1.6


def test_evaluations_for_an_error_are_interpolated_and_infinite_when_it_is_not_kept():
    curve = WorkPrecision(np.array([100, 1000, 10000]), np.array([1e-2, 1e-4, 1e-6]))
    assert evaluations_for(curve, 1e-3) == pytest.approx(100 * np.sqrt(10))
    assert evaluations_for(curve, 1.0) == 100
    assert evaluations_for(curve, 1e-7) == np.inf
    relapsing = WorkPrecision(np.array([100, 1000, 10000]), np.array([1e-9, 1e-4, 1e-6]))
    assert evaluations_for(relapsing, 1e-5) > 1000


def test_a_reference_at_a_turning_point_is_refused():
    t = np.linspace(0.0, 6.0, 6001)
    v = trajectory(OSC, paper.START, t)[1]
    turning = t[1:][np.diff(np.sign(v)) != 0][0]
    with pytest.raises(ValueError, match=r"^end = "):
        precision.reference_state(OSC, paper.START, turning)
