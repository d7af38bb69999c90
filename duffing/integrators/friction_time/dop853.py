"""One adaptive step of Dormand and Prince's pair of order 8 with errors of order 5 and 3, in all lanes of a block.

Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), sections II.5 and II.10. The
coefficients are SciPy's. The equations are those of `friction_time`; nothing here knows the friction.
"""

import numpy as np
from numba import njit
from scipy.integrate import DOP853

from ..compiled import compiled
from ..powers import fma
from ..vectors import widest_vectors
from .block import ETA1, ETA2, NEW, RATE, SLOPES, STATE, XI1, XI2, H, M, S, T, W, X
from .equations import LINEAR, rates

_TABLE = np.vstack([DOP853.A, DOP853.B])  # the last row leads to the new point
_LAST = 12
# The rows' sums, added up as `_combine` does: where sigma is time, the slope of T and S is 1 at every stage.
_NODES = np.ascontiguousarray(np.cumsum(_TABLE, axis=1)[:, -1])
_E3, _E5 = np.ascontiguousarray(DOP853.E3), np.ascontiguousarray(DOP853.E5)
# A step's error in w alone displaces the point along its own orbit where time hardly runs; friction time and
# tangents feel it, the state does not, so it counts less.
_ALONG = 0.01


@compiled
def advance(a, eights, tangents, kind):
    """NEW = state after a step of H, RATE = the slopes there; SLOPES of stage 0 are those at the state."""
    # A line a stage: its number is then a constant, the sum over stages unrolls and leaves out the table's zeros.
    _combine(a, eights, 1, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 2, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 3, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 4, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 5, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 6, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 7, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 8, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 9, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 10, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, 11, tangents, kind)
    rates(a, eights, tangents, kind)
    _combine(a, eights, _LAST, tangents, kind)
    rates(a, eights, tangents, kind)


@njit(forceinline=True)
def _combine(a, eights, stage, tangents, kind):
    """NEW = state + H (the stage's row of the table) slopes, the last of which are RATE and are kept in SLOPES."""
    widest_vectors()
    # Rows spelled out: where their distances are constants, no loop has to make sure first that they do not overlap.
    if kind == LINEAR:
        for l in range(8 * eights):
            a[NEW + S + l] = fma(a[H + l], _NODES[stage], a[S + l])
            a[NEW + T + l] = fma(a[H + l], _NODES[stage], a[T + l])
    else:
        for l in range(8 * eights):
            _keep(a, l, stage, S)
            _component(a, l, stage, T)
        if stage == _LAST:  # friction time acts on nothing: only its end counts
            for l in range(8 * eights):
                _component(a, l, stage, S)
    for l in range(8 * eights):
        _component(a, l, stage, X)
        _component(a, l, stage, W)
    if tangents > 0:
        for l in range(8 * eights):
            _component(a, l, stage, XI1)
            _component(a, l, stage, ETA1)
    if tangents > 1:
        for l in range(8 * eights):
            _component(a, l, stage, XI2)
            _component(a, l, stage, ETA2)


@njit(forceinline=True)
def _keep(a, l, stage, row):
    """SLOPES of the stage before = RATE."""
    if stage > 1:
        a[SLOPES + (stage - 1) * STATE + row + l] = a[RATE + row + l]


@njit(forceinline=True)
def _component(a, l, stage, row):
    """What `_combine` does, for one row of one lane."""
    _keep(a, l, stage, row)
    total = 0.0
    for j in range(stage):
        if _TABLE[stage, j] != 0.0:
            total = fma(_TABLE[stage, j], a[SLOPES + j * STATE + row + l], total)
    a[NEW + row + l] = fma(a[H + l], total, a[row + l])


@njit(forceinline=True)
def error(a, l, rtol, atol, kind):
    """Estimated error of the step, 1 = just tolerable: of x and v at fixed time, relative to the state's length."""
    x5, w5, x3, w3 = _estimate(a, l, X, _E5), _estimate(a, l, W, _E5), _estimate(a, l, X, _E3), _estimate(a, l, W, _E3)
    v5, v3, along5, along3, v = w5, w3, _ALONG * w5, _ALONG * w3, a[W + l]
    if kind != LINEAR:
        smooth, w, speed = a[M + l] == 1.0, a[NEW + W + l], _quotient(a[RATE + X + l], a[RATE + T + l])
        phi = a[M + l] * _quotient(speed, w)
        acceleration = a[RATE + W + l] * (a[M + l] + phi)
        # The flow carries one in time to one in the state: what counts is the same time.
        t5, t3 = _estimate(a, l, T, _E5), _estimate(a, l, T, _E3)
        x5, x3 = x5 if smooth else fma(-speed, t5, x5), x3 if smooth else fma(-speed, t3, x3)
        v5 = v5 if smooth else fma(phi, w5, -acceleration * t5)
        v3 = v3 if smooth else fma(phi, w3, -acceleration * t3)
        v = v if smooth else _quotient(a[SLOPES + X + l], a[SLOPES + T + l])
    squares5 = fma(x5, x5, fma(v5, v5, along5 * along5))
    squares = squares5 + 0.01 * fma(x3, x3, fma(v3, v3, along3 * along3))
    # Of the old point: a step that has gone wild would excuse itself by the size of what it leads to.
    scale = atol + rtol * np.sqrt(a[X + l] * a[X + l] + v * v)
    # A wild step can overflow one estimate and not the other: it has no quotient that means anything.
    e = abs(a[H + l]) * squares5 / (scale * np.sqrt(squares)) if squares < np.inf else np.inf
    return 0.0 if squares == 0.0 else e


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
