"""|v|^q for one fixed exponent q, without a branch or a call, so that a loop over it can use the vector units.

Write |v| = 2^e m with 1 <= m < 2, and let c be the reference value of the cell of width 2^-bits in which m lies. Then

    |v|^q = (2^e c)^q (1 + r)^q,   r = m/c - 1,   |r| <= 2^-(bits + 1):

the first factor is read from a table whose index is the top of |v| itself (exponent and first bits of m), the
second is a polynomial of degree 8. Both are built in more than double precision, once for each exponent.
"""

import math
import threading
from functools import lru_cache
from typing import NamedTuple

import mpmath
import numpy as np

from vectorized.compiled import compiled, inlined
from vectorized.vectors import bits, fma, from_bits, take

DEGREE = 8
MOST_BITS = 10  # a table of 2048 x 2^10 doubles, 16 MB: enough for |q| up to about 200
_PRECISION = 120  # bits of the table's recurrence; all else has twice as many
# A context of its own, and a lock: mpmath's global precision belongs to all threads at once.
_mp = mpmath.MPContext()
_mp.prec = 2 * _PRECISION
_LOCK = threading.Lock()


class Power(NamedTuple):
    """What `evaluate` needs to know of one exponent q.

    least : |v| below it counts as `least`, so that |v|^q is finite at v = 0 for q < 0 too
    bits : the table has 2^bits cells for each binary exponent
    table : (2048 * 2^bits,) powers of the cells' reference values
    reciprocals : (2^bits,) 1/c for each cell of the mantissa
    coefficients : of (1 + r)^q, constant first
    """

    least: float
    bits: np.uint64
    table: np.ndarray
    reciprocals: np.ndarray
    coefficients: tuple


@lru_cache(maxsize=64)
def power(q, least=2.0**-1022):
    """Set up |v|^q for a finite q, with |v| < least held at least (2^-1022 at the lowest: subnormal numbers).

    Raises ValueError where |q| is so large that no table of reasonable size gives it to a few units in the last place.
    """
    with _LOCK:
        bits = next((k for k in range(4, MOST_BITS + 1) if _remainder(q, k) < 2.0**-54), None)
        if bits is None or not least >= 2.0**-1022:
            raise ValueError(f"q = {q}, least = {least}: must be |q| < about 200 and least >= 2^-1022")
        cells = 2**bits
        # A cell's middle, rounded so that its reciprocal is the double stored.
        reciprocals = [float(1 / (1 + (_mp.mpf(j) + 0.5) / cells)) for j in range(cells)]
        mantissas = [float(_mp.mpf(c) ** -_mp.mpf(q)) for c in reciprocals]
        coefficients = tuple(map(float, _interpolate(lambda r: (1 + r) ** _mp.mpf(q), _mp.ldexp(1, -bits - 1))))
        binary = _binary_powers(q)
    with np.errstate(over="ignore", under="ignore"):
        table = np.outer(binary, mantissas).ravel()
    return Power(float(least), np.uint64(bits), table, np.array(reciprocals), coefficients)


def _remainder(q, bits):
    """Error bound of interpolating (1 + r)^q at DEGREE + 1 Chebyshev points of |r| <= h = 2^-(bits + 1)."""
    n = DEGREE + 1
    return abs(_mp.binomial(q, n)) * 2 * _mp.ldexp(1, -(bits + 2) * n) * (1 + abs(q) / 2**bits)


def _interpolate(function, h):
    """Coefficients, constant first, of the polynomial through the Chebyshev points of [-h, h] (Newton's form)."""
    n = DEGREE + 1
    nodes = [h * _mp.cospi(_mp.mpf(2 * i + 1) / (2 * n)) for i in range(n)]
    divided = [function(r) for r in nodes]
    for order in range(1, n):
        for i in range(n - 1, order - 1, -1):
            divided[i] = (divided[i] - divided[i - 1]) / (nodes[i] - nodes[i - order])
    coefficients = [_mp.mpf(0)] * n
    for i in range(n - 1, -1, -1):  # c(r) <- c(r) (r - node) + divided difference
        shifted = [_mp.mpf(0), *coefficients[:-1]]
        coefficients = [up - nodes[i] * down for up, down in zip(shifted, coefficients, strict=True)]
        coefficients[0] += divided[i]
    return coefficients


def _binary_powers(q):
    """2^(q (field - 1023)) for the 2048 values of a double's exponent field, each rounded once.

    Repeated multiplication by 2^q in integers of _PRECISION bits, mantissa and exponent apart: no range to leave.
    """
    whole = math.floor(q)
    step = int(_mp.ldexp(_mp.mpf(2) ** (_mp.mpf(q) - whole), _PRECISION))
    start = _mp.mpf(q) * -1023
    exponent = int(_mp.floor(start))
    mantissa = int(_mp.ldexp(_mp.mpf(2) ** (start - exponent), _PRECISION))
    values = np.empty(2048)
    for field in range(2048):
        power_of_two = exponent - _PRECISION
        values[field] = math.ldexp(float(mantissa), power_of_two) if exponent < 1024 else math.inf
        mantissa, exponent = mantissa * step >> _PRECISION, exponent + whole
        if mantissa >> (_PRECISION + 1):
            mantissa, exponent = mantissa >> 1, exponent + 1
    return values


@inlined
def evaluate(v, q):
    """max(|v|, q.least)^q to a few units in the last place, for a double v, or eight, and a set-up q."""
    c = q.coefficients
    a = max(abs(v), q.least)
    cell = bits(a) >> (np.uint64(52) - q.bits)
    m = from_bits((bits(a) & np.uint64(0x000FFFFFFFFFFFFF)) | np.uint64(0x3FF0000000000000))
    # One rounding: m/c - 1 to the last place, where rounding m/c first would cost q/2 units of the result.
    r = fma(m, take(q.reciprocals, cell & ((np.uint64(1) << q.bits) - np.uint64(1))), -1.0)
    # Estrin's form: the products of one line wait for nothing but the line before.
    r2 = r * r
    r4 = r2 * r2
    low = fma(fma(c[3], r, c[2]), r2, fma(c[1], r, c[0]))
    high = fma(fma(c[7], r, c[6]), r2, fma(c[5], r, c[4]))
    return take(q.table, cell) * fma(fma(c[8], r4, high), r4, low)


@compiled
def powers(v, q):
    """max(|v|, q.least)^q for a float array v of any shape (the loop that a kernel would write itself)."""
    result = np.empty_like(v)
    for i in range(v.size):
        result.flat[i] = evaluate(v.flat[i], q)
    return result
