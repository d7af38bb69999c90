"""How wide vectors are is a matter of speed: asked for where the processor has them, and never of the result."""

import llvmlite.binding as llvm
import numba
import numpy as np
import pytest

from duffing.integrators import rk4
from duffing.integrators.friction_time import dop853
from duffing.integrators.friction_time import equations as friction_time
from duffing.integrators.friction_time import step_control as judge
from duffing.integrators.powers import fma
from duffing.integrators.vectors import stack, widest_vectors
from duffing.oscillator import Duffing

WIDE = llvm.get_host_cpu_features().get("avx512f", False)
POINTER, WHOLE = numba.types.CPointer(numba.float64), numba.int64
STAGE = numba.types.literal(7)
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
        (friction_time.rates, (POINTER, WHOLE, WHOLE, WHOLE)),
        (dop853._combine, (POINTER, WHOLE, STAGE, WHOLE, WHOLE)),
        (judge.judge, (POINTER, WHOLE, WHOLE, WHOLE, CONTROL, WHOLE)),
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
