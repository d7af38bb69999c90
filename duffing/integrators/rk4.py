"""The paper's own algorithm: classical fourth-order Runge-Kutta with constant step, many trajectories side by side.

x' = v,  v' = mu cos(omega t) - delta x - gamma x^3 - alpha v |v|^(p-1), and with it up to two tangent vectors
xi' = eta,  eta' = -(delta + 3 gamma x^2) xi - alpha p |v|^(p-1) eta.

All arithmetic that feeds back into a solution is spelled out in operations that IEEE 754 fixes, so its bits do not
depend on the machine, on threads or on the family that a member belongs to: in chaos nothing less is reproducible.
"""

import os

import numpy as np
from numba import carray, njit

from .. import checks
from ..errors import DivergedError
from .compiled import compiled
from .forcing import in_blocks
from .powers import evaluate, fma
from .solution import Orbit
from .vectors import stack, widest_vectors

# Trajectories of a block (its rows stay in the first-level cache) and of an inner loop (the widest vector of doubles).
LANES, WIDTH = 64, 8
# Steps after which tangents are made orthonormal, so that nothing over- or underflows in a long interval.
BETWEEN = 50

# Rows of a block's workspace: the state and tangents at the start of the step, at the stage, and the sum of slopes;
# then the step, the parameters, and the tangents as last made orthonormal.
_X, _V, _TANGENT = 0, 1, 2
_START, _STAGE, _SUM = 0, 6, 12
_H, _ALPHA, _P, _MU, _DELTA, _GAMMA, _Q = 18, 19, 20, 21, 22, 23, 24
_ROWS = 28
_BLOCK = _ROWS * LANES


def integrate(osc, state, t, tangents=0, steps_per_period=500, threads=None):
    """Solutions at the times t by Runge-Kutta steps of at most 2 pi / (omega steps_per_period).

    Parameters
    ----------
    osc : Duffing, a single oscillator or a family of N members
    state : (2,), (2, *family) or (2, N), (x, v) at t[0]
    t : (n,) for all members or (n, N), increasing times; each interval is cut into the least number of equal steps
    tangents : 0, 1 or 2 tangent vectors, made orthonormal at every time
    threads : at most so many at once (default: the processors)

    Returns
    -------
    Orbit : states (2, n, N), growth (tangents, n - 1, N), propagators (2, 2, n - 1, N) for two tangents

    Raises
    ------
    ValueError : for invalid input
    DivergedError : when a solution or a tangent is not finite

    For p < 1 a member at exact rest (mu = 0, v = 0, no force) has growth 0 and -inf, propagator diag(1, 0). Close to
    rest the damping outruns an explicit step: growth is then the scheme's own, not the flow's.
    """
    columns, state, t, steps_per_period, threads = checked(osc, state, t, steps_per_period, threads)
    tangents = checks.count("tangents", tangents, least=0)
    if tangents > 2:
        raise ValueError(f"tangents = {tangents}: must be 0, 1 or 2")
    n, size = len(t), columns.shape[1]
    states, growth = np.empty((2, n, size)), np.zeros((tangents, n - 1, size))
    propagators = np.tile(np.eye(2)[:, :, None, None], (n - 1, size)) if tangents == 2 else np.empty((0, 0, 0, 0))

    def run(members, padded, h, law, forcing):
        start = (columns[:, padded], state[:, padded], h)
        advance(*start, *forcing, law, (0,) * tangents, members, states, growth, propagators)

    in_blocks(run, columns, t, steps_per_period, threads, LANES, WIDTH)
    rest = _rests(columns, state)
    growth[..., rest] = 0.0
    if tangents == 2:
        propagators[..., rest] = np.diag([1.0, 0.0])[:, :, None, None]
    check_finite(columns, states, growth, propagators)
    growth[1:, :, rest] = -np.inf
    return Orbit(states, growth, propagators if tangents == 2 else None)


def checked(osc, state, t, steps_per_period, threads):
    """The arguments of `integrate` as columns (6, N), state (2, N), t (n, 1) or (n, N), and two whole numbers."""
    columns = osc.columns()
    size = columns.shape[1]
    state = checks.state(state, (size,) if np.shape(state) == (2, size) else osc.shape)
    if np.ndim(t) == 2 and np.shape(t)[1] == size and size > 0:
        t = np.stack([checks.times(column) for column in np.transpose(t)], axis=1)
    else:
        t = checks.times(t)[:, None]
    threads = os.cpu_count() if threads is None else checks.count("threads", threads)
    return columns, state, t, checks.count("steps_per_period", steps_per_period), threads


def check_finite(columns, *results):
    """Raise DivergedError, with the parameters of the first such member, unless all results (..., N) are finite."""
    bad = ~np.all([np.isfinite(r).all(axis=tuple(range(r.ndim - 1))) for r in results if r.size], axis=0)
    if np.any(bad):
        names = ("alpha", "p", "mu", "omega", "delta", "gamma")
        first = ", ".join(f"{n} = {v:g}" for n, v in zip(names, columns[:, bad.argmax()], strict=True))
        raise DivergedError(f"{bad.sum()} of {bad.size} solutions or tangents are not finite; the first has {first}")


def _rests(columns, state):
    """Members at exact rest whose damping has an infinite slope there (p < 1), so that no step follows their tangents.

    The derivative of the flow is known: a small xi creeps back at a speed of order |xi|^(1/p), a small eta stops after
    a way of order |eta|^(2-p). Both are of higher than first order: xi stays as it is, and of eta nothing is left.
    """
    (alpha, p, mu, _, delta, gamma), (x, v) = columns, state
    return (p < 1) & (alpha > 0) & (mu == 0) & (v == 0) & ((delta + gamma * x * x) * x == 0)


@compiled
def advance(columns, state, h, cosines, offsets, counts, law, basis, members, states, growth, propagators):
    """Advance one block through all intervals. law: None for p = 1; basis: a tuple as long as there are tangents.

    growth comes in as zeros, propagators as identities.
    """
    widest_vectors()
    blocks = carray(stack(_BLOCK), (LANES // WIDTH, _ROWS, WIDTH))[: state.shape[1] // WIDTH]
    for lane in range(state.shape[1]):
        b, l = blocks[lane // WIDTH], lane % WIDTH
        b[_X, l], b[_V, l] = state[0, lane], state[1, lane]
        b[_ALPHA, l], b[_P, l], b[_MU, l] = columns[0, lane], columns[1, lane], columns[2, lane]
        b[_DELTA, l], b[_GAMMA, l] = columns[4, lane], columns[5, lane]
        for j in range(len(basis)):
            for i in range(2):
                b[_TANGENT + 2 * j + i, l] = b[_Q + 2 * j + i, l] = 1.0 if i == j else 0.0
    for lane, member in enumerate(members):
        states[0, 0, member], states[1, 0, member] = state[0, lane], state[1, lane]
    for i in range(len(counts)):
        for lane in range(state.shape[1]):
            blocks[lane // WIDTH, _H, lane % WIDTH] = h[i, lane]
        at, end = offsets[i], offsets[i] + 2 * counts[i]
        while at < end:
            for now in range(at, min(at + 2 * BETWEEN, end), 2):
                _step(blocks, law, basis, cosines[now], cosines[now + 1], cosines[now + 2])
            at += 2 * BETWEEN
            for lane, member in enumerate(members):
                if len(basis) == 2:
                    _propagate(blocks[lane // WIDTH], lane % WIDTH, propagators, i, member)
                if len(basis) > 0:
                    _orthonormalise(blocks[lane // WIDTH], lane % WIDTH, basis, growth, i, member)
        for lane, member in enumerate(members):
            b, l = blocks[lane // WIDTH], lane % WIDTH
            states[0, i + 1, member], states[1, i + 1, member] = b[_X, l], b[_V, l]


@njit(forceinline=True)
def _step(blocks, law, basis, c0, c1, c2):
    """y <- y + h/6 (k1 + 2 k2 + 2 k3 + k4) in every lane; c0, c1, c2: cos(omega t) at the start, middle and end.

    Without a power the whole step stays in registers. With one, the lanes are the inner loop of each stage: many
    powers are then under way at once, instead of four that wait for one another.
    """
    if law is None:
        for c in range(len(blocks)):
            for l in range(WIDTH):
                _stage(blocks[c], l, law, basis, c0, _START, 1.0, 0.5)
                _stage(blocks[c], l, law, basis, c1, _STAGE, 2.0, 0.5)
                _stage(blocks[c], l, law, basis, c1, _STAGE, 2.0, 1.0)
                _stage(blocks[c], l, law, basis, c2, _STAGE, 1.0, 0.0)
    else:
        for c in range(len(blocks)):
            for l in range(WIDTH):
                _stage(blocks[c], l, law, basis, c0, _START, 1.0, 0.5)
        for c in range(len(blocks)):
            for l in range(WIDTH):
                _stage(blocks[c], l, law, basis, c1, _STAGE, 2.0, 0.5)
        for c in range(len(blocks)):
            for l in range(WIDTH):
                _stage(blocks[c], l, law, basis, c1, _STAGE, 2.0, 1.0)
        for c in range(len(blocks)):
            for l in range(WIDTH):
                _stage(blocks[c], l, law, basis, c2, _STAGE, 1.0, 0.0)


@njit(forceinline=True)
def _stage(b, l, law, basis, cosine, at, weight, ahead):
    """Slope k at the rows `at`; sum += weight k; next argument = start + ahead h k (ahead = 0: the step's end)."""
    x, v = b[at + _X, l], b[at + _V, l]
    stiffness = b[_GAMMA, l] * x * x
    # |v|^(p-1), the costly part, serves the damping v |v|^(p-1) and the tangent's p |v|^(p-1).
    friction = b[_ALPHA, l] if law is None else b[_ALPHA, l] * evaluate(v, law)
    force = fma(-(b[_DELTA, l] + stiffness), x, b[_MU, l] * cosine)
    _use(b, l, _X, v, at, weight, ahead)
    _use(b, l, _V, fma(-friction, v, force), at, weight, ahead)
    slope = friction if law is None else b[_P, l] * friction
    for j in range(len(basis)):
        row = _TANGENT + 2 * j
        xi, eta = b[at + row, l], b[at + row + 1, l]
        _use(b, l, row, eta, at, weight, ahead)
        _use(b, l, row + 1, fma(-slope, eta, -fma(3.0, stiffness, b[_DELTA, l]) * xi), at, weight, ahead)


@njit(forceinline=True)
def _use(b, l, row, k, at, weight, ahead):
    """Enter one component's slope k into the sum and into the next stage's argument or, at the last stage, the step."""
    total = k if at == _START else fma(weight, k, b[_SUM + row, l])
    if ahead == 0.0:
        b[row, l] = fma(b[_H, l] * (1.0 / 6.0), total, b[row, l])
    else:
        b[_SUM + row, l] = total
        b[_STAGE + row, l] = fma(b[_H, l] * ahead, k, b[row, l])


@njit(forceinline=True)
def _propagate(b, l, propagators, i, member):
    """Propagator <- W Q^T propagator: W are the tangents now, Q what they were when last made orthonormal."""
    for j in range(2):
        x, v = propagators[0, j, i, member], propagators[1, j, i, member]
        first = b[_Q, l] * x + b[_Q + 1, l] * v
        second = b[_Q + 2, l] * x + b[_Q + 3, l] * v
        for k in range(2):
            propagators[k, j, i, member] = b[_TANGENT + k, l] * first + b[_TANGENT + 2 + k, l] * second


@njit(forceinline=True)
def _orthonormalise(b, l, basis, growth, i, member):
    """Gram-Schmidt: the tangents become orthonormal, the logarithms of the diagonal of R are added to growth."""
    xi, eta = b[_TANGENT, l], b[_TANGENT + 1, l]
    length = np.sqrt(xi * xi + eta * eta)
    xi, eta = xi / length, eta / length
    growth[0, i, member] += np.log(length)
    b[_TANGENT, l], b[_TANGENT + 1, l] = xi, eta
    b[_Q, l], b[_Q + 1, l] = xi, eta
    if len(basis) == 2:
        # In the plane the second direction is known: at right angles to the first, on the second vector's side.
        height = xi * b[_TANGENT + 3, l] - eta * b[_TANGENT + 2, l]
        side = 1.0 if height >= 0.0 else -1.0
        growth[1, i, member] += np.log(abs(height))
        b[_TANGENT + 2, l], b[_TANGENT + 3, l] = -side * eta, side * xi
        b[_Q + 2, l], b[_Q + 3, l] = -side * eta, side * xi
