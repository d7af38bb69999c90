"""Powers of any exponent and the cosine, of a double or of eight: without a branch or a call.

Spelled out in operations that IEEE 754 fixes: the same bits in every lane of a vector and on every machine. Where one
exponent serves many values the table of `powers` is cheaper; here each value has its own.
"""

import mpmath
import numpy as np

from vectorized.compiled import inlined
from vectorized.vectors import bits, fma, from_bits, where

_ROUND = 1.5 * 2.0**52  # added and taken away again it rounds to a whole number
_TO_ONE = np.uint64(0x3FF0000000000000 - 0x3FE6A09E667F3BCD)  # from the bits of sqrt(1/2) to those of 1
_MANTISSA, _ROOT, _FIELD = np.uint64(0x000FFFFFFFFFFFFF), np.uint64(0x3FE6A09E667F3BCD), np.uint64(52)
_WHOLE, _BIAS = np.uint64(0x4330000000000000), np.uint64(1023)


def _polynomial(function, low, high, terms):
    """Coefficients, constant first, of the polynomial that comes closest to a function of the interval, nearly."""
    return tuple(float(c) for c in reversed(mpmath.chebyfit(function, [low, high], terms)))


# The numbers of terms leave errors below 2^-57.
with mpmath.workprec(100):
    _ln2, _turn, _most = mpmath.log(2), 2 * mpmath.pi, ((mpmath.sqrt(2) - 1) / (mpmath.sqrt(2) + 1)) ** 2
    _LOG = _polynomial(lambda z: 2 * mpmath.atanh(mpmath.sqrt(z)) / (mpmath.sqrt(z) * _ln2), 0, _most, 8)
    _EXP = _polynomial(lambda f: 2**f, -0.5, 0.5, 12)
    _SIN = _polynomial(lambda z: mpmath.sin(_turn * mpmath.sqrt(z)) / mpmath.sqrt(z), 0, 0.0625, 9)


@inlined
def logarithm(a):
    """Whole number e and log2(m) of a = 2^e m, sqrt(1/2) <= m < sqrt(2), for a > 0 not subnormal."""
    moved = bits(a) + _TO_ONE
    e = from_bits((moved >> _FIELD) | _WHOLE) - (2.0**52 + 1023.0)
    m = from_bits((moved & _MANTISSA) + _ROOT)
    s = (m - 1.0) / (m + 1.0)
    z = s * s
    z2 = z * z
    z4 = z2 * z2
    # Estrin's form here and below: the products of one line wait for nothing but the line before.
    c = _LOG
    low = fma(fma(c[3], z, c[2]), z2, fma(c[1], z, c[0]))
    high = fma(fma(c[7], z, c[6]), z2, fma(c[5], z, c[4]))
    return e, s * fma(high, z4, low)


@inlined
def power(e, l, q):
    """2^(q (e + l)), to about 1 + |q l| units in the last place; exactly 1 for q = 0, and 0 where it is subnormal."""
    whole = (q * (e + l) + _ROUND) - _ROUND
    f = fma(q, l, fma(q, e, -whole))
    f2 = f * f
    f4 = f2 * f2
    c = _EXP
    low = fma(fma(c[3], f, c[2]), f2, fma(c[1], f, c[0]))
    high = fma(fma(c[7], f, c[6]), f2, fma(c[5], f, c[4]))
    top = fma(fma(c[11], f, c[10]), f2, fma(c[9], f, c[8]))
    scale = from_bits((bits(whole + _ROUND) + _BIAS) << _FIELD)
    value = scale * fma(fma(top, f4, high), f4, low)
    value = where(whole < -1022.0, 0.0, value)
    return where(whole > 1023.0, np.inf, value)


@inlined
def cosine(turns):
    """cos(2 pi turns), to one unit in the last place of 1."""
    z = 0.25 - abs(turns - ((turns + _ROUND) - _ROUND))  # cos(2 pi u) = sin(2 pi (1/4 - |u|))
    z2 = z * z
    z4 = z2 * z2
    z8 = z4 * z4
    c = _SIN
    low = fma(fma(c[3], z2, c[2]), z4, fma(c[1], z2, c[0]))
    high = fma(fma(c[7], z2, c[6]), z4, fma(c[5], z2, c[4]))
    return z * fma(fma(c[8], z8, high), z8, low)
