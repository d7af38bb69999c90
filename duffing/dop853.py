"""One adaptive step of Dormand and Prince's pair of order 8 with errors of order 5 and 3, and exact landing.

Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), sections II.5 and II.10. The
coefficients are SciPy's. The equations are those of `friction_time`; nothing here knows the friction.
"""

import math

import numpy as np
from scipy.integrate import DOP853

from .compiled import compiled
from .friction_time import ETA1, ETA2, XI1, XI2, M, S, T, W, X, rate

STAGES = 13  # twelve, and the rate at the new point, which is the first stage of the next step
_TABLE = np.vstack([DOP853.A, DOP853.B])  # the last row leads to the new point
_E3, _E5 = np.ascontiguousarray(DOP853.E3), np.ascontiguousarray(DOP853.E5)
# A step's error in w alone displaces the point along its own orbit where time hardly runs; friction time and
# tangents feel it, the state does not, so it counts less.
_ALONG = 0.01


@compiled
def advance(q, y, h, tangents, K, new):
    """new = y after a step h in sigma. K (13, 8) holds the rate at y in K[0]; its other rows are overwritten."""
    for stage in range(1, 12):
        _combine(y, h, stage, tangents, K, new)
        rate(q, new, tangents, K, stage)
    _combine(y, h, 12, tangents, K, new)
    rate(q, new, tangents, K, 12)


@compiled
def _combine(y, h, stage, tangents, K, new):
    """new = y + h (the stage's row of the table) K. The sums are spelled out so that they stay in registers."""
    x, w, t, s = 0.0, 0.0, 0.0, 0.0
    for j in range(stage):
        a = _TABLE[stage, j]
        x += a * K[j, X]
        w += a * K[j, W]
        t += a * K[j, T]
        s += a * K[j, S]
    new[X], new[W], new[T], new[S] = y[X] + h * x, y[W] + h * w, y[T] + h * t, y[S] + h * s
    if tangents > 0:
        x, w, t, s = 0.0, 0.0, 0.0, 0.0
        for j in range(stage):
            a = _TABLE[stage, j]
            x += a * K[j, XI1]
            w += a * K[j, ETA1]
            t += a * K[j, XI2]
            s += a * K[j, ETA2]
        new[XI1], new[ETA1] = y[XI1] + h * x, y[ETA1] + h * w
        new[XI2], new[ETA2] = y[XI2] + h * t, y[ETA2] + h * s


@compiled
def error(q, y, new, h, K, rtol, atol):
    """Estimated error of the step, 1 = just tolerable: of x and v at fixed time, relative to the state's length."""
    v = K[12, X] / K[12, T] if K[12, T] > 0.0 else 0.0
    phi = q[M] * v / new[W] if new[W] != 0.0 else 1.0 * (q[M] == 1.0)
    acceleration = K[12, W] * (1.0 if q[M] == 1.0 else q[M] + phi)
    # Of the old point: a step that has gone wild would excuse itself by the size of what it leads to.
    scale = atol + rtol * math.hypot(y[X], K[0, X] / K[0, T] if K[0, T] > 0.0 else 0.0)
    squares5, squares3 = 0.0, 0.0
    for order in (5, 3):
        ex, ew, et = 0.0, 0.0, 0.0
        for j in range(13):
            weight = _E5[j] if order == 5 else _E3[j]
            ex += weight * K[j, X]
            ew += weight * K[j, W]
            et += weight * K[j, T]
        # The flow carries an error in time to one in the state: what counts is the state at the same time.
        total = (ex - v * et) ** 2 + (phi * ew - acceleration * et) ** 2 + (_ALONG * ew) ** 2
        if order == 5:
            squares5 = total
        else:
            squares3 = total
    if squares5 == 0.0 and squares3 == 0.0:
        return 0.0
    return abs(h) / scale * squares5 / math.sqrt(squares5 + 0.01 * squares3)


@compiled
def land(q, y, h, tangents, component, target, K, new):
    """Repeat the step with the length h* in (0, h] that makes y[component] = target (it lies between y and new).

    Newton's iteration in the step's length, kept inside a bracket. The last, negligible part of the way is gone by the
    tangent to the orbit. Returns the number of rates evaluated; new and K[12] are those at the target.
    """
    near, far = 0.0, h
    length = _first_guess(y[component] - target, K[0, component], new[component] - target, K[12, component], h)
    evaluations = 1
    for _ in range(60):
        advance(q, y, length, tangents, K, new)
        evaluations += 12
        miss = target - new[component]
        slope = K[12, component]
        if miss * (target - y[component]) > 0:
            near = length
        else:
            far = length
        correction = miss / slope
        if abs(miss) <= 4e-16 * max(1.0, abs(target)) or abs(far - near) <= 1e-14 * abs(h):
            break
        if abs(correction) <= 1e-9 * abs(h):
            for d in range(y.size):
                new[d] += correction * K[12, d]
            length += correction
            break
        trial = length + correction
        if not min(near, far) < trial < max(near, far):
            trial = 0.5 * (near + far)
        length = trial
    new[component] = target
    rate(q, new, tangents, K, 12)
    return evaluations


@compiled
def _first_guess(f0, slope0, f1, slope1, h):
    """Zero of the cubic through both ends of the step, by a few Newton steps inside the bracket."""
    near, far = 0.0, 1.0
    z = f0 / (f0 - f1)
    for _ in range(8):
        value = (1 + 2 * z) * (1 - z) ** 2 * f0 + z * (1 - z) ** 2 * h * slope0
        value += z * z * (3 - 2 * z) * f1 - z * z * (1 - z) * h * slope1
        if value * f0 > 0:
            near = z
        else:
            far = z
        slope = 6 * z * (1 - z) * (f1 - f0) + (1 - z) * (1 - 3 * z) * h * slope0 - z * (2 - 3 * z) * h * slope1
        trial = z - value / slope
        z = trial if near < trial < far else 0.5 * (near + far)
    return z * h
