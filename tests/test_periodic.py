"""Periodic orbits: a linear oscillator in closed form, the symmetry, dissipation, SciPy, brute force."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from duffing import ConvergenceError, Duffing, poincare_section, trajectory
from duffing.orbits.periodic import cycle, half_period_map, multipliers_of, path, periodic_orbit, periodic_orbits

LINEAR = Duffing(alpha=0.3, p=1.0, mu=0.4, omega=1.3, delta=2.0, gamma=0.0)
IN_WELL = Duffing(alpha=0.1, p=1.0, mu=0.15)
GRID = np.reshape(np.meshgrid(np.linspace(-1.4, 1.4, 8), np.linspace(-1.0, 1.0, 6)), (2, -1))


def linear_response(osc):
    response = osc.mu / (osc.delta - osc.omega**2 + 1j * osc.omega * osc.alpha)
    return np.array([response.real, (1j * osc.omega * response).real])


@pytest.mark.parametrize("halves", [1, 2, 3, 4])
def test_linear_oscillator_has_its_response_and_its_exponents_in_closed_form(halves):
    orbit = periodic_orbit(LINEAR, (1.0, 0.2), halves)
    np.testing.assert_allclose(orbit.state, linear_response(LINEAR), atol=1e-10)
    eigenvalues = -0.15 + np.array([1, -1]) * np.sqrt(0.15**2 - 2.0 + 0j)
    exact = (-1) ** halves * np.exp(eigenvalues * halves * LINEAR.period / 2)
    np.testing.assert_allclose(np.sort(orbit.multipliers.imag), np.sort(exact.imag), atol=1e-9)
    np.testing.assert_allclose(orbit.multipliers.real, exact.real, atol=1e-9)


def test_an_orbit_far_from_the_origin_is_found_from_a_guess_near_it():
    """A found failure: beyond 5 none was looked for, whatever the guess."""
    resonant = replace(LINEAR, mu=30.0, omega=1.4)
    exact = linear_response(resonant)
    assert np.abs(exact).max() > 50
    np.testing.assert_allclose(periodic_orbit(resonant, exact + 0.1).state, exact, rtol=1e-9)


@pytest.mark.parametrize(("halves", "guess"), [(2, (1.2, 0.0)), (1, (-0.1, 0.0)), (4, (-0.15, -0.15))])
def test_linear_damping_makes_the_product_of_multipliers_exp_minus_alpha_n_T(halves, guess):
    """Also where the determinant of the tangent map itself has lost its digits."""
    osc = replace(IN_WELL, mu=0.22)
    orbit = periodic_orbit(osc, guess, halves)
    assert np.prod(orbit.multipliers) == pytest.approx(np.exp(-osc.alpha * halves * osc.period / 2), rel=1e-9)


def test_multipliers_are_those_of_scipys_map():
    """The derivative of the stroboscopic map by central differences of SciPy's solutions."""
    osc = Duffing(alpha=0.1, p=0.5, mu=0.2)
    orbit = periodic_orbit(osc, (0.2, 0.16), 2)  # the flip saddle in the right well

    def carried(state):
        def field(t, y):
            return [y[1], osc.acceleration(y[0], y[1], t)]

        return solve_ivp(field, (0, osc.period), state, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]

    np.testing.assert_allclose(carried(orbit.state), orbit.state, atol=1e-8)
    h = 1e-5
    columns = [(carried(orbit.state + h * e) - carried(orbit.state - h * e)) / (2 * h) for e in np.eye(2)]
    exact = np.linalg.eigvals(np.transpose(columns))
    np.testing.assert_allclose(np.sort(orbit.multipliers.real), np.sort(exact.real), rtol=1e-4)
    assert orbit.multipliers[0].real < -1


def test_half_map_squared_is_the_stroboscopic_map():
    osc, state = Duffing(p=0.3, mu=0.2), np.array([0.4, 0.7])
    first = half_period_map(osc, state, 1)
    second = half_period_map(osc, first.image[:, 0], 1)
    whole = half_period_map(osc, state, 2)
    np.testing.assert_allclose(second.image, whole.image, atol=1e-9)
    product = second.derivative[:, :, 0] @ first.derivative[:, :, 0]
    np.testing.assert_allclose(product, whole.derivative[:, :, 0], atol=1e-7)
    assert first.log_area[0] + second.log_area[0] == pytest.approx(whole.log_area[0], rel=1e-7)
    np.testing.assert_allclose(whole.image[:, 0], poincare_section(osc, state, 1)[:, 0], atol=1e-9)


def test_each_member_may_have_its_own_number_of_halves():
    osc, state = Duffing(mu=0.2, p=[0.5, 0.5, 0.5]), (0.4, 0.7)
    mixed = half_period_map(osc, state, [1, 2, 5])
    for j, halves in enumerate((1, 2, 5)):
        alone = half_period_map(Duffing(mu=0.2, p=0.5), state, halves)
        np.testing.assert_allclose(mixed.image[:, j], alone.image[:, 0], rtol=1e-12)
        np.testing.assert_allclose(mixed.derivative[:, :, j], alone.derivative[:, :, 0], rtol=1e-9)


def test_an_orbit_of_a_well_and_its_mirror_image_have_the_same_multipliers():
    osc = Duffing(p=0.5, mu=0.2)
    right = periodic_orbit(osc, (1.2, 0.1), 2)
    image = cycle(osc, right.state, 2)[:, 1]
    left = periodic_orbit(osc, image, 2)
    np.testing.assert_allclose(left.state, image, atol=1e-8)
    assert right.state[0] > 0 > left.state[0]
    np.testing.assert_allclose(left.multipliers, right.multipliers, atol=1e-8)


def test_a_symmetric_orbits_multipliers_over_the_period_are_the_squares_of_those_over_half_of_it():
    osc = Duffing(p=0.5, mu=0.2)
    half = periodic_orbit(osc, (0.9, 1.4), 1)
    whole = periodic_orbit(osc, half.state, 2)
    np.testing.assert_allclose(whole.state, half.state, atol=1e-9)
    np.testing.assert_allclose(np.sort_complex(whole.multipliers), np.sort_complex(half.multipliers**2), atol=1e-8)
    x = path(osc, half.state, 2, 100)
    np.testing.assert_allclose(x[:, 50:], -x[:, :51], atol=1e-8)


def test_an_orbit_that_attracts_is_where_brute_force_ends():
    osc = Duffing(alpha=0.1, p=[0.1, 0.5, 1.0], mu=0.2)
    late = poincare_section(osc, (1.15, 0.1), 1, transient=250)[:, 0]
    orbit = periodic_orbit(osc, np.array([[1.15, 1.2, 1.2], [0.15, 0.1, 0.05]]), 2)
    np.testing.assert_allclose(orbit.state, late, atol=1e-8)
    assert np.all(np.abs(orbit.multipliers) < 1)


def test_a_sticking_orbit_has_a_multiplier_of_exactly_zero():
    osc = Duffing(alpha=0.1, p=[0.1, 0.3], mu=[0.05, 0.02])
    orbit = periodic_orbit(osc, (1.0, 0.0), 2)
    np.testing.assert_array_equal(orbit.multipliers[1], 0.0)
    assert np.all((orbit.multipliers[0].real > 0) & (orbit.multipliers[0].real < 1))


def test_without_damping_multipliers_lie_on_the_unit_circle_or_are_reciprocal():
    osc = Duffing(alpha=0.0, p=1.0, mu=0.05)
    for guess, halves in (((1.05, 0.0), 2), ((-0.02, 0.0), 1)):
        assert np.prod(periodic_orbit(osc, guess, halves).multipliers) == pytest.approx(1.0, abs=1e-9)


def test_search_finds_each_orbit_once_and_none_of_a_shorter_period():
    osc = replace(IN_WELL, mu=0.22)
    symmetric = periodic_orbits(osc, GRID, 1)
    found = periodic_orbits(osc, GRID, 2)
    triple = periodic_orbits(osc, GRID, 3)
    assert symmetric.state.shape == (2, 3)  # the saddle orbit and two round both wells
    assert found.state.shape[1] % 2 == 0  # in-well orbits come in mirror pairs
    for orbits, halves in ((symmetric, 1), (found, 2), (triple, 3)):
        family = replace(osc, mu=np.full(orbits.state.shape[1], osc.mu))
        np.testing.assert_allclose(half_period_map(family, orbits.state, halves).image, orbits.state, atol=1e-8)
        assert np.all(np.diff(orbits.state[0]) > 0)
    family = replace(osc, mu=np.full(triple.state.shape[1], osc.mu))
    assert np.all(np.abs(half_period_map(family, triple.state, 1).image - triple.state).max(axis=0) > 1e-3)
    points = cycle(family, triple.state, 3)
    np.testing.assert_allclose(points[0].max(axis=0), triple.state[0])  # the cycle's point with the greatest x


def test_search_may_find_nothing():
    nothing = periodic_orbits(LINEAR, GRID, 3)  # its one orbit has halves = 1
    assert nothing.state.shape == nothing.multipliers.shape == (2, 0)


def test_path_runs_through_the_trajectory():
    osc = Duffing(p=0.5, mu=0.2)
    samples = path(osc, (0.3, 0.1), 3, 30)
    direct = trajectory(osc, (0.3, 0.1), np.linspace(0, 1.5 * osc.period, 31))
    np.testing.assert_allclose(samples, direct, atol=1e-9)


def test_multipliers_of_a_given_map_are_its_eigenvalues():
    found = half_period_map(LINEAR, (0.1, 0.2), 1)
    expected = np.linalg.eigvals(found.derivative[:, :, 0])  # a pair, told apart by its imaginary parts
    one, other = (sorted(values, key=np.imag) for values in (multipliers_of(found)[:, 0], expected))
    np.testing.assert_allclose(one, other, atol=1e-9)


def test_a_guess_that_leads_nowhere_is_a_named_error():
    with pytest.raises(ConvergenceError, match=r"mu = 0.3, .*halves = 2 from \[4"):
        periodic_orbit(Duffing(p=1.0, mu=[0.2, 0.3]), np.array([[1.2, 4.9], [0.0, 4.9]]), 2)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: half_period_map(IN_WELL, (0.0, 0.0), 0), "halves = 0: must be a whole number >= 1"),
        (lambda: half_period_map(IN_WELL, (0.0, 0.0, 0.0)), "state has shape"),
        (lambda: periodic_orbits(Duffing(mu=[0.1, 0.2]), GRID), "must be a single oscillator"),
        (lambda: path(IN_WELL, (0.0, 0.0), 2, 0), "samples = 0"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(ValueError, match=message):
        call()
