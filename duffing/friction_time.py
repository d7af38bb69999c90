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

from .compiled import compiled

# The parameters of one trajectory, in the order of Duffing.columns(), then m, n and the time where y[T] = 0.
ALPHA, P, MU, OMEGA, DELTA, GAMMA, M, N, START = range(9)
# Its state: x, w, time since START, friction time since START, two tangent vectors (xi, eta).
X, W, T, S, XI1, ETA1, XI2, ETA2 = range(8)

_SMOOTHNESS = 8  # the least m - 1 for which the pair keeps its order at w = 0


def parameters(columns):
    """The kernels' parameters, one row of nine a member, from the oscillator's columns (6, N)."""
    alpha, p = columns[0], columns[1]
    odd = 2 * np.ceil(np.maximum((_SMOOTHNESS + 1) * p - 1, 0) / 2) + 1
    n = np.where(alpha > 0, np.where(p % 2 == 1, p, odd), 1)
    m = np.where((alpha > 0) & (p % 2 != 1), n / p, 1)
    return np.ascontiguousarray(np.concatenate([columns, [m, n, np.zeros_like(m)]]).T)


@compiled
def force(q, x, t):
    """F(x, t): potential force and forcing, t counted from q[START]."""
    return -x * (q[DELTA] + q[GAMMA] * x * x) + q[MU] * math.cos(q[OMEGA] * (q[START] + t))


@compiled
def stiffness(q, x):
    """dF/dx."""
    return -q[DELTA] - 3 * q[GAMMA] * x * x


@compiled
def powers(q, w):
    """phi = dt/ds = m |w|^(m-1) and |w|^(n-1); then v = phi w / m and the damping is alpha |w|^(n-1) w."""
    if q[M] == 1.0:
        return 1.0, 1.0 if q[N] == 1.0 else abs(w) ** (q[N] - 1)
    power = 1.0
    for _ in range(int(q[N]) // 2):
        power *= w * w
    return q[M] * abs(w) ** (q[M] - 1), power


@compiled
def velocity(q, w):
    """v = sign(w) |w|^m."""
    return w if q[M] == 1.0 else math.copysign(abs(w) ** q[M], w)


@compiled
def variable(q, v):
    """w = sign(v) |v|^(1/m)."""
    return v if q[M] == 1.0 else math.copysign(abs(v) ** (1 / q[M]), v)


@compiled
def rate(q, y, tangents, K, row):
    """K[row] = dy/dsigma, with as many tangent vectors as asked."""
    phi, power = powers(q, y[W])
    pace = 1.0 if q[M] == 1.0 else 1 / (q[M] + phi)
    dt = phi * pace
    friction = q[N] * power * pace
    K[row, X] = dt * phi * y[W] / q[M]
    K[row, W] = (force(q, y[X], y[T]) - q[ALPHA] * power * y[W]) * pace
    K[row, T] = dt
    K[row, S] = friction
    if tangents > 0:
        spring, damper = dt * stiffness(q, y[X]), q[ALPHA] * friction
        K[row, XI1] = dt * y[ETA1]
        K[row, ETA1] = spring * y[XI1] - damper * y[ETA1]
        K[row, XI2] = dt * y[ETA2]
        K[row, ETA2] = spring * y[XI2] - damper * y[ETA2]
