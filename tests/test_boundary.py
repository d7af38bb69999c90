"""Crossings of a line with a boundary, on maps whose fractal is known and on the oscillator."""

from dataclasses import replace

import numpy as np
import pytest

from duffing import ConvergenceError, Duffing, critical_amplitude, saddle_orbit
from duffing.basins.boundary import Crossings, boundary_dimension, crossings, line_of_starts, neighbourhood
from duffing.basins.fates import IRREGULAR, LARGE, LEFT, RIGHT, classify

RK4 = {"method": "rk4", "steps_per_period": 96}
AXIS = ((-1.5, 0.0), (1.5, 0.0))


def tent(generations):
    """follow of the tent map of slope 3: what leaves [0, 1] upwards is labelled by when, and stays where it left.

    What never leaves is the middle-third set.
    """

    def follow(s):
        x, label, images = 2 * s - 0.4, np.zeros(s.size, dtype=int), []
        label[(x < 0) | (x > 1)] = -1
        for generation in range(1, generations + 1):
            x = np.where(label == 0, 3 * np.minimum(x, 1 - x), x)
            label[(x > 1) & (label == 0)] = generation
            images.append([x, label])
        return np.moveaxis(images, 0, 1).astype(float), label

    return follow


def test_all_strips_of_the_middle_third_set_are_found_down_to_the_cells():
    found = crossings(tent(13), reach=0.2, least=2.0**-24)
    assert found.left.size == 2 * 2**13  # both ends of what is left after thirteen generations
    dimension = boundary_dimension(crossings(tent(30), reach=0.2, least=1e-9, most=200_000))
    assert abs(dimension.value - 1 - np.log(2) / np.log(3)) < 0.02
    assert dimension.error < 0.06


def test_neighbourhood_is_the_length_of_the_set_fattened_by_eps():
    found = Crossings(np.array([0.2, 0.3, 0.6]), np.array([0.201, 0.301, 0.601]), 0.001, 0)
    np.testing.assert_allclose(neighbourhood(found, [0.001, 0.06]), [3 * 0.002, 0.1 + 4 * 0.06])
    with pytest.raises(ValueError, match=r"^eps = "):
        neighbourhood(found, 1e-4)


def test_without_forcing_the_boundary_is_the_stable_manifold_and_smooth():
    found = crossings(line_of_starts(Duffing(), (-1.5, 0.0), (1.4, 0.0), **RK4))
    assert boundary_dimension(found) == pytest.approx((1.0, 0.0), abs=1e-6)
    assert np.min(np.abs(2.9 * found.left - 1.5)) < 1e-9  # the saddle x = 0


def test_the_line_is_cut_where_the_fates_of_starts_on_it_change():
    osc = Duffing(mu=0.09)
    found = crossings(line_of_starts(osc, *AXIS, **RK4), most=20_000)
    apart = np.flatnonzero(found.left[1:] - found.right[:-1] > 2e-4)
    middles = (found.left[1:] + found.right[:-1])[apart] / 2
    near = np.array([found.right[:-1][apart] + 5e-5, middles, found.left[1:][apart] - 5e-5])
    states = np.array([3 * near - 1.5, np.zeros_like(near)])
    fates = classify(osc, states, 12, **RK4)
    assert len(apart) > 10
    assert np.all(fates == fates[0])


def test_the_neighbourhood_is_what_random_starts_find():
    osc = Duffing(mu=0.12)
    found, eps = crossings(line_of_starts(osc, *AXIS, **RK4), most=30_000), 1e-3
    s = np.random.default_rng(7).uniform(0, 1, 3000)
    fates = [classify(osc, np.array([3 * (s + d) - 1.5, 0 * s]), 12, **RK4) for d in np.linspace(-eps, eps, 9)]
    counted = np.mean(np.any(fates != fates[0], axis=0))
    # Nine starts between -eps and eps see most of the strips, not the thinnest.
    assert 0.7 * neighbourhood(found, eps)[0] < counted < 1.05 * neighbourhood(found, eps)[0]


def test_the_boundary_is_a_few_points_below_the_tangency_and_a_fractal_above():
    mu_c = critical_amplitude(Duffing())
    below, above = (
        crossings(line_of_starts(Duffing(mu=ratio * mu_c), *AXIS, **RK4), most=30_000) for ratio in (0.9, 1.02)
    )
    assert below.left.size < 8 and above.left.size > 100
    assert boundary_dimension(below).value == pytest.approx(1.0, abs=1e-3)
    assert boundary_dimension(above).value > 1.2


def test_a_branch_of_the_unstable_manifold_meets_the_boundary_only_above_the_tangency():
    for ratio, crossed in ((0.99, False), (1.01, True)):
        osc = Duffing()
        osc = replace(osc, mu=ratio * critical_amplitude(osc))
        saddle = saddle_orbit(osc)
        ends = (saddle.state + 1e-7 * stretch * saddle.unstable for stretch in (1.0, saddle.multipliers[0]))
        found = crossings(line_of_starts(osc, *ends, periods=14, **RK4), least=1e-8, most=20_000)
        assert (found.left.size > 0) == crossed


def test_too_few_starts_leave_no_decade_and_it_is_said():
    found = crossings(line_of_starts(Duffing(mu=0.2), *AXIS, **RK4), most=600)
    with pytest.raises(ConvergenceError, match="no decade"):
        boundary_dimension(found)
    with pytest.raises(ValueError, match=r"^most = 5"):
        crossings(tent(3), most=5)


def test_fates_are_those_of_motions_that_are_known():
    starts = np.array([[-1.0, 1.0, 0.0], [0.1, 0.0, 2.0]])
    np.testing.assert_array_equal(
        classify(Duffing(), starts, **RK4), [LEFT, RIGHT, RIGHT]
    )  # the last by its path below
    assert classify(Duffing(alpha=0.4, mu=2.0, delta=1.0, gamma=0.0), (1.0, 0.0), **RK4) == LARGE
    assert classify(Duffing(alpha=0.25, mu=0.4), (1.0, 0.0), **RK4) == IRREGULAR


def test_fates_of_a_family_are_those_of_its_members():
    mu, omega, starts = np.array([0.05, 0.3]), np.array([1.0, 0.9]), np.array([[0.9, -0.8], [0.2, 0.3]])
    together = classify(Duffing(mu=mu, omega=omega), starts, **RK4)
    alone = [classify(Duffing(mu=m, omega=w), start, **RK4) for m, w, start in zip(mu, omega, starts.T, strict=True)]
    np.testing.assert_array_equal(together, alone)
    np.testing.assert_array_equal(classify(Duffing(mu=mu), starts, **RK4)[0], together[0])
