"""Pseudo-arclength continuation, on curves that are known in closed form."""

import numpy as np
import pytest

from duffing import ConvergenceError
from duffing.orbits.continuation import BOUND, CLOSED, LOST, STEPS, correct, follow_branches


def circles(radius):
    """g = u^2 + parameter^2 - radius^2, one radius a branch."""

    def function(u, parameter, member):
        g = u**2 + parameter**2 - radius[member] ** 2
        return g, 2 * u[None], 2 * parameter[None]

    return function


def parabola(u, parameter, member):
    """Two unknowns: u0^2 = -parameter, u1 = 3 u0; a fold at the origin."""
    g = np.array([u[0] ** 2 + parameter, u[1] - 3 * u[0]])
    by_u = np.array([[2 * u[0], 0 * u[0]], [-3 + 0 * u[0], 1 + 0 * u[0]]])
    return g, by_u, np.array([1 + 0 * parameter, 0 * parameter])


def cubic(u, parameter, member):
    """parameter = u - u^3, with folds at u = 1/sqrt(3) and -1/sqrt(3)."""
    return u - u**3 - parameter, (1 - 3 * u**2)[None], -np.ones_like(u)


def test_circles_are_followed_all_round_until_they_close_each_on_its_own():
    radius = np.array([0.3, 1.0])
    branches = follow_branches(circles(radius), radius[None] + 0.01, [0.0, 0.0], bounds=(-2, 2), largest=0.1)
    for branch, r in zip(branches, radius, strict=True):
        assert branch.end == CLOSED
        np.testing.assert_allclose(np.hypot(branch.u[0], branch.parameter), r, atol=1e-9)
        angle = np.unwrap(np.arctan2(branch.parameter, branch.u[0]))
        assert 2 * np.pi <= angle[-1] - angle[0] < 2 * np.pi + 0.1 / r
        assert np.all(np.diff(angle) > 0)


def test_tangents_are_unit_vectors_along_the_curve_in_the_direction_followed():
    (branch,) = follow_branches(circles(np.array([1.0])), [[1.0]], [0.0], bounds=(-2, 2), direction=-1)
    np.testing.assert_allclose(branch.tangent, [branch.parameter, -branch.u[0]], atol=1e-9)


def test_a_branch_passes_its_fold_and_ends_exactly_at_the_bound():
    start, bounds = np.array([[0.5], [1.5]]), (-0.25, 1.0)
    (branch,) = follow_branches(parabola, start * 0.9, [-0.2], bounds=bounds)
    assert branch.end == BOUND
    assert branch.parameter[-1] == -0.25
    np.testing.assert_allclose(branch.u[:, -1], [-0.5, -1.5], atol=1e-9)
    # The greatest parameter met lies a little below the fold's zero: by the square of half a step in u0 at most.
    assert -(0.05**2) / 10 / 4 * 1.01 < branch.parameter.max() <= 1e-12


def test_bounds_are_met_to_the_last_bit():
    high = np.linspace(0.1, 1.0, 37) / 3
    found = follow_branches(cubic, np.zeros((1, 37)), np.zeros(37), bounds=(-1, high), step=0.011)
    assert [branch.end for branch in found] == [BOUND] * 37
    np.testing.assert_array_equal([branch.parameter[-1] for branch in found], high)


def test_both_folds_of_a_cubic_are_passed():
    (branch,) = follow_branches(cubic, [[-1.2]], [0.5], bounds=(-0.6, 0.6), direction=-1)
    turns = branch.parameter[1:-1][np.diff(np.sign(np.diff(branch.parameter))) != 0]
    exact = 2 / 3**1.5
    np.testing.assert_allclose(turns, [-exact, exact], atol=3e-3)
    assert branch.end == BOUND
    assert branch.parameter[-1] == -0.6


def test_steps_keep_their_bounds():
    (branch,) = follow_branches(cubic, [[-1.2]], [0.5], bounds=(-0.6, 0.6), direction=-1, step=0.004, largest=0.02)
    length = np.hypot(np.diff(branch.u[0]), np.diff(branch.parameter))
    assert 0.0039 < length[0] < 0.0041
    assert np.all(length < 0.0201)
    assert np.median(length) > 0.019


def test_direction_may_be_a_tangent_and_the_start_is_then_corrected_normal_to_it():
    """At the fold of the parabola the parameter has no direction; u0 has."""
    direction = np.array([[-1.0], [-3.0], [0.0]])
    (branch,) = follow_branches(parabola, [[-0.03], [-0.09]], [0.0], bounds=(-1, 1), direction=direction)
    normal = direction[:, 0] / np.linalg.norm(direction)
    moved = np.array([branch.u[0, 0] + 0.03, branch.u[1, 0] + 0.09, branch.parameter[0]])
    assert abs(moved @ normal) < 1e-12
    assert np.all(np.diff(branch.u[0]) < 0)
    assert branch.end == BOUND


def test_steps_are_short_where_the_curve_bends():
    """However long the steps may be: on a circle of radius 0.1 no two neighbouring tangents are 15 degrees apart."""
    (branch,) = follow_branches(circles(np.array([0.1])), [[0.1]], [0.0], bounds=(-1, 1), step=0.09, largest=1.0)
    cosines = (branch.tangent[:, 1:] * branch.tangent[:, :-1]).sum(axis=0)
    assert cosines.min() > np.cos(np.radians(15))
    assert branch.end == CLOSED


def test_number_of_points_is_bounded():
    (branch,) = follow_branches(circles(np.array([1.0])), [[1.0]], [0.0], bounds=(-2, 2), points=7)
    assert branch.end == STEPS
    assert branch.parameter.shape == (7,)
    assert branch.u.shape == (1, 7)
    assert branch.tangent.shape == (2, 7)


def test_a_branch_that_ends_in_nothing_is_lost_there():
    def half_line(u, parameter, member):
        """u = sqrt(-parameter) alone: beyond zero there is no solution, nor a fold."""
        root = np.sqrt(np.maximum(-parameter, 0))
        g = np.where(parameter <= 0, u - root, 1.0)
        return g, np.ones_like(u)[None], 0.5 / np.maximum(root, 1e-9)[None]

    (branch,) = follow_branches(half_line, [[0.5]], [-0.25], bounds=(-1, 1), smallest=1e-6)
    assert branch.end == LOST
    assert -1e-2 < branch.parameter[-1] < 1e-9  # the tolerance


def test_correction_stays_in_the_plane_normal_to_the_vector():
    z, normal = np.array([[0.9], [0.3]]), np.array([[0.6], [0.8]])
    found, jacobian, iterations, good = correct(circles(np.array([1.0])), z, normal, np.array([0]), 1e-10)
    assert good.all()
    assert abs(((found - z) * normal).sum()) < 1e-12
    assert np.hypot(*found[:, 0]) == pytest.approx(1.0, abs=1e-12)
    np.testing.assert_allclose(jacobian[0, 0], 2 * found[:, 0], atol=1e-4)
    assert 2 <= iterations[0] <= 6


def test_a_start_without_a_solution_is_a_named_error():
    with pytest.raises(ConvergenceError, match=r"parameter = 1\.5.*guess u = \[0\.2\]"):
        follow_branches(circles(np.array([2.0, 1.0])), [[1.3, 0.2]], [1.5, 1.5], bounds=(-2, 2))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bounds": (0.5, 1)}, "bounds = .*must be two different numbers"),
        ({"bounds": (1, -1)}, "bounds = "),
        ({"direction": 0.5}, "direction = 0.5: must be 1 or -1"),
        ({"direction": np.ones((3, 1))}, "direction = "),
        ({"step": 0.2}, "step = 0.2: must be between"),
        ({"step": -1.0}, "step = -1.0: must be a finite number > 0"),
        ({"points": 1}, "points = 1: must be a whole number >= 2"),
        ({"u": [[np.nan]]}, "u has shape"),
        ({"u": [1.0]}, r"u has shape \(1,\)"),
    ],
)
def test_bad_input_is_named(change, message):
    arguments = {"u": [[1.0]], "parameter": [0.0], "bounds": (-1, 1)} | change
    with pytest.raises(ValueError, match=message):
        follow_branches(circles(np.array([1.0])), arguments.pop("u"), arguments.pop("parameter"), **arguments)
