"""Eight lanes as one number: each lane is what it would be alone, in registers as wide as the processor has them."""

import math

import llvmlite.binding as llvm
import numba
import numpy as np
import pytest

from duffing.integrators import rk4
from duffing.integrators.friction_time import dop853, equations, step_control
from duffing.oscillator import Duffing
from vectorized.memory import stack, views, widest_vectors
from vectorized.vectors import bits, fma, from_bits, repeated, root, take, where

WIDE = llvm.get_host_cpu_features().get("avx512f", False)
POINTER, WHOLE = numba.types.CPointer(numba.float64), numba.int64
CONTROL = numba.types.Tuple((numba.float64, numba.float64, numba.int64, numba.float64))


def _sums(wide):
    if wide:

        @numba.njit
        def sums(a, b):
            widest_vectors()
            for l in range(a.size):
                a[l] = fma(a[l], b[l], 0.1) / (1.0 + b[l] * b[l])
    else:

        @numba.njit
        def sums(a, b):
            for l in range(a.size):
                a[l] = fma(a[l], b[l], 0.1) / (1.0 + b[l] * b[l])

    return sums


def test_the_width_of_vectors_changes_no_bit():
    results = []
    for wide in (False, True):
        a, b = np.random.default_rng(3).normal(size=(2, 101))
        _sums(wide)(a, b)
        results.append(a)
    np.testing.assert_array_equal(*results)


@pytest.mark.parametrize(
    ("kernel", "arguments"),
    [
        (equations.rates, (POINTER, WHOLE, WHOLE, WHOLE, WHOLE)),
        (dop853._combine, (POINTER, WHOLE, WHOLE, WHOLE, WHOLE)),
        (step_control.accept_steps, (POINTER, WHOLE, WHOLE, WHOLE, CONTROL, WHOLE)),
    ],
)
def test_the_lanes_have_all_of_a_vector_register(kernel, arguments):
    # What comes from the cache cannot be looked into.
    anew = numba.njit(kernel.py_func, error_model="numpy")
    anew.compile(arguments)
    _assert_wide(anew)


def test_the_papers_algorithm_has_all_of_a_vector_register(monkeypatch):
    anew = numba.njit(rk4.advance.py_func, error_model="numpy")
    monkeypatch.setattr(rk4, "advance", anew)
    rk4.integrate(Duffing(mu=np.full(16, 0.2), p=0.1), (0.45, 0.1), [0.0, 0.1], threads=1)
    _assert_wide(anew)


def _assert_wide(function):
    (signature,) = function.signatures
    assert '"prefer-vector-width"="512"' in function.inspect_llvm(signature)
    if WIDE:  # the inner loops: more of the widest registers than of halves
        assembly = function.inspect_asm(signature)
        assert assembly.count("zmm") > 2 * assembly.count("ymm")


def test_the_memory_on_the_stack_starts_with_zeros():
    @numba.njit
    def summed():
        total = 0.0
        for _ in range(3):
            a = stack(37)
            for i in range(37):
                total += a[i]
                a[i] = 1.0
        return total

    assert summed() == 0.0


SPECIAL = [0.0, -0.0, 1.5, -2.25, math.inf, -math.inf, math.nan, 5e-324]


def _both(function, *rows):
    """Results of a compiled function of doubles for each of eight, one by one and all at once."""
    lanes, eights = views(((4,),), 8)

    @numba.njit(error_model="numpy")
    def one_by_one(given, found):
        block = stack(32)
        view = lanes(block, 0)
        for l in range(8):
            for row in range(given.shape[0]):
                view[row, l] = given[row, l]
            view[3, l] = function(view[0, l], view[1, l], view[2, l])
            found[l] = view[3, l]

    @numba.njit(error_model="numpy")
    def at_once(given, found):
        block = stack(32)
        view, all_of_it = lanes(block, 0), eights(block, 0)
        for l in range(8):
            for row in range(given.shape[0]):
                view[row, l] = given[row, l]
        all_of_it[3, 0] = function(all_of_it[0, 0], all_of_it[1, 0], all_of_it[2, 0])
        for l in range(8):
            found[l] = view[3, l]

    given, found = np.zeros((3, 8)), np.empty((2, 8))
    given[: len(rows)] = rows
    one_by_one(given, found[0])
    at_once(given, found[1])
    return found


@numba.njit(error_model="numpy")
def _arithmetic(a, b, c):
    return fma(a, b, c) + (a - b) * 2.0 / c - abs(b) + root(a) + max(c, 1.25) + repeated(0.5, a)


@numba.njit
def _choices(a, b, c):
    inside = (a < b) & (b <= c) | (a > 1.0) | (b >= 2.0) | (c == 0.0)
    return where(inside, -a, where(a != b, max(c, 1.25), c))


@numba.njit
def _words(a, b, c):
    moved = (bits(a) + np.uint64(12345)) & np.uint64(0x7FEFFFFFFFFFFFFF)
    return from_bits(((moved >> np.uint64(3)) | np.uint64(0x3FF0000000000000)) << np.uint64(1))


@pytest.mark.parametrize("function", [_arithmetic, _choices, _words])
def test_eight_at_once_are_the_same_bits_as_one_by_one(function):
    rng = np.random.default_rng(2)
    for rows in (rng.normal(size=(3, 8)), [SPECIAL, SPECIAL[::-1], np.roll(SPECIAL, 3)]):
        one_by_one, at_once = _both(function, *rows)
        assert np.array_equal(one_by_one, at_once, equal_nan=True)
        number = ~np.isnan(one_by_one)
        assert np.array_equal(np.signbit(one_by_one[number]), np.signbit(at_once[number]))


def test_eight_places_of_a_table_at_once():
    table = np.random.default_rng(4).normal(size=64)

    @numba.njit
    def looked_up(a, b, c):
        return take(table, bits(a) >> np.uint64(46) & np.uint64(63))

    found = _both(looked_up, np.random.default_rng(5).normal(size=8))
    assert np.array_equal(*found) and np.isin(found, table).all() and len(set(found[0])) > 3
