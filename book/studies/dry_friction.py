"""The tangency for dry friction, p = 0 exactly: piece by piece, as a differential inclusion.

The damping force is alpha sign(v) where the mass slides, and what keeps it at rest where |F| <= alpha. From one stop to
the next the equation is smooth, and small steps of the classical method of order four follow it; a rest ends when
|F(x, t)| = alpha, a time in closed form. Near the saddle orbit the mass rests in every half period, and a resting mass
has no state but its position. So the positions at rest beside the saddle orbit's are W^U itself, and the manifolds
touch at the least mu at which one of them leads round the well and over the hump. Dimensionless: delta = -1, gamma = 1.
"""

import math

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from duffing import checks
from duffing.errors import ConvergenceError
from vectorized.compiled import compiled

from ..remember import remembered

_BESIDE = (
    0.02  # times alpha: distance of the first position from the saddle orbit's; the last is its image a period later
)
_POSITIONS = 65
_RATIOS = 0.8, 1.05  # mu / mu_c between which the tangency is looked for
_STOPS, _STEP, _LONGEST = 40, 0.004, 100.0


@remembered
def dry_friction_tangency(alpha, omega=1.0):
    """mu_t / mu_c for p = 0, to about 1e-8; alpha, omega : dimensionless, numbers > 0.

    Raises ConvergenceError where there is none from 0.8 to 1.05, or where the mass comes to rest for ever.
    """
    alpha, omega = checks.positive("alpha", alpha), checks.positive("omega", omega)
    mu_c = 2 * alpha * np.cosh(np.pi * omega / 2) / (np.pi * omega)  # Eq. 13 as p goes to zero
    low, high = _RATIOS
    if not _highest(alpha, low * mu_c, omega) < 0 < _highest(alpha, high * mu_c, omega):
        raise ConvergenceError(f"alpha = {alpha}, omega = {omega}: no tangency at mu from {low} to {high} mu_c")
    return brentq(lambda ratio: _highest(alpha, ratio * mu_c, omega), low, high, xtol=1e-9)


def _highest(alpha, mu, omega):
    """The greatest height of W^U over the hump, see `height`."""
    start, beside = -np.pi / 2 / omega, _BESIDE * alpha
    saddle = brentq(lambda x: _stop(alpha, mu, omega, x, start)[0] + x, -alpha, 0.0, xtol=1e-15)
    image = _stop(alpha, mu, omega, *_stop(alpha, mu, omega, saddle + beside, start))[0]
    stretch = (image - saddle) / beside

    def depth(place):
        return -height(alpha, mu, omega, saddle + beside * stretch**place)

    places = np.linspace(0, 1, _POSITIONS)
    best = places[np.argmin([depth(place) for place in places])]
    bounds = best - places[1], best + places[1]
    return -minimize_scalar(depth, bounds=bounds, method="bounded", options={"xatol": 1e-7}).fun


def _stop(*arguments):
    found = next_stop(*arguments)
    if not np.isfinite(found[1]):
        raise ConvergenceError("alpha = {}, mu = {}, omega = {}: at x = {} the mass rests for ever".format(*arguments))
    return found


@compiled
def height(alpha, mu, omega, x):
    """exp(-t), t the time that the orbit from rest at x takes from its first turn in a well to its next; positive if
    that is in the other well, beyond the hump, and zero where it stays on the hump."""
    t, first = -0.5 * math.pi / omega, math.inf
    for _ in range(_STOPS):
        x, t = next_stop(alpha, mu, omega, x, t)
        if first < math.inf and abs(x) > 0.9:
            return -math.copysign(math.exp(first - t), x)
        if x > 1.0:
            first = t
    return 0.0


@compiled
def next_stop(alpha, mu, omega, x, t):
    """Position and time at which the mass stops next that is at rest at x at the time t (infinite: never)."""
    t, direction = _release(alpha, mu, omega, x, t)
    v, end = 0.0, t + _LONGEST
    while t < end:
        x1, v1 = _slide(alpha * direction, mu, omega, x, v, t, _STEP)
        if v1 * direction <= 0.0:
            near, far = 0.0, _STEP  # of a step that ends with v = 0
            while far - near > 1e-15:
                h = 0.5 * (near + far)
                if _slide(alpha * direction, mu, omega, x, v, t, h)[1] * direction > 0.0:
                    near = h
                else:
                    far = h
            return _slide(alpha * direction, mu, omega, x, v, t, far)[0], t + far
        x, v, t = x1, v1, t + _STEP
    return x, math.inf


@compiled
def _slide(friction, mu, omega, x, v, t, h):
    """One step of h under the constant friction."""
    a = x - x**3 + mu * math.cos(omega * t) - friction
    x1, v1 = x + 0.5 * h * v, v + 0.5 * h * a
    middle = mu * math.cos(omega * (t + 0.5 * h)) - friction
    a1 = x1 - x1**3 + middle
    x2, v2 = x + 0.5 * h * v1, v + 0.5 * h * a1
    a2 = x2 - x2**3 + middle
    x3, v3 = x + h * v2, v + h * a2
    a3 = x3 - x3**3 + mu * math.cos(omega * (t + h)) - friction
    return x + h / 6 * (v + 2 * v1 + 2 * v2 + v3), v + h / 6 * (a + 2 * a1 + 2 * a2 + a3)


@compiled
def _release(alpha, mu, omega, x, t):
    """When the mass at rest at x begins to slide, from the time t on (infinite: never), and in which direction."""
    spring = x - x**3
    force = spring + mu * math.cos(omega * t)
    if abs(force) > alpha:
        return t, math.copysign(1.0, force)
    first, way = math.inf, 1.0
    for direction in (1.0, -1.0):
        cosine = (direction * alpha - spring) / mu
        if abs(cosine) < 1.0:
            phase = -direction * math.acos(cosine)  # where the force grows in that direction
            when = t + (phase - omega * t) % (2 * math.pi) / omega
            if when < first:
                first, way = when, direction
    return first, way
