"""Lyapunov exponents on systems whose exponents are known."""

import numpy as np
import pytest

from duffing import Duffing, lyapunov_spectrum, two_trajectory_exponent
from duffing.flow import integrate
from duffing.lyapunov import standard_error


@pytest.mark.parametrize("method", ["auto", "rk4"])
@pytest.mark.parametrize("delta", [-1.0, 0.5])
def test_linear_oscillator_has_the_real_parts_of_its_eigenvalues_as_exponents(method, delta):
    """alpha = 2: eigenvalues -1 +- sqrt(1 - delta), a saddle (delta < 0) or a node; the rest is at x = 0."""
    osc = Duffing(alpha=2.0, p=1.0, delta=delta, gamma=0.0)
    spectrum = lyapunov_spectrum(osc, (0.0, 0.0), periods=50, transient=30, method=method)
    exact = -1 + np.array([1, -1]) * np.sqrt(1 - delta)
    np.testing.assert_allclose(spectrum.exponents, exact, atol=1e-7)


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_linear_damping_contracts_area_by_exp_minus_alpha_t(method):
    """p = 1: the exponents' sum is -alpha on every orbit, chaotic (0.25) or not."""
    osc = Duffing(alpha=np.array([0.1, 0.3]), p=1.0, mu=0.25)
    spectrum = lyapunov_spectrum(osc, periods=60, transient=5, method=method)
    np.testing.assert_allclose(spectrum.exponents.sum(axis=0), [-0.1, -0.3], atol=1e-7)


def test_a_conservative_orbit_in_the_well_has_exponents_that_tend_to_zero():
    spectrum = lyapunov_spectrum(Duffing(alpha=0.0, mu=0.0), (1.2, 0.0), periods=400, transient=0)
    np.testing.assert_allclose(spectrum.exponents, 0.0, atol=5e-3)
    assert spectrum.exponents[0] == pytest.approx(-spectrum.exponents[1], abs=1e-8)


def test_exponents_per_unit_time_follow_the_scaling_of_the_equation():
    osc = Duffing(alpha=0.3, p=0.7, mu=0.3, omega=1.5, delta=-2.0, gamma=3.0)
    length, rate = np.sqrt(2.0 / 3.0), np.sqrt(2.0)
    start = np.array([0.3, 0.1])
    ours = lyapunov_spectrum(osc, start * [length, length * rate], periods=30, transient=10)
    unit = lyapunov_spectrum(osc.dimensionless(), start, periods=30, transient=10)
    np.testing.assert_allclose(ours.exponents.sum(), rate * unit.exponents.sum(), atol=1e-8)
    # Each alone depends, over a finite time, on the metric of (x, v), which the scaling changes by the factor `rate`.
    np.testing.assert_allclose(ours.exponents, rate * unit.exponents, atol=np.log(rate) / (30 * osc.period))


def test_two_trajectories_and_the_tangent_agree_on_chaos_with_smooth_damping():
    """Same average over the same time; the orbit separates from itself by rounding, so statistically only."""
    osc = Duffing(p=1.0, alpha=0.15, mu=np.linspace(0.28, 0.30, 16))
    tangent = lyapunov_spectrum(osc, periods=400, k=1, method="rk4")
    pair = two_trajectory_exponent(osc, periods=400)
    chaotic = tangent.exponents[0] > 0.1
    assert chaotic.sum() >= 8
    assert np.abs(tangent.exponents - pair.exponents)[0, chaotic].mean() < 0.02


def test_one_exponent_alone_is_that_of_the_first_tangent_vector_of_two():
    """Over a focus either vector may come out ahead after a finite time; with two, the larger stands first."""
    osc = Duffing(p=0.5, mu=np.array([0.1, 0.2]))
    one, two = (lyapunov_spectrum(osc, periods=30, transient=5, k=k, method="rk4").exponents for k in (1, 2))
    assert np.all(np.min(np.abs(two - one), axis=0) < 1e-9)


def test_history_ends_at_the_exponents_and_shapes_follow_the_family():
    spectrum = lyapunov_spectrum(Duffing(mu=np.full((2, 3), 0.2)), periods=20, transient=5)
    assert spectrum.exponents.shape == spectrum.error.shape == (2, 2, 3)
    assert spectrum.history.shape == (2, 20, 2, 3)
    np.testing.assert_array_equal(spectrum.history[:, -1], spectrum.exponents)
    assert np.all(spectrum.exponents[0] >= spectrum.exponents[1])


def test_error_covers_the_spread_of_repeated_chaotic_runs():
    """Starts apart by 1e-6 are independent samples of the attractor after the transient: their spread is the truth."""
    starts = np.stack([0.45 + 1e-6 * np.arange(48), np.full(48, 0.1)])
    osc = Duffing(p=1.0, alpha=0.15, mu=np.full(48, 0.29))
    spectrum = lyapunov_spectrum(osc, starts, periods=300, transient=60, k=1, method="rk4")
    assert np.median(spectrum.exponents) > 0.1
    assert 0.5 < np.median(spectrum.error) / spectrum.exponents.std(ddof=1) < 2.0


def test_standard_error_of_white_and_of_correlated_noise_is_the_known_one():
    noise = np.random.default_rng(7).standard_normal((200, 4000))  # 200 series
    red = np.empty_like(noise)
    red[:, 0] = noise[:, 0]
    for k in range(1, noise.shape[1]):  # AR(1) with coefficient 0.8: the mean's variance grows by (1 + 0.8) / (1 - 0.8)
        red[:, k] = 0.8 * red[:, k - 1] + np.sqrt(1 - 0.64) * noise[:, k]
    assert np.mean(standard_error(noise.T)) == pytest.approx(1 / np.sqrt(4000), rel=0.05)
    assert np.mean(standard_error(red.T)) == pytest.approx(3 / np.sqrt(4000), rel=0.1)


def test_too_short_a_series_has_no_error_estimate_and_says_so():
    assert lyapunov_spectrum(Duffing(mu=0.2), periods=5, transient=0, k=1).error[0] == np.inf


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"k": 0}, "^k = 0"),
        ({"k": 3}, "^k = 3"),
        ({"periods": 0}, "^periods = 0"),
        ({"transient": -1}, "^transient = -1"),
        ({"state": (1.0,)}, "^state has shape"),
        ({"method": "wolf"}, "^method = 'wolf'"),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        lyapunov_spectrum(Duffing(), **arguments)


@pytest.mark.parametrize(("arguments", "message"), [({"d0": -1.0}, "^d0 = -1"), ({"periods": 0}, "^periods = 0")])
def test_bad_arguments_of_the_two_trajectories_are_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        two_trajectory_exponent(Duffing(), **arguments)


def test_each_error_belongs_to_its_exponent_also_where_the_frame_comes_out_smallest_first():
    # With p = 1 both would have one error, since areas shrink alike in each period.
    family = Duffing(alpha=0.05, p=np.repeat([2.0, 0.5], 8), delta=np.linspace(0.3, 3.0, 16), gamma=0.0)
    start, periods = (1.0, 0.05), 9
    t = np.arange(periods + 1) * 2 * np.pi
    growth = integrate(family, np.tile(np.array(start)[:, None], 16), t, tangents=2, method="rk4").growth
    spectrum = lyapunov_spectrum(family, start, periods, 0, k=2, method="rk4")
    swapped = growth[0].mean(axis=0) < growth[1].mean(axis=0)
    assert swapped.any() and not swapped.all()
    for member in range(16):
        rows = growth[::-1, :, member] if swapped[member] else growth[:, :, member]
        expected = [standard_error(row) / (2 * np.pi) for row in rows]
        assert abs(expected[0] / expected[1] - 1) > 1e-3
        np.testing.assert_allclose(spectrum.error[:, member], expected, rtol=1e-10)
