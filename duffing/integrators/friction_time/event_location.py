"""Exact arrival at a time or at w = 0: the step that crosses it is repeated with the length that ends there.

Newton's iteration in the step's length, kept inside a bracket; the last, negligible part of the way is gone by the
tangent to the orbit. Each trial is a step like any other: the lanes beside do not wait.
"""

from numba import njit

from ..compiled import compiled
from .block import FAR, MOVE, NEAR, NEW, RATE, SLOPES, STATE, TARGET, WIDTH, H, T, W
from .equations import rate


@njit(forceinline=True)
def crosses(a, l, component):
    """Whether the step to NEW reaches or crosses the target: the time TARGET (component T) or w = 0 (component W)."""
    if component == T:
        return abs(a[NEW + T + l]) >= abs(a[TARGET + l]) - _slack(a[TARGET + l])
    return a[W + l] * a[NEW + W + l] < 0.0


@njit(forceinline=True)
def _slack(target):
    return 4e-16 * max(1.0, abs(target))


@compiled
def land(a, l, component, tangents):
    """After a step that crosses, and after each trial: True if it has arrived, else H is the next trial's length."""
    target = a[TARGET + l] if component == T else 0.0
    miss, slope, h = target - a[NEW + component + l], a[RATE + component + l], a[H + l]
    correction, size = miss / slope, 1e-9 * abs(a[MOVE + l])
    exact = abs(miss) <= _slack(target)
    if a[FAR + l] == 0.0:
        if not exact:
            a[NEAR + l], a[FAR + l] = 0.0, h
            a[H + l] = _first_guess(a[component + l] - target, a[SLOPES + component + l], -miss, slope, h)
            return False
    else:
        if miss * (target - a[component + l]) > 0:
            a[NEAR + l] = h
        else:
            a[FAR + l] = h
        near, far = a[NEAR + l], a[FAR + l]
        if not (exact or abs(correction) <= size or abs(far - near) <= 1e-5 * size):
            a[H + l] = h + correction
            if not min(near, far) < a[H + l] < max(near, far):
                a[H + l] = 0.5 * (near + far)
            return False
    shift = correction if not exact and abs(correction) <= size else 0.0
    for row in range(0, STATE, WIDTH):
        a[row + l] = a[NEW + row + l] + shift * a[RATE + row + l]
    a[component + l], a[FAR + l], a[H + l] = target, 0.0, a[MOVE + l]
    rate(a, l, tangents)
    return True


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
