"""The tangent frame of a lane: its vectors kept orthonormal, the factor R of the way from the last target on."""

import math

from vectorized.compiled import inlined, inner
from vectorized.memory import apart
from .block import ETA1, ETA2, FRAME, LOG1, LOG2, NOW, SHEAR, XI1, XI2, lanes


@inlined
def collapses(state, l):
    """Whether the state's two tangent vectors are so close to one direction that digits are about to be lost."""
    xi1, eta1, xi2, eta2 = state[XI1, l], state[ETA1, l], state[XI2, l], state[ETA2, l]
    area = xi1 * eta2 - eta1 * xi2
    return area * area < 1e-4 * ((xi1 * xi1 + eta1 * eta1) * (xi2 * xi2 + eta2 * eta2))


@inner
def log_area(block, l, tangents):
    """Logarithm of the area that both tangent vectors span, which stays positive."""
    apart()
    now = lanes(block, NOW)
    area = now[XI1, l] * now[ETA2, l] - now[ETA1, l] * now[XI2, l] if tangents == 2 else 1.0
    return math.log(area) if area > 0.0 else -math.inf


@inner
def orthonormalise(block, l, tangents, log_area):
    """Gram and Schmidt: the tangent vectors become orthonormal, the factor R is multiplied onto the frame's."""
    apart()
    if tangents == 0:
        return
    now, frame = lanes(block, NOW), lanes(block, FRAME)
    r11 = math.hypot(now[XI1, l], now[ETA1, l])
    r12 = (now[XI1, l] * now[XI2, l] + now[ETA1, l] * now[ETA2, l]) / r11
    if tangents == 2 and frame[LOG2, l] > -math.inf:
        frame[SHEAR, l] += r12 / r11 * math.exp(frame[LOG2, l] - frame[LOG1, l])
        frame[LOG2, l] += log_area - math.log(r11)
    frame[LOG1, l] += math.log(r11)
    now[XI1, l] /= r11
    now[ETA1, l] /= r11
    now[XI2, l], now[ETA2, l] = -now[ETA1, l], now[XI1, l]
