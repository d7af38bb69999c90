"""The tangent frame of a lane: its vectors kept orthonormal, the factor R of the way from the last target on."""

import math

from numba import njit

from ..compiled import compiled
from .block import ETA1, ETA2, LOG1, LOG2, NEW, SHEAR, XI1, XI2


@njit(forceinline=True)
def collapses(a, l):
    """Whether the two tangent vectors at NEW are so close to one direction that digits are about to be lost."""
    xi1, eta1, xi2, eta2 = a[NEW + XI1 + l], a[NEW + ETA1 + l], a[NEW + XI2 + l], a[NEW + ETA2 + l]
    area = xi1 * eta2 - eta1 * xi2
    return area * area < 1e-4 * ((xi1 * xi1 + eta1 * eta1) * (xi2 * xi2 + eta2 * eta2))


@compiled
def log_area(a, l, tangents):
    """Logarithm of the area that both tangent vectors span, which stays positive."""
    area = a[XI1 + l] * a[ETA2 + l] - a[ETA1 + l] * a[XI2 + l] if tangents == 2 else 1.0
    return math.log(area) if area > 0.0 else -math.inf


@compiled
def orthonormalise(a, l, tangents, log_area):
    """Gram and Schmidt: the tangent vectors become orthonormal, the factor R is multiplied onto the frame's."""
    if tangents == 0:
        return
    r11 = math.hypot(a[XI1 + l], a[ETA1 + l])
    r12 = (a[XI1 + l] * a[XI2 + l] + a[ETA1 + l] * a[ETA2 + l]) / r11
    if tangents == 2 and a[LOG2 + l] > -math.inf:
        a[SHEAR + l] += r12 / r11 * math.exp(a[LOG2 + l] - a[LOG1 + l])
        a[LOG2 + l] += log_area - math.log(r11)
    a[LOG1 + l] += math.log(r11)
    a[XI1 + l] /= r11
    a[ETA1 + l] /= r11
    a[XI2 + l], a[ETA2 + l] = -a[ETA1 + l], a[XI1 + l]
