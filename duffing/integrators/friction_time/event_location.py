"""Exact arrival at a time or at w = 0: the step that crosses it is repeated with the length that ends there.

Newton's iteration in the step's length, kept inside a bracket; the last, negligible part of the way is gone by the
tangent to the orbit. Each trial is a step like any other: the lanes beside do not wait.
"""

from vectorized.compiled import inlined, inner
from vectorized.memory import apart
from vectorized.vectors import where
from .block import FAR, LAST, MOVE, NEAR, NEW, NOW, OWNER, SLOPES, STEP, TARGET, H, T, W, lanes


@inlined
def reaches(now, new, owner, c, event):
    """Whether the step to NEW reaches or crosses the target: the time TARGET (event T) or w = 0 (event W)."""
    arrives = abs(new[T, c]) >= abs(owner[TARGET, c]) - _slack(owner[TARGET, c])
    return ((event == T) & arrives) | ((event != T) & (now[W, c] * new[W, c] < 0.0))


@inlined
def _slack(target):
    return 4e-16 * where(abs(target) > 1.0, abs(target), 1.0)


@inner
def locate_event(block, l, event):
    """After a step that crosses, and after each trial: True if it has arrived, else H is the next trial's length."""
    apart()
    now, new, slopes = lanes(block, NOW), lanes(block, NEW), lanes(block, SLOPES)
    step, rate = lanes(block, STEP), slopes[LAST]
    target = lanes(block, OWNER)[TARGET, l] if event == T else 0.0
    miss, slope, h = target - new[event, l], rate[event, l], step[H, l]
    correction, size = miss / slope, 1e-9 * abs(step[MOVE, l])
    exact = abs(miss) <= _slack(target)
    if step[FAR, l] == 0.0:
        if not exact:
            step[NEAR, l], step[FAR, l] = 0.0, h
            step[H, l] = _first_guess(now[event, l] - target, slopes[0, event, l], -miss, slope, h)
            return False
    else:
        if miss * (target - now[event, l]) > 0:
            step[NEAR, l] = h
        else:
            step[FAR, l] = h
        near, far = step[NEAR, l], step[FAR, l]
        if not (exact or abs(correction) <= size or abs(far - near) <= 1e-5 * size):
            step[H, l] = h + correction
            if not min(near, far) < step[H, l] < max(near, far):
                step[H, l] = 0.5 * (near + far)
            return False
    shift = correction if not exact and abs(correction) <= size else 0.0
    for row in range(8):
        now[row, l] = new[row, l] + shift * rate[row, l]
    now[event, l], step[FAR, l], step[H, l] = target, 0.0, step[MOVE, l]
    return True


@inner
def _first_guess(f0, slope0, f1, slope1, h):
    """Zero of the cubic through both ends of the step, by a few Newton steps inside the bracket."""
    apart()
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
