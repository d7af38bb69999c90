"""The brute-force bifurcation diagram: its points against the linear oscillator, single runs and the symmetry."""

from dataclasses import replace

import numpy as np
import pytest

from duffing import Duffing, poincare_section
from duffing.orbits.diagram import bifurcation_diagram

LINEAR = Duffing(alpha=1.0, p=1.0, delta=3.0, gamma=0.0)  # x'' + x' + 3 x = mu cos t
STARTS = np.array([[0.5, -1.0, 1.2], [0.1, 0.0, -0.4]])
MU = np.array([0.1, 0.2, 0.4])


def test_every_point_of_the_linear_oscillator_is_its_one_response():
    """At phase 0 it is x = mu (delta - 1) / D, v = mu alpha / D with D = (delta - 1)^2 + alpha^2 = 5."""
    found = bifurcation_diagram(LINEAR, MU, STARTS, transient=20, kept=2)
    response = np.array([2 / 5, 1 / 5])[:, None, None] * MU
    for points in (found.forward, found.backward):
        np.testing.assert_allclose(points, np.broadcast_to(response, (2, 2, 3)), atol=1e-9)
    np.testing.assert_allclose(found.scattered, np.broadcast_to(response[..., None], (2, 2, 3, 3)), atol=1e-9)


def test_the_forward_sweep_carries_its_state_from_mu_to_mu():
    osc = Duffing(p=1.0)
    found = bifurcation_diagram(osc, MU, STARTS, transient=3, kept=2, method="rk4")
    state = STARTS[:, 0]
    for k, mu in enumerate(MU):
        points = poincare_section(replace(osc, mu=mu), state, 2, transient=3, method="rk4")
        np.testing.assert_array_equal(found.forward[:, :, k], points)
        state = points[:, -1]


def test_the_backward_sweep_is_the_forward_sweep_of_the_forcings_in_reverse():
    osc = Duffing(p=1.0)
    found = bifurcation_diagram(osc, MU, STARTS, transient=3, kept=2, method="rk4")
    state = STARTS[:, 0]
    for k in (2, 1, 0):
        points = poincare_section(replace(osc, mu=MU[k]), state, 2, transient=3, method="rk4")
        np.testing.assert_array_equal(found.backward[:, :, k], points)
        state = points[:, -1]


def test_up_and_down_see_different_orbits_where_two_attract():
    """At p = 1 the large orbit exists from about mu = 0.24 to beyond 0.3, the small ones from 0 to about 0.25."""
    mu = np.linspace(0.23, 0.29, 25)
    found = bifurcation_diagram(Duffing(p=1.0), mu, [[1.2], [0.05]], transient=150, kept=1, method="rk4")
    inside = np.argmin(np.abs(mu - 0.245))
    assert abs(found.forward[1, 0, inside]) < 0.3
    assert found.backward[1, 0, inside] > 1.2
    np.testing.assert_allclose(found.forward[:, 0, -1], found.backward[:, 0, -1], atol=1e-6)


def test_scattered_points_are_those_of_each_start_alone():
    osc = Duffing(p=np.array([0.5, 2.0]))
    found = bifurcation_diagram(osc, MU, STARTS, transient=2, kept=3, method="rk4")
    assert found.forward.shape == found.backward.shape == (2, 3, 2, 3)
    assert found.scattered.shape == (2, 3, 2, 3, 3)
    alone = poincare_section(Duffing(p=2.0, mu=0.2), STARTS[:, 2], 3, transient=2, method="rk4")
    np.testing.assert_array_equal(found.scattered[:, :, 1, 1, 2], alone)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"mu": [0.2, 0.1]}, "^mu = "),
        ({"starts": [0.1, 0.2]}, r"^starts has shape \(2,\)"),
        ({"starts": np.empty((2, 0))}, r"^starts has shape \(2, 0\)"),
        ({"kept": 0}, "^kept = 0"),
        ({"transient": -1}, "^transient = -1"),
        ({"method": "euler"}, "^method = 'euler'"),
    ],
)
def test_bad_arguments_are_named(change, message):
    arguments = {"mu": MU, "starts": STARTS, "transient": 1, "kept": 1} | change
    with pytest.raises(ValueError, match=message):
        bifurcation_diagram(LINEAR, **arguments)
