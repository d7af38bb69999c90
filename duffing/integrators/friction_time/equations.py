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

from vectorized.compiled import inlined, inner
from vectorized.memory import apart, widest_vectors
from vectorized.vectors import fma, repeated, where
from .block import (
    ALPHA, DAMPER, DELTA, ETA1, ETA2, GAMMA, LINEAR, MU, NEW, NOW, OMEGA, OSC, SLOPES, SPRING, START, XI1, XI2, M,
    N, S, T, W, X, eights, lanes,
)  # rows: some lines of names instead of a page  # fmt: skip
from .elementary import cosine, logarithm, power

SMOOTH, ONE_POWER, TWO_POWERS = range(3)  # kinds of blocks: all lanes have m = n = 1; n = 1; neither
_DERIVATIVES = 8  # the least m - 1 for which the pair keeps its order at w = 0


def parameters(columns):
    """The kernels' parameters, one row of nine a member, from the oscillator's columns (6, N)."""
    alpha, p = columns[0], columns[1]
    odd, smooth = 2 * np.ceil(np.maximum((_DERIVATIVES + 1) * p - 1, 0) / 2) + 1, p % 2 == 1
    n = np.where(alpha > 0, np.where(smooth, p, odd), 1)
    m = np.where((alpha > 0) & ~smooth, n / p, 1)
    return np.ascontiguousarray(np.concatenate([columns, [m, n, np.zeros_like(m)]]).T)


@inlined
def force(osc, l, x, t):
    """F(x, t): potential force and forcing, t counted from START."""
    turns = osc[OMEGA, l] * (osc[START, l] + t) * (0.5 / math.pi)
    return fma(-x, fma(osc[GAMMA, l] * x, x, osc[DELTA, l]), osc[MU, l] * cosine(turns))


@inlined
def stiffness(osc, l, x):
    """dF/dx."""
    return -fma(3.0 * osc[GAMMA, l] * x, x, osc[DELTA, l])


@inlined
def powers(osc, l, w, kind):
    """|w|^(m-1) and |w|^(n-1): times w they are v and the damping divided by alpha; phi is m times the first."""
    exponent, mantissa = logarithm(max(abs(w), 2.0**-1022))
    speed = power(exponent, mantissa, osc[M, l] - 1.0)
    return speed, repeated(1.0, w) if kind == ONE_POWER else power(exponent, mantissa, osc[N, l] - 1.0)


@inlined
def velocity(osc, l, w):
    """v = sign(w) |w|^m."""
    return powers(osc, l, w, TWO_POWERS)[0] * w


@inlined
def variable(osc, l, v):
    """w = sign(v) |v|^(1/m), of one lane."""
    exponent, mantissa = logarithm(max(abs(v), 2.0**-1022))
    return v if osc[M, l] == 1.0 or v == 0.0 else math.copysign(power(exponent, mantissa, 1.0 / osc[M, l]), v)


@inlined
def equations_of_motion(osc, state, rate, linear, l, kind):
    """rate = d(S, T, x, w)/dsigma at the state; linear = what the tangents at it need."""
    x, w, m, n = state[X, l], state[W, l], osc[M, l], osc[N, l]
    speed, damping = powers(osc, l, w, kind)
    phi = m * speed
    pace = where(m == 1.0, 1.0, 1.0 / (m + phi))
    dt, friction = phi * pace, n * damping * pace
    rate[S, l] = friction
    rate[X, l] = dt * speed * w
    rate[W, l] = fma(-osc[ALPHA, l] * damping, w, force(osc, l, x, state[T, l])) * pace
    rate[T, l] = dt
    linear[SPRING, l], linear[DAMPER, l] = dt * stiffness(osc, l, x), osc[ALPHA, l] * friction


@inlined
def _linear_equations(osc, state, rate, linear, l):
    """The same where m = n = 1."""
    x, w, one = state[X, l], state[W, l], repeated(1.0, state[W, l])
    rate[S, l], rate[X, l], rate[T, l] = one, w, one
    rate[W, l] = fma(-osc[ALPHA, l], w, force(osc, l, x, state[T, l]))
    linear[SPRING, l], linear[DAMPER, l] = stiffness(osc, l, x), osc[ALPHA, l]


@inlined
def _variational_equations(state, rate, linear, l, xi, eta):
    """The slopes of one tangent vector, rows xi and eta."""
    rate[xi, l] = rate[T, l] * state[eta, l]
    rate[eta, l] = fma(linear[SPRING, l], state[xi, l], -linear[DAMPER, l] * state[eta, l])


@inner
def rates(block, number, stage, tangents, kind):
    """SLOPES of the stage, from NEW, of the first `number` vectors of lanes, with as many tangents as asked."""
    widest_vectors()
    osc, new, linear = eights(block, OSC), eights(block, NEW), eights(block, LINEAR)
    rate = eights(block, SLOPES)[stage]
    if kind == SMOOTH:
        for c in range(number):
            _linear_equations(osc, new, rate, linear, c)
    elif kind == ONE_POWER:
        for c in range(number):
            equations_of_motion(osc, new, rate, linear, c, ONE_POWER)
    else:
        for c in range(number):
            equations_of_motion(osc, new, rate, linear, c, TWO_POWERS)
    if tangents > 0:
        for c in range(number):
            _variational_equations(new, rate, linear, c, XI1, ETA1)
    if tangents > 1:
        for c in range(number):
            _variational_equations(new, rate, linear, c, XI2, ETA2)


@inner
def first_slopes(block, l):
    """SLOPES of stage 0: those of one lane at NOW."""
    apart()
    osc, now, linear = lanes(block, OSC), lanes(block, NOW), lanes(block, LINEAR)
    rate = lanes(block, SLOPES)[0]
    equations_of_motion(osc, now, rate, linear, l, TWO_POWERS)
    _variational_equations(now, rate, linear, l, XI1, ETA1)
    _variational_equations(now, rate, linear, l, XI2, ETA2)
