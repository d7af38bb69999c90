"""Powers and cosine of the lanes: against mpmath, over the whole range of exponents."""

import mpmath
import numpy as np
import pytest

from duffing.integrators.friction_time.elementary import cosine, logarithm, power
from vectorized.compiled import compiled


@compiled
def _powers(a, q):
    result = np.empty_like(a)
    for i in range(a.size):
        e, l = logarithm(a[i])
        result[i] = power(e, l, q)
    return result


@compiled
def _cosines(turns):
    result = np.empty_like(turns)
    for i in range(turns.size):
        result[i] = cosine(turns[i])
    return result


@pytest.mark.parametrize("q", [0.01, 0.1, 1.0, 9.0, 33.3, 99.0])
def test_powers_equal_mpmath_to_as_many_last_places_as_they_promise(q):
    # Both ends of the mantissa's range, and all binary exponents whose power is a normal number.
    reach = min(1022, 1021 / q)
    a = np.append(2.0 ** np.linspace(-reach, reach, 801), np.random.default_rng(1).uniform(0.5, 2, 400))
    with mpmath.workprec(120):
        exact = [mpmath.mpf(x) ** q for x in a]
        errors = [abs(float(y / e - 1)) for y, e in zip(_powers(a, q), exact, strict=True)]
    # log2 of the mantissa is at most 1/2.
    assert max(errors) < (1 + q / 2) * 2 * 2.0**-52


def test_power_zero_is_exactly_one_and_powers_out_of_range_are_zero_or_infinite():
    a = np.array([2.0**-1022, 1e-200, 1.0, 3.7, 1e300])
    np.testing.assert_array_equal(_powers(a, 0.0), 1.0)
    np.testing.assert_array_equal(_powers(a, 9.0)[[0, 1, 4]], [0.0, 0.0, np.inf])


def test_powers_of_one_are_exactly_one():
    assert all(_powers(np.ones(1), q)[0] == 1.0 for q in (0.1, 9.0, 99.0))


def test_cosine_equals_mpmath_to_the_last_places_of_one():
    turns = np.concatenate([np.arange(-8, 9) / 8, np.random.default_rng(2).uniform(-1, 1, 400) * 1000])
    with mpmath.workprec(120):
        errors = [abs(float(y - mpmath.cospi(2 * mpmath.mpf(u)))) for y, u in zip(_cosines(turns), turns, strict=True)]
    assert max(errors) < 4 * 2.0**-53
