"""The stroboscopic map."""

import numpy as np
import pytest

from duffing import Duffing, poincare_section, trajectory


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_first_point_is_the_image_of_the_start_after_one_period(method):
    osc = Duffing(mu=0.3, omega=1.3)
    points = poincare_section(osc, (0.45, 0.1), 3, method=method)
    path = trajectory(osc, (0.45, 0.1), osc.period * np.arange(4), method=method)
    np.testing.assert_allclose(points, path[:, 1:], atol=1e-12)


def test_transient_points_are_left_out():
    osc = Duffing(mu=0.3)
    whole = poincare_section(osc, (0.45, 0.1), 7)
    np.testing.assert_allclose(poincare_section(osc, (0.45, 0.1), 3, transient=4), whole[:, 4:], atol=1e-8)


@pytest.mark.parametrize("phase", [0.3, 1.0])
@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_the_phase_is_that_of_the_force(method, phase):
    osc = Duffing(mu=0.3, omega=np.array([0.8, 1.3]))
    points = poincare_section(osc, (0.45, 0.1), 2, phase=phase, method=method)
    for member, omega in enumerate((0.8, 1.3)):
        t = np.array([0.0, phase + 2 * np.pi, phase + 4 * np.pi]) / omega
        path = trajectory(Duffing(mu=0.3, omega=omega), (0.45, 0.1), t, method=method)
        np.testing.assert_allclose(points[:, :, member], path[:, 1:], atol=1e-7)


def test_a_periodic_orbit_of_the_linear_oscillator_is_one_point():
    """Forced linear oscillator: x = mu ((delta - 1) cos t + alpha sin t) / ((delta - 1)^2 + alpha^2) in the end."""
    osc = Duffing(alpha=1.0, p=1.0, mu=0.5, delta=3.0, gamma=0.0)
    points = poincare_section(osc, (0.0, 0.0), 3, transient=20)
    np.testing.assert_allclose(points, np.tile([[0.5 * 2 / 5], [0.5 * 1 / 5]], 3), atol=1e-9)


def test_shapes_follow_the_family():
    osc = Duffing(mu=np.zeros((2, 3)), alpha=0.2)
    assert poincare_section(osc, (0.5, 0.0), 4).shape == (2, 4, 2, 3)
    assert poincare_section(Duffing(), (0.5, 0.0), 4).shape == (2, 4)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"periods": 0}, "^periods = 0"),
        ({"periods": 2.5}, "^periods = 2.5"),
        ({"periods": True}, "^periods = True"),
        ({"periods": 2, "transient": -1}, "^transient = -1"),
        ({"periods": 2, "phase": 7.0}, "^phase = 7.0"),
        ({"periods": 2, "phase": np.nan}, "^phase = nan"),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        poincare_section(Duffing(), (0.1, 0.2), **arguments)
