"""The explicit step's judge of itself: what its error estimate says of steps that have gone wild."""

import numba
import numpy as np
import pytest
from scipy.integrate import DOP853

from duffing.integrators.friction_time.block import BLOCK, NEW, RATE, SLOPES, STATE, H, M, T, W, X
from duffing.integrators.friction_time.dop853 import error
from duffing.integrators.friction_time.equations import LINEAR, TWO_POWERS


@numba.njit(error_model="numpy")
def estimate(a, kind):
    return error(a, 0, 1e-6, 1e-8, kind)


def _block(x_slopes, h=0.1):
    """A step of length h from the state (1, 0.5) whose stages have these slopes of x, and none of w."""
    a = np.zeros(BLOCK)
    a[[H, M, X, W, NEW + W, RATE + X, RATE + T]] = h, 1.0, 1.0, 0.5, 0.5, 0.5, 1.0
    for stage, slope in enumerate(x_slopes):
        a[SLOPES + stage * STATE + X], a[SLOPES + stage * STATE + T] = slope, 1.0
    return a


@pytest.mark.parametrize("kind", [LINEAR, TWO_POWERS])
def test_estimate_is_that_of_hairer_norsett_and_wanner(kind):
    slopes = np.random.default_rng(1).normal(size=12)
    fifth, third = (h @ np.append(slopes, 0) for h in (DOP853.E5, DOP853.E3))
    expected = 0.1 * fifth**2 / np.hypot(fifth, 0.1 * third) / (1e-8 + 1e-6 * np.hypot(1.0, 0.5))
    assert estimate(_block(slopes), kind) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("kind", [LINEAR, TWO_POWERS])
@pytest.mark.parametrize("size", [1e120, 1e150, 1e156, 1e160, 1e200, 1e300, np.nan])
def test_a_step_that_overflows_one_estimate_and_not_the_other_is_not_taken(kind, size):
    fifth, third = DOP853.E5[:12], DOP853.E3[:12]
    only_third = third - (third @ fifth) / (fifth @ fifth) * fifth
    assert not estimate(_block(size * only_third), kind) <= 1.0


@pytest.mark.parametrize("kind", [LINEAR, TWO_POWERS])
def test_a_step_without_error_has_none(kind):
    assert estimate(_block(np.zeros(12)), kind) == 0.0
