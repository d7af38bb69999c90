"""One adaptive step of Dormand and Prince's pair of order 8 with errors of order 5 and 3, in all lanes of a block.

Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), sections II.5 and II.10. The
coefficients are SciPy's. The equations are those of `friction_time`; nothing here knows the friction.
"""

import numpy as np
from numba import njit
from scipy.integrate import DOP853

from .compiled import compiled
from .friction_time import rates
from .lanes import NEW, RATE, SLOPES, STATE, WIDTH, H, M, S, T, W, X
from .powers import fma

_TABLE = np.vstack([DOP853.A, DOP853.B])  # the last row leads to the new point
_E3, _E5 = np.ascontiguousarray(DOP853.E3), np.ascontiguousarray(DOP853.E5)
# A step's error in w alone displaces the point along its own orbit where time hardly runs; friction time and
# tangents feel it, the state does not, so it counts less.
_ALONG = 0.01


@compiled
def advance(a, eights, tangents, kind):
    """NEW = state after a step of H, RATE = the slopes there; SLOPES of stage 0 are those at the state."""
    end = STATE - (2 - tangents) * 2 * WIDTH
    # A line a stage: its number is then a constant, the sum over stages unrolls and leaves out the table's zeros.
    _combine(a, eights, 1, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 2, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 3, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 4, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 5, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 6, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 7, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 8, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 9, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 10, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 11, X, end)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 12, S, end)  # friction time acts on nothing: only its end counts
    rates(a, eights, tangents, kind)


@njit(forceinline=True)
def _combine(a, eights, stage, first, end):
    """NEW = state + H (the stage's row of the table) slopes for the rows from first to end."""
    if stage > 1:  # keep the slopes of the stage before
        for row in range(S, end, WIDTH):
            for l in range(8 * eights):
                a[SLOPES + (stage - 1) * STATE + row + l] = a[RATE + row + l]
    for row in range(first, end, WIDTH):
        for l in range(8 * eights):
            total = 0.0
            for j in range(stage):
                if _TABLE[stage, j] != 0.0:
                    total = fma(_TABLE[stage, j], a[SLOPES + j * STATE + row + l], total)
            a[NEW + row + l] = fma(a[H + l], total, a[row + l])


@njit(forceinline=True)
def error(a, l, rtol, atol):
    """Estimated error of the step, 1 = just tolerable: of x and v at fixed time, relative to the state's length."""
    m, w = a[M + l], a[NEW + W + l]
    v = _quotient(a[RATE + X + l], a[RATE + T + l])
    phi = 1.0 if m == 1.0 else m * _quotient(v, w)
    acceleration = a[RATE + W + l] * (1.0 if m == 1.0 else m + phi)
    x5, w5, t5 = _estimate(a, l, X, _E5), _estimate(a, l, W, _E5), _estimate(a, l, T, _E5)
    x3, w3, t3 = _estimate(a, l, X, _E3), _estimate(a, l, W, _E3), _estimate(a, l, T, _E3)
    squares5 = _square(x5, w5, t5, v, phi, acceleration)
    squares = squares5 + 0.01 * _square(x3, w3, t3, v, phi, acceleration)
    # Of the old point: a step that has gone wild would excuse itself by the size of what it leads to.
    x, v = a[X + l], _quotient(a[SLOPES + X + l], a[SLOPES + T + l])
    scale = atol + rtol * np.sqrt(x * x + v * v)
    return 0.0 if squares == 0.0 else abs(a[H + l]) / scale * squares5 / np.sqrt(squares)


@njit(forceinline=True)
def _quotient(a, b):
    return 0.0 if b == 0.0 else a / b


@njit(forceinline=True)
def _estimate(a, l, row, weights):
    """The weighted sum of a component's slopes."""
    total = 0.0
    for j in range(12):
        if weights[j] != 0.0:
            total = fma(weights[j], a[SLOPES + j * STATE + row + l], total)
    return total


@njit(forceinline=True)
def _square(x, w, t, v, phi, acceleration):
    """Squared error of the state. The flow carries one in time to one in the state: what counts is the same time."""
    ex, ev, ew = fma(-v, t, x), fma(phi, w, -acceleration * t), _ALONG * w
    return fma(ex, ex, fma(ev, ev, ew * ew))
