"""One adaptive step of Dormand and Prince's pair of order 8 with errors of order 5 and 3, in all lanes of a block.

Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), sections II.5 and II.10. The
coefficients are SciPy's. The equations are those of `equations`; nothing here knows the friction.
"""

import numpy as np
from scipy.integrate import DOP853

from vectorized.compiled import inlined, inner
from vectorized.memory import widest_vectors
from vectorized.vectors import fma, repeated, root, where
from .block import (
    ETA1, ETA2, LAST, NEW, NOW, SLOPES, STEP, XI1, XI2, H, M, S, T, W, X, eights,
)  # rows: some lines of names instead of a page  # fmt: skip
from .equations import SMOOTH, rates


def _without_zeros(table):
    """The weights that are not zero, their columns and their number, row by row."""
    columns = [np.flatnonzero(row) for row in table]
    number = np.array([len(c) for c in columns])
    weights, at = np.zeros((len(table), number.max())), np.zeros((len(table), number.max()), dtype=np.uint64)
    for row, c in enumerate(columns):
        weights[row, : len(c)], at[row, : len(c)] = table[row, c], c
    return weights, at, number


_TABLE = np.vstack([DOP853.A, DOP853.B])  # the last row leads to the new point
_WEIGHTS, _FROM, _NUMBER = _without_zeros(_TABLE)
# The rows' sums, added up as `_combine` does: where sigma is time, the slope of T and S is 1 at every stage.
_NODES = np.ascontiguousarray(np.cumsum(_TABLE, axis=1)[:, -1])
_USED = np.flatnonzero((DOP853.E5 != 0) | (DOP853.E3 != 0)).astype(np.uint64)
_E5, _E3 = DOP853.E5[_USED], DOP853.E3[_USED]
# A step's error in w alone displaces the point along its own orbit where time hardly runs; friction time and
# tangents feel it, the state does not, so it counts less.
_ALONG = 0.01


@inner
def step(block, number, tangents, kind):
    """NEW = state after a step of H from NOW, in the first `number` vectors of lanes; SLOPES at all stages.

    Those of stage 0 are there already.
    """
    for stage in range(1, LAST + 1):
        _combine(block, number, stage, tangents, kind)
        rates(block, number, stage, tangents, kind)


@inner
def _combine(block, number, stage, tangents, kind):
    """NEW = NOW + H (the stage's row of the table) SLOPES."""
    widest_vectors()
    now, new, slopes, h = eights(block, NOW), eights(block, NEW), eights(block, SLOPES), eights(block, STEP)[H]
    if kind == SMOOTH:
        for c in range(number):
            new[S, c] = fma(h[c], _NODES[stage], now[S, c])
            new[T, c] = fma(h[c], _NODES[stage], now[T, c])
            x, w = _two(slopes, stage, c, X, W)
            new[X, c], new[W, c] = fma(h[c], x, now[X, c]), fma(h[c], w, now[W, c])
    else:
        for c in range(number):
            t = x = w = repeated(0.0, h[c])
            for k in range(_NUMBER[stage]):
                weight, j = _WEIGHTS[stage, k], _FROM[stage, k]
                t, x, w = (
                    fma(weight, slopes[j, T, c], t),
                    fma(weight, slopes[j, X, c], x),
                    fma(weight, slopes[j, W, c], w),
                )
            new[T, c], new[X, c], new[W, c] = fma(h[c], t, now[T, c]), fma(h[c], x, now[X, c]), fma(h[c], w, now[W, c])
        if stage == LAST:  # friction time acts on nothing: only its end counts
            for c in range(number):
                new[S, c] = fma(h[c], _two(slopes, stage, c, S, S)[0], now[S, c])
    if tangents > 0:
        for c in range(number):
            xi, eta = _two(slopes, stage, c, XI1, ETA1)
            new[XI1, c], new[ETA1, c] = fma(h[c], xi, now[XI1, c]), fma(h[c], eta, now[ETA1, c])
    if tangents > 1:
        for c in range(number):
            xi, eta = _two(slopes, stage, c, XI2, ETA2)
            new[XI2, c], new[ETA2, c] = fma(h[c], xi, now[XI2, c]), fma(h[c], eta, now[ETA2, c])


@inlined
def _two(slopes, stage, c, one, other):
    """The stage's weighted sums of two rows of the slopes."""
    a = b = repeated(0.0, slopes[0, 0, c])
    for k in range(_NUMBER[stage]):
        weight, j = _WEIGHTS[stage, k], _FROM[stage, k]
        a, b = fma(weight, slopes[j, one, c], a), fma(weight, slopes[j, other, c], b)
    return a, b


@inlined
def error(now, new, slopes, osc, step, c, rtol, atol, kind):
    """Estimated error of the step, 1 = just tolerable: of x and v at fixed time, relative to the state's length."""
    x5 = w5 = t5 = x3 = w3 = t3 = repeated(0.0, now[X, c])
    for k in range(_USED.size):
        j, e5, e3 = _USED[k], _E5[k], _E3[k]
        x5, w5, t5 = fma(e5, slopes[j, X, c], x5), fma(e5, slopes[j, W, c], w5), fma(e5, slopes[j, T, c], t5)
        x3, w3, t3 = fma(e3, slopes[j, X, c], x3), fma(e3, slopes[j, W, c], w3), fma(e3, slopes[j, T, c], t3)
    v5, v3, along5, along3, v = w5, w3, _ALONG * w5, _ALONG * w3, now[W, c]
    if kind != SMOOTH:
        rate, m, smooth = slopes[LAST], osc[M, c], osc[M, c] == 1.0
        speed = _quotient(rate[X, c], rate[T, c])
        phi = m * _quotient(speed, new[W, c])
        acceleration = rate[W, c] * (m + phi)
        # The flow carries one in time to one in the state: what counts is the same time.
        x5, x3 = where(smooth, x5, fma(-speed, t5, x5)), where(smooth, x3, fma(-speed, t3, x3))
        v5 = where(smooth, v5, fma(phi, w5, -acceleration * t5))
        v3 = where(smooth, v3, fma(phi, w3, -acceleration * t3))
        v = where(smooth, v, _quotient(slopes[0, X, c], slopes[0, T, c]))
    squares5 = fma(x5, x5, fma(v5, v5, along5 * along5))
    squares = squares5 + 0.01 * fma(x3, x3, fma(v3, v3, along3 * along3))
    # Of the old point: a step that has gone wild would excuse itself by the size of what it leads to.
    scale = atol + rtol * root(now[X, c] * now[X, c] + v * v)
    # A wild step can overflow one estimate and not the other: it has no quotient that means anything.
    e = where(squares < np.inf, abs(step[H, c]) * squares5 / (scale * root(squares)), np.inf)
    return where(squares == 0.0, 0.0, e)


@inlined
def _quotient(a, b):
    return where(b == 0.0, 0.0, a / b)
