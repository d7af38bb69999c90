"""|v|^q by table and polynomial, against mpmath."""

import mpmath
import numpy as np
import pytest
from numba import njit

from duffing.integrators import powers

EXPONENTS = [-0.99, -0.9, -0.5, -0.05, 0.3, 0.5, 1.0, 2.0, 7.3, 40.0, 150.0]
LEAST_NORMAL = 2.0**-1022


def _units_in_the_last_place(got, exact):
    return max(
        abs(mpmath.mpf(float(g)) - e) / mpmath.mpf(float(np.spacing(float(e)))) for g, e in zip(got, exact, strict=True)
    )


def _exact(v, q):
    with mpmath.workprec(200):
        return [mpmath.mpf(float(abs(a))) ** mpmath.mpf(q) for a in v]


@pytest.mark.parametrize("q", EXPONENTS)
def test_power_is_right_to_four_units_in_the_last_place_over_the_whole_range(q):
    # Speeds of every magnitude whose power is a normal number, either sign, and every cell border of [1, 2).
    reach = min(1021.0, 1000.0 / abs(q))
    v = np.exp2(np.random.default_rng(20060601).uniform(-reach, reach, 3000)) * np.resize([1.0, -1.0], 3000)
    borders = 1.0 + np.arange(1024) / 1024
    v = np.concatenate([v, borders, np.nextafter(borders, 0.0), np.nextafter(borders, 2.0)])
    got = powers.powers(v, powers.power(q))
    assert _units_in_the_last_place(got, _exact(v, q)) < 4


@pytest.mark.parametrize("q", [-0.9, -0.5, 0.5])
def test_subnormal_speeds_and_zero_count_as_the_least_speed(q):
    small = np.array([0.0, -0.0, 5e-324, -1e-310, LEAST_NORMAL])
    got = powers.powers(small, powers.power(q))
    assert _units_in_the_last_place(got, _exact(np.full(5, LEAST_NORMAL), q)) < 4


def test_speeds_below_a_chosen_least_speed_give_its_power_and_others_do_not():
    law = powers.power(-0.9, 2.0**-50)
    below, above = np.array([0.0, 1e-300, -(2.0**-51)]), np.array([2.0**-49, -1e-12])
    assert _units_in_the_last_place(powers.powers(below, law), _exact(np.full(3, 2.0**-50), -0.9)) < 4
    assert _units_in_the_last_place(powers.powers(above, law), _exact(above, -0.9)) < 4


def test_powers_beyond_the_range_of_doubles_overflow_to_infinity_and_underflow_to_zero():
    law = powers.power(3.0)
    assert powers.powers(np.array([1e200, 1e-200]), law).tolist() == [np.inf, 0.0]


def test_fused_multiply_add_rounds_once():
    @njit
    def fused(a, b, c):
        return powers.fma(a, b, c)

    tiny = 2.0**-30
    # (1 + t)(1 - t) - 1 = -t^2, which two roundings lose.
    assert fused(1 + tiny, 1 - tiny, -1.0) == -(tiny**2)


@pytest.mark.parametrize(("q", "least"), [(1e4, LEAST_NORMAL), (-0.9, 0.0), (-0.9, np.nan), (np.nan, LEAST_NORMAL)])
def test_exponents_out_of_reach_and_impossible_least_speeds_are_refused(q, least):
    with pytest.raises(ValueError, match="q = "):
        powers.power(q, least)
