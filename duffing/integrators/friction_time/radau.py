"""The creep: one step of an implicit collocation method, in physical time, with the damping force as unknown.

Where |F| < alpha the damping force Y = sign(v) |v|^p relaxes to F / alpha and the mass creeps at the velocity
sign(F) (|F|/alpha)^(1/p), at p = 0.1 practically at rest. The rate of relaxation alpha / phi, phi = dv/dY =
|Y|^(1/p-1) / p, becomes infinite as Y -> 0: friction time diverges, explicit methods crawl. The integrated equations

    x(t) = x0 + integral of v(Y) dt,      v(Y(t)) = v(Y0) + integral of (F(x, t) - alpha Y) dt

hold no singular coefficient when Y is the unknown: at a stage the Jacobian is diag(phi) + h alpha A, which does not
mind phi = 0. The method is Radau's with five stages (order nine, L-stable, exact on the slow branch as its rate goes to
infinity; Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.5). Nothing is held, and
no displacement neglected but the tolerance.

The tangent goes by the derivative of the step, which is right for all but the direction that relaxes: that is damped
like a power of the step where the truth is exp(-alpha S), S = integral of dt / phi. So the area that both vectors
span is to be taken from S, by Liouville's theorem. When Y passes through zero on the slow branch, Y ~ t, and S, the
integral of t^(1-1/p), diverges for p <= 1/2: a tangent direction is annihilated.
"""

import math

import numpy as np

from vectorized.compiled import inlined, inner
from vectorized.memory import matrix, stack
from .block import ALPHA, DELTA, GAMMA, MU, NEW, NOW, OSC, XI1, P, S, T, X, lanes
from .equations import force, stiffness

STAGES = 5
SLOW = 0.3  # near the slow branch |F - alpha Y| is less than this part of the force
_GAUSS = 8


def _lagrange(nodes, z):
    """Values (len(z), len(nodes)) at z of the polynomials that are 1 at one node and 0 at the others."""
    values = np.ones((z.size, nodes.size))
    for j, node in enumerate(nodes):
        for other in np.delete(nodes, j):
            values[:, j] *= (z - other) / (node - other)
    return values


def _integrals(nodes, ends):
    """Integrals (len(ends), len(nodes)) from 0 to the ends of the same polynomials: the quadrature weights."""
    z, weights = np.polynomial.legendre.leggauss(nodes.size)
    return np.array([end / 2 * weights @ _lagrange(nodes, end / 2 * (z + 1)) for end in ends])


def _radau_nodes(stages):
    """Zeros in (0, 1] of P_s - P_(s-1), shifted Legendre polynomials: Radau's nodes, the last of them 1."""
    series = np.zeros(stages + 1)
    series[stages - 1 :] = -1, 1
    return np.append((np.sort(np.polynomial.legendre.legroots(series))[:-1] + 1) / 2, 1.0)


_C = _radau_nodes(STAGES)
_A = _integrals(_C, _C)
_POINTS = np.append(0.0, _C)
# The integral over the step, less the same from the start and the first four stages: the estimate of the error.
_DIFFERENCE = np.append(0.0, _A[-1]) - np.append(_integrals(_POINTS[:-1], np.ones(1))[0], 0.0)
_G, _GW = (np.polynomial.legendre.leggauss(_GAUSS)[0] + 1) / 2, np.polynomial.legendre.leggauss(_GAUSS)[1] / 2
_FINE = _lagrange(_POINTS, _G)


@inner
def radau_step(block, l, Y0, h, tangents, rtol, atol):
    """One step of h > 0 in time of one lane, whose damping force is Y0: NEW (its row W untouched) is the state there.

    Returns the damping force at the end, the estimated error (1 = just tolerable; infinite: the iteration failed), the
    passages of Y through zero (-1 if the force is not zero there: a turn, no creep), the number of force evaluations.
    """
    osc, now, new = lanes(block, OSC), lanes(block, NOW), lanes(block, NEW)
    alpha, p, t = osc[ALPHA, l], osc[P, l], now[T, l]
    r = 1 / p
    Y, v, phi = stack(8), stack(8), stack(8)
    F, x, spring = stack(8), stack(8), stack(8)
    J, rhs, order = matrix(stack(32), STAGES, STAGES), stack(8), stack(8)
    Y[0], x[0] = Y0, now[X, l]
    phi[0] = r * abs(Y0) ** (r - 1)
    v[0] = phi[0] * Y0 / r
    F[0] = force(osc, l, x[0], t)
    for i in range(1, STAGES + 1):
        c = _POINTS[i] * h
        Y[i] = Y0 + (force(osc, l, x[0] + c * v[0], t + c) - F[0]) / alpha
    count, converged = 1 + STAGES, False
    for _ in range(30):
        _stages(osc, l, t, h, r, Y, v, phi, F, x, spring)
        count += STAGES
        largest = 0.0
        for i in range(STAGES):
            residual = v[i + 1] - v[0]
            for j in range(STAGES):
                residual -= h * _A[i, j] * (F[j + 1] - alpha * Y[j + 1])
                mixed = 0.0
                for k in range(STAGES):
                    mixed += _A[i, k] * spring[k + 1] * _A[k, j]
                J[i, j] = h * alpha * _A[i, j] - h * h * mixed * phi[j + 1]
            J[i, i] += phi[i + 1]
            rhs[i] = -residual
            largest = max(largest, abs(Y[i + 1]))
        _factor(J, order)
        _solve(J, order, rhs)
        change = 0.0
        for i in range(STAGES):
            Y[i + 1] += rhs[i]
            change = max(change, abs(rhs[i]))
        if converged or change <= 1e-10 * largest:
            converged = True
            break
        converged = change <= 1e-7 * largest + 1e-300  # the next iterate is then exact to rounding
    if not converged:
        return Y0, math.inf, 0, count
    _stages(osc, l, t, h, r, Y, v, phi, F, x, spring)
    count += STAGES
    new[X, l], new[T, l] = x[STAGES], t + h
    new[S, l] = now[S, l] + _friction_time(p, h, Y)
    passages = _passages(Y)
    slow = SLOW if p < 0.5 else 1.0  # at p = 1/2 the passage is never nearer to the slow branch than its start
    if passages > 0 and (passages != _passages(F) or abs(F[0] - alpha * Y0) > slow * abs(F[0])):
        passages = -1
    for vector in range(tangents):
        row = XI1 + 2 * vector
        xi, eta = now[row, l], now[row + 1, l]
        for i in range(STAGES):
            rhs[i] = eta
            for j in range(STAGES):
                rhs[i] += h * _A[i, j] * spring[j + 1] * xi
        _solve(J, order, rhs)
        new[row, l], new[row + 1, l] = xi, phi[STAGES] * rhs[STAGES - 1]
        for j in range(STAGES):
            new[row, l] += h * _A[STAGES - 1, j] * phi[j + 1] * rhs[j]
    ex, ev = 0.0, 0.0
    for i in range(STAGES + 1):
        ex += h * _DIFFERENCE[i] * v[i]
        ev += h * _DIFFERENCE[i] * (F[i] - alpha * Y[i])
    ev *= phi[STAGES] / (phi[STAGES] + 0.1 * h * alpha)  # the relaxation damps what the estimate sees of it
    scale = atol + rtol * math.hypot(x[0], v[0])  # of the old point, as in dop853
    return Y[STAGES], math.hypot(ex, ev) / scale, passages, count


@inner
def _stages(osc, l, t, h, r, Y, v, phi, F, x, spring):
    """Velocity, phi, position, force and stiffness at the stages (entries 1 to 5) from the damping force Y there."""
    for i in range(1, STAGES + 1):
        phi[i] = r * abs(Y[i]) ** (r - 1)
        v[i] = phi[i] * Y[i] / r
    for i in range(1, STAGES + 1):
        x[i] = x[0]
        for j in range(STAGES):
            x[i] += h * _A[i - 1, j] * v[j + 1]
        F[i] = force(osc, l, x[i], t + _POINTS[i] * h)
        spring[i] = stiffness(osc, l, x[i])


@inner
def _friction_time(p, h, Y):
    """Integral of p |Y|^(1-1/p) over the step; infinite for p <= 1/2 if Y vanishes in it."""
    total, vanishes, logs = 0.0, _passages(Y) > 0, stack(8)
    for i in range(STAGES + 1):
        vanishes = vanishes or Y[i] == 0.0
        logs[i] = math.log(abs(Y[i]))
    if vanishes and p <= 0.5:
        return math.inf
    for g in range(_GAUSS):
        value = 0.0
        for i in range(STAGES + 1):
            value += _FINE[g, i] * (Y[i] if vanishes else logs[i])
        total += h * _GW[g] * p * (abs(value) ** (1 - 1 / p) if vanishes else math.exp((1 - 1 / p) * value))
    return total


@inner
def _passages(values):
    """Sign changes over the step of the polynomial with these values at the start and the stages."""
    count, before = 0, values[0]
    for g in range(_GAUSS + 1):
        value = values[STAGES]
        if g < _GAUSS:
            value = 0.0
            for i in range(STAGES + 1):
                value += _FINE[g, i] * values[i]
        if value * before < 0:
            count += 1
        before = value
    return count


@inner
def _factor(J, order):
    """LU factors of J in place, rows exchanged: row k with order[k]."""
    for k in range(STAGES):
        best = k
        for i in range(k + 1, STAGES):
            if abs(J[i, k]) > abs(J[best, k]):
                best = i
        order[k] = best
        for j in range(STAGES):
            J[k, j], J[best, j] = J[best, j], J[k, j]
        for i in range(k + 1, STAGES):
            J[i, k] /= J[k, k]
            for j in range(k + 1, STAGES):
                J[i, j] -= J[i, k] * J[k, j]


@inner
def _solve(J, order, b):
    """Solve with the factors, in place."""
    for k in range(STAGES):
        best = int(order[k])
        b[k], b[best] = b[best], b[k]
    for k in range(STAGES):
        for j in range(k):
            b[k] -= J[k, j] * b[j]
    for k in range(STAGES - 1, -1, -1):
        for j in range(k + 1, STAGES):
            b[k] -= J[k, j] * b[j]
        b[k] /= J[k, k]


@inlined
def at_rest(osc, l, x, F, Y):
    """Whether force and damping are both below the rounding error of the force: nothing moves that can be computed."""
    alpha = osc[ALPHA, l]
    noise = 1e-13 * (abs(osc[DELTA, l] * x) + abs(osc[GAMMA, l] * x * x * x) + osc[MU, l])
    return (alpha > 0.0) & (abs(F) <= noise) & (alpha * abs(Y) <= noise)
