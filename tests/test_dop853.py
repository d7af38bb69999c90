"""The explicit step: that of Dormand and Prince, and its judge of itself where a step has gone wild."""

import numba
import numpy as np
import pytest
from scipy.integrate import DOP853
from scipy.integrate._ivp.rk import rk_step

from duffing import Duffing
from duffing.integrators.friction_time.block import (
    BLOCK, LAST, NEW, NOW, OSC, SLOPES, STEP, H, M, T, W, X, eights, lanes,
)  # fmt: skip
from duffing.integrators.friction_time.dop853 import error, step
from duffing.integrators.friction_time.equations import SMOOTH, TWO_POWERS, first_slopes, parameters
from vectorized.memory import stack


@numba.njit(error_model="numpy")
def one_step(osc, x, w, t, h, kind):
    """(x, w, t) after a step of length h, by a lane of a block of its own."""
    block = stack(BLOCK)
    for row in range(osc.size):
        lanes(block, OSC)[row, 0] = osc[row]
    now, new = lanes(block, NOW), lanes(block, NEW)
    now[X, 0], now[W, 0], now[T, 0], lanes(block, STEP)[H, 0] = x, w, t, h
    first_slopes(block, 0)
    step(block, 1, 0, kind)
    return new[X, 0], new[W, 0], new[T, 0]


@pytest.mark.parametrize(("p", "kind"), [(1.0, SMOOTH), (1.0, TWO_POWERS), (0.3, TWO_POWERS), (2.5, TWO_POWERS)])
def test_one_step_of_one_lane_is_that_of_scipys_dop853(p, kind):
    model = Duffing(p=p, mu=0.27, omega=1.3)
    row = parameters(model.columns())[0]
    m, n = row[M], row[M + 1]

    def slopes(sigma, y):  # the equations as the chapter has them: d(x, w, t)/dsigma
        x, w, t = y
        phi, v = m * abs(w) ** (m - 1), np.sign(w) * abs(w) ** m
        pace = 1.0 if m == 1 else 1 / (m + phi)
        push = -model.delta * x - model.gamma * x**3 + model.mu * np.cos(model.omega * t)
        return np.array([phi * v, push - model.alpha * np.sign(w) * abs(w) ** n, phi]) * pace

    start, h = np.array([0.45, 0.9, 0.7]), 0.4
    stages = np.empty((13, 3))
    expected, _ = rk_step(slopes, 0.0, start, slopes(0.0, start), h, DOP853.A, DOP853.B, DOP853.C, stages)
    assert np.abs(expected - start).min() > 1e-3
    np.testing.assert_allclose(one_step(row, *start, h, kind), expected, rtol=1e-14)


@numba.njit(error_model="numpy")
def estimate(x_slopes, h, kind):
    """Error of a step of length h from the state (1, 0.5) whose stages have these slopes of x, and none of w."""
    block = stack(BLOCK)
    now, new, slopes = lanes(block, NOW), lanes(block, NEW), lanes(block, SLOPES)
    lanes(block, STEP)[H, 0], lanes(block, OSC)[M, 0] = h, 1.0
    now[X, 0], now[W, 0], new[W, 0], slopes[LAST, X, 0], slopes[LAST, T, 0] = 1.0, 0.5, 0.5, 0.5, 1.0
    for stage in range(12):
        slopes[stage, X, 0], slopes[stage, T, 0] = x_slopes[stage], 1.0
    parts = eights(block, NOW), eights(block, NEW), eights(block, SLOPES), eights(block, OSC), eights(block, STEP)
    now, new, slopes, osc, lengths = parts
    now[W + 1, 0] = error(now, new, slopes, osc, lengths, 0, 1e-6, 1e-8, kind)
    return lanes(block, NOW)[W + 1, 0]


@pytest.mark.parametrize("kind", [SMOOTH, TWO_POWERS])
def test_estimate_is_that_of_hairer_norsett_and_wanner(kind):
    slopes = np.random.default_rng(1).normal(size=12)
    fifth, third = (h @ np.append(slopes, 0) for h in (DOP853.E5, DOP853.E3))
    expected = 0.1 * fifth**2 / np.hypot(fifth, 0.1 * third) / (1e-8 + 1e-6 * np.hypot(1.0, 0.5))
    assert estimate(slopes, 0.1, kind) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("kind", [SMOOTH, TWO_POWERS])
@pytest.mark.parametrize("size", [1e120, 1e150, 1e156, 1e160, 1e200, 1e300, np.nan])
def test_a_step_that_overflows_one_estimate_and_not_the_other_is_not_taken(kind, size):
    fifth, third = DOP853.E5[:12], DOP853.E3[:12]
    only_third = third - (third @ fifth) / (fifth @ fifth) * fifth
    assert not estimate(size * only_third, 0.1, kind) <= 1.0


@pytest.mark.parametrize("kind", [SMOOTH, TWO_POWERS])
def test_a_step_without_error_has_none(kind):
    assert estimate(np.zeros(12), 0.1, kind) == 0.0
