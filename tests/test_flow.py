"""Trajectories: what every chapter calls, against exact solutions and SciPy."""

import numpy as np
import pytest
import scipy.integrate

from duffing import Duffing, trajectory
from duffing.flow import stroboscopic_times


def reference(osc, state, t):
    """SciPy's DOP853 at a tight tolerance, on Eq. 5 as it stands."""

    def slope(time, y):
        return y[1], osc.acceleration(y[0], y[1], time)

    solution = scipy.integrate.solve_ivp(slope, (t[0], t[-1]), state, "DOP853", t, rtol=1e-12, atol=1e-13)
    return solution.y


@pytest.mark.parametrize(("method", "tolerance"), [("auto", 1e-8), ("friction", 1e-8), ("rk4", 1e-6)])
@pytest.mark.parametrize("p", [1.0, 2.0, 3.0])
def test_trajectory_equals_scipys_solution_where_damping_is_smooth(method, tolerance, p):
    osc, t = Duffing(p=p, mu=0.3, omega=1.2), np.array([0.0, 0.3, 1.0, 4.0, 9.0])
    ours = trajectory(osc, (0.45, 0.1), t, method=method)
    np.testing.assert_allclose(ours, reference(osc, (0.45, 0.1), t), atol=tolerance)


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_linear_oscillator_follows_its_exact_solution(method):
    osc, t = Duffing(alpha=0.2, p=1.0, delta=4.0, gamma=0.0), np.linspace(0.0, 10.0, 21)
    rate = np.sqrt(4.0 - 0.01)
    exact = np.exp(-0.1 * t) * (np.cos(rate * t) + 0.1 / rate * np.sin(rate * t))
    np.testing.assert_allclose(trajectory(osc, (1.0, 0.0), t, method=method)[0], exact, atol=1e-7)


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_a_family_is_its_members_side_by_side(method):
    family = Duffing(mu=np.array([0.1, 0.2, 0.3]), p=np.array([[0.5], [1.0]]))
    t = np.array([0.0, 1.0, 7.0])
    together = trajectory(family, (0.45, 0.1), t, method=method)
    assert together.shape == (2, 3, 2, 3)
    for i, p in enumerate((0.5, 1.0)):
        for j, mu in enumerate((0.1, 0.2, 0.3)):
            alone = trajectory(Duffing(mu=mu, p=p), (0.45, 0.1), t, method=method)
            np.testing.assert_array_equal(together[:, :, i, j], alone)


def test_each_member_may_have_its_own_start():
    family, t = Duffing(mu=np.array([0.1, 0.1])), np.array([0.0, 3.0])
    starts = np.array([[0.45, -0.45], [0.1, 0.3]])
    states = trajectory(family, starts, t)
    np.testing.assert_array_equal(states[:, 0], starts)
    assert not np.allclose(states[:, 1, 0], states[:, 1, 1])


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_the_equation_is_symmetric_under_reflection_and_half_a_period(method):
    osc, t = Duffing(p=0.5, mu=0.3), np.array([0.0, 2.0, 5.0])
    forward = trajectory(osc, (0.45, 0.1), t, method=method)
    mirrored = trajectory(osc, (-0.45, -0.1), t + np.pi, method=method)
    np.testing.assert_allclose(mirrored, -forward, atol=1e-7)


def test_stroboscopic_times_are_whole_periods_of_each_member():
    t = stroboscopic_times(Duffing(omega=np.array([1.0, 2.0])), periods=2, transient=3, phase=0.5)
    np.testing.assert_allclose(t[:, 1], (0.5 + 2 * np.pi * np.array([3, 4, 5])) / 2.0)
    assert t.shape == (3, 2)


@pytest.mark.parametrize(
    ("state", "t", "message"),
    [
        ((0.1, 0.2, 0.3), [0.0, 1.0], r"^state has shape \(3,\)"),
        ((np.nan, 0.0), [0.0, 1.0], r"^state = .*finite"),
        (("a", "b"), [0.0, 1.0], r"^state = "),
        ((0.1, 0.2), [0.0, 0.0], r"^t = .*increasing"),
        ((0.1, 0.2), [1.0, 0.0], r"^t = .*increasing"),
        ((0.1, 0.2), [0.0, np.inf], r"^t = .*finite"),
        ((0.1, 0.2), [], r"^t has shape \(0,\)"),
        ((0.1, 0.2), [[0.0, 1.0]], r"^t has shape \(1, 2\)"),
    ],
)
def test_bad_states_and_times_are_named(state, t, message):
    with pytest.raises(ValueError, match=message):
        trajectory(Duffing(), state, t)


def test_an_unknown_method_is_named_with_the_known_ones():
    with pytest.raises(ValueError, match=r"^method = 'euler': must be one of 'auto', 'rk4', 'friction'"):
        trajectory(Duffing(), (0.1, 0.2), [0.0, 1.0], method="euler")


def test_an_option_of_another_integrator_is_refused_not_ignored():
    with pytest.raises(ValueError, match=r"option of method 'rk4' = 'rtol': must be one of 'steps_per_period'"):
        trajectory(Duffing(), (0.1, 0.2), [0.0, 1.0], method="rk4", rtol=1e-9)
