"""Values that others have published for the double well, the single well and Ueda's attractor, and what is refused.

Exponents of Ueda's attractor: J. C. Sprott, Chaos and Time-Series Analysis (2003), p. 429. The periods at alpha = 0.3,
omega = 1.2 are the textbook series of D. W. Jordan and P. Smith, Nonlinear Ordinary Differential Equations. Where the
other values were printed first could not be established: they are known from public reports on this oscillator.
"""

import numpy as np
import pytest

from duffing import Duffing, critical_amplitude, homoclinic_tangency, lyapunov_spectrum, poincare_section, saddle_orbit


def averaged(osc, k):
    """Exponents (k,) and their standard errors, from 32 initial conditions a little apart, 400 periods each."""
    starts = np.array([1.0 + np.linspace(0, 0.1, 32), np.zeros(32)])
    family = Duffing(osc.alpha, osc.p, np.full(32, osc.mu), osc.omega, osc.delta, osc.gamma)
    exponents = lyapunov_spectrum(family, starts, periods=400, transient=100, k=k, method="rk4").exponents
    return exponents.mean(axis=1), exponents.std(axis=1) / np.sqrt(32)


def test_exponents_of_uedas_attractor():
    exponents, error = averaged(Duffing(alpha=0.05, delta=0.0, gamma=1.0, mu=7.5), k=2)
    assert error.max() < 2e-3
    np.testing.assert_allclose(exponents, [0.103, -0.153], atol=1e-3 + 3 * error.max())
    assert abs(exponents.sum() + 0.05) < 1e-6  # the area shrinks by exp(-alpha t)


def test_exponent_of_chaos_in_the_double_well():
    (exponent,), (error,) = averaged(Duffing(alpha=0.25, mu=0.4), k=1)
    assert error < 2e-3
    assert 0.155 - 3 * error < exponent < 0.157 + 3 * error


@pytest.mark.parametrize(("start", "point"), [((-1.0, 0.0), (-0.779055, 0.027417)), ((1.0, 0.0), (1.210091, 0.055295))])
def test_points_of_period_one_in_each_well(start, point):
    found = poincare_section(Duffing(alpha=0.15, mu=0.2), start, periods=1, transient=300, method="rk4")[:, 0]
    np.testing.assert_allclose(found, point, atol=1e-6)


@pytest.mark.parametrize(("mu", "period"), [(0.20, 1), (0.28, 2), (0.29, 4), (0.37, 5), (0.50, None), (0.65, 2)])
def test_periods_of_the_textbook_series(mu, period):
    points = poincare_section(
        Duffing(alpha=0.3, omega=1.2, mu=mu), (1.0, 0.0), periods=60, transient=1500, method="rk4"
    )
    apart = [np.abs(points[:, n:] - points[:, :-n]).max() for n in range(1, 13)]
    repeats = [n for n, distance in enumerate(apart, 1) if distance < 1e-5]
    assert repeats[:1] == ([period] if period else [])


def test_hysteresis_between_the_folds():
    """At alpha = 0.1, omega = 1.25 a small and a large orbit coexist between mu = 0.04865 and 0.07224 only."""

    def amplitudes(mu):
        starts = np.array(np.meshgrid(np.linspace(0.2, 1.6, 6), np.linspace(-0.5, 0.5, 4))).reshape(2, -1)
        family = Duffing(alpha=0.1, omega=1.25, mu=np.full(starts.shape[1], mu))
        last = poincare_section(family, starts, periods=2, transient=600, method="rk4")
        once = np.abs(last[:, 1] - last[:, 0]).max(axis=0) < 1e-6
        return {tuple(point) for point in np.round(last[:, 1, once & (last[0, 1] > 0)].T, 3)}

    assert [len(amplitudes(mu)) for mu in (0.0480, 0.0495, 0.0715, 0.0730)] == [1, 2, 2, 1]


@pytest.mark.parametrize("call", [critical_amplitude, saddle_orbit, homoclinic_tangency])
def test_where_a_double_well_is_needed_none_is_refused_by_name(call):
    with pytest.raises(ValueError, match=r"^delta = 0.0: must be < 0 for a double well"):
        call(Duffing(alpha=0.05, delta=0.0))
