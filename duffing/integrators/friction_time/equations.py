"""The equations of motion in a variable that makes every crossing of v = 0 smooth (friction time).

For 0 < p < 1 the damping alpha v |v|^(p-1) is not Lipschitz at v = 0. Take instead w, and let time run at
the pace phi:

    v = sign(w) |w|^m,    dt/ds = phi(w) = m |w|^(m-1),    m = n / p,   n an odd whole number.
    dx/ds = phi v,        dw/ds = F(x, t) - alpha w^n,     F = -delta x - gamma x^3 + mu cos(omega t)

The damping is then a polynomial, whatever p. With n = 1, w is the damping force divided by alpha and s is friction
time itself; a larger n is needed when 1/p - 1 is small, because phi has only m - 1 derivatives at w = 0 and a
pair of order eight wants all of them. The tangent (xi, eta) = (dx, dv) at fixed t loses its singularity:

    dxi/ds = phi eta,     deta/ds = phi F_x xi - alpha n |w|^(n-1) eta,     dS/ds = n |w|^(n-1),

S being friction time, the integral of p |v|^(p-1) dt: the tangent map contracts areas by exp(-alpha S) exactly.
The independent variable of the integration is sigma, ds = dsigma / (m + phi), for an even pace: time where v is
large, friction time where v is small. Where the damping is smooth in v (p = 1, 3, 5 ... or alpha = 0), m = 1, n = p
and sigma is time: the same code. Other p > 1 gain from the variable w, too: v |v|^(p-1) is not smooth at v = 0.
"""

import math

import numpy as np
from numba import njit

from ..compiled import compiled
from ..powers import fma
from ..vectors import widest_vectors
from .block import (
    ALPHA,
    DAMPER,
    DELTA,
    GAMMA,
    MU,
    NEW,
    OMEGA,
    RATE,
    SLOPES,
    SPRING,
    START,
    STATE,
    WIDTH,
    XI1,
    XI2,
    M,
    N,
    S,
    T,
    W,
    X,
)
from .elementary import cosine, logarithm, power

LINEAR, ONE_POWER, TWO_POWERS = range(3)  # kinds of blocks: all lanes have m = n = 1; n = 1; neither
_SMOOTHNESS = 8  # the least m - 1 for which the pair keeps its order at w = 0


def parameters(columns):
    """The kernels' parameters, one row of nine a member, from the oscillator's columns (6, N)."""
    alpha, p = columns[0], columns[1]
    odd, smooth = 2 * np.ceil(np.maximum((_SMOOTHNESS + 1) * p - 1, 0) / 2) + 1, p % 2 == 1
    n = np.where(alpha > 0, np.where(smooth, p, odd), 1)
    m = np.where((alpha > 0) & ~smooth, n / p, 1)
    return np.ascontiguousarray(np.concatenate([columns, [m, n, np.zeros_like(m)]]).T)


@njit(forceinline=True)
def force(a, l, x, t):
    """F(x, t): potential force and forcing, t counted from START."""
    turns = a[OMEGA + l] * (a[START + l] + t) * (0.5 / math.pi)
    return fma(-x, fma(a[GAMMA + l] * x, x, a[DELTA + l]), a[MU + l] * cosine(turns))


@njit(forceinline=True)
def stiffness(a, l, x):
    """dF/dx."""
    return -fma(3.0 * a[GAMMA + l] * x, x, a[DELTA + l])


@njit(forceinline=True)
def powers(a, l, w, kind):
    """|w|^(m-1) and |w|^(n-1): times w they are v and the damping divided by alpha; phi is m times the first."""
    if kind == LINEAR:
        return 1.0, 1.0
    exponent, mantissa = logarithm(max(abs(w), 2.0**-1022))
    speed = power(exponent, mantissa, a[M + l] - 1.0)
    return speed, 1.0 if kind == ONE_POWER else power(exponent, mantissa, a[N + l] - 1.0)


@compiled
def velocity(a, l, w):
    """v = sign(w) |w|^m."""
    return powers(a, l, w, TWO_POWERS)[0] * w


@compiled
def variable(a, l, v):
    """w = sign(v) |v|^(1/m)."""
    exponent, mantissa = logarithm(max(abs(v), 2.0**-1022))
    return v if a[M + l] == 1.0 or v == 0.0 else math.copysign(power(exponent, mantissa, 1.0 / a[M + l]), v)


@njit(forceinline=True)
def _slopes(a, l, at, kind):
    """RATE = d(S, t, x, w)/dsigma of one lane whose state is at the rows `at`."""
    x, w = a[at + X + l], a[at + W + l]
    m, n = (1.0, 1.0) if kind == LINEAR else (a[M + l], a[N + l])
    speed, damping = powers(a, l, w, kind)
    phi = m * speed
    pace = 1.0 if m == 1.0 else 1.0 / (m + phi)
    dt, friction = phi * pace, n * damping * pace
    a[RATE + S + l] = friction
    a[RATE + X + l] = dt * speed * w
    a[RATE + W + l] = fma(-a[ALPHA + l] * damping, w, force(a, l, x, a[at + T + l])) * pace
    a[RATE + T + l] = dt
    a[SPRING + l], a[DAMPER + l] = dt * stiffness(a, l, x), a[ALPHA + l] * friction


@njit(forceinline=True)
def _tangent_slopes(a, l, at, xi):
    """The same of one tangent vector, rows xi and behind; needs the rows SPRING and DAMPER."""
    eta = xi + WIDTH
    a[RATE + xi + l] = a[RATE + T + l] * a[at + eta + l]
    a[RATE + eta + l] = fma(a[SPRING + l], a[at + xi + l], -a[DAMPER + l] * a[at + eta + l])


@compiled
def rates(a, eights, tangents, kind):
    """RATE = the slopes at NEW of the first eights * 8 lanes, with as many tangent vectors as asked."""
    widest_vectors()
    if kind == LINEAR:
        for l in range(8 * eights):
            _slopes(a, l, NEW, LINEAR)
    elif kind == ONE_POWER:
        for l in range(8 * eights):
            _slopes(a, l, NEW, ONE_POWER)
    else:
        for l in range(8 * eights):
            _slopes(a, l, NEW, TWO_POWERS)
    if tangents > 0:
        for l in range(8 * eights):
            _tangent_slopes(a, l, NEW, XI1)
    if tangents > 1:
        for l in range(8 * eights):
            _tangent_slopes(a, l, NEW, XI2)


@compiled
def rate(a, l, tangents):
    """The slopes of one lane at its state, as first stage of its next step."""
    _slopes(a, l, 0, TWO_POWERS)
    for vector in range(tangents):
        _tangent_slopes(a, l, 0, XI1 + 2 * WIDTH * vector)
    for row in range(S, STATE, WIDTH):
        a[SLOPES + row + l] = a[RATE + row + l]
