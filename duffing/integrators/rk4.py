"""The paper's own algorithm: classical fourth-order Runge-Kutta with constant step, many trajectories side by side.

x' = v,  v' = mu cos(omega t) - delta x - gamma x^3 - alpha v |v|^(p-1), and with it up to two tangent vectors
xi' = eta,  eta' = -(delta + 3 gamma x^2) xi - alpha p |v|^(p-1) eta.

All arithmetic that feeds back into a solution is spelled out in operations that IEEE 754 fixes, so its bits do not
depend on the machine, on threads or on the family that a member belongs to: in chaos nothing less is reproducible.
"""

import math

import numpy as np

from vectorized import processors
from vectorized.compiled import compiled, inlined
from vectorized.memory import stack, views, widest_vectors
from vectorized.vectors import EIGHT, fma, root, where

from .. import checks
from ..errors import DivergedError
from ..oscillator import Duffing
from .forcing import map_chunks
from .powers import evaluate
from .solution import Solution

LANES = 64  # trajectories of a block: its rows stay in the first-level cache
# Steps after which tangents are made orthonormal, so that nothing over- or underflows in a long interval.
BETWEEN = 50

# A block in parts, each of some rows: the state with its tangents at the start of a step, where slopes are asked for,
# and the sum of slopes; the parameters and the step; the tangents as last made orthonormal, and how long they were.
NOW, STAGE, SUM, OSC, FRAME, LENGTHS = range(6)
PARTS = ((6,), (6,), (6,), (6,), (4,), (2,))
X, V, XI1, ETA1, XI2, ETA2 = range(6)
ALPHA, P, MU, DELTA, GAMMA, H = range(6)
BLOCK = LANES * sum(map(math.prod, PARTS))
lanes, eights = views(PARTS, LANES)


def integrate(osc, state, t, tangents=0, steps_per_period=500, threads=None):
    """Solutions at the times t by Runge-Kutta steps of at most 2 pi / (omega steps_per_period).

    Parameters
    ----------
    osc : Duffing, a single oscillator or a family of N members
    state : (2,), (2, *family) or (2, N), (x, v) at t[0]
    t : (n,) for all members or (n, N), increasing times; each interval is cut into the least number of equal steps
    tangents : 0, 1 or 2 tangent vectors, made orthonormal at every time
    threads : at most so many at once (default: the processors that the process may use)

    Returns
    -------
    Solution : states (2, n, N), growth (tangents, n - 1, N), propagators (2, 2, n - 1, N) for two tangents

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
        start = (np.ascontiguousarray(columns[:, padded]), np.ascontiguousarray(state[:, padded]), h)
        advance(*start, *forcing, law, tangents, members, states, growth, propagators)

    map_chunks(run, columns, t, steps_per_period, threads, LANES, EIGHT)
    rest = _rests(columns, state)
    growth[..., rest] = 0.0
    if tangents == 2:
        propagators[..., rest] = np.diag([1.0, 0.0])[:, :, None, None]
    check_finite(columns, states, growth, propagators)
    growth[1:, :, rest] = -np.inf
    return Solution(states, growth, propagators if tangents == 2 else None)


def checked(osc, state, t, steps_per_period, threads):
    """The arguments of `integrate` as columns (6, N), state (2, N), t (n, 1) or (n, N), and two whole numbers."""
    columns = osc.columns()
    size = columns.shape[1]
    state = checks.state(state, (size,) if np.shape(state) == (2, size) else osc.shape)
    if np.ndim(t) == 2 and np.shape(t)[1] == size and size > 0:
        t = np.stack([checks.times(column) for column in np.transpose(t)], axis=1)
    else:
        t = checks.times(t)[:, None]
    threads = processors.available() if threads is None else checks.count("threads", threads)
    return columns, state, t, checks.count("steps_per_period", steps_per_period), threads


def check_finite(columns, *results):
    """Raise DivergedError, with the parameters of the first such member, unless all results (..., N) are finite."""
    bad = ~np.all([np.isfinite(r).all(axis=tuple(range(r.ndim - 1))) for r in results if r.size], axis=0)
    if np.any(bad):
        first = Duffing(*columns[:, bad.argmax()]).named()
        raise DivergedError(f"{bad.sum()} of {bad.size} solutions or tangents are not finite; the first has {first}")


def _rests(columns, state):
    """Members at exact rest whose damping has an infinite slope there (p < 1), so that no step follows their tangents.

    The derivative of the flow is known: a small xi creeps back at a speed of order |xi|^(1/p), a small eta stops after
    a way of order |eta|^(2-p). Both are of higher than first order: xi stays as it is, and of eta nothing is left.
    """
    (alpha, p, mu, _, delta, gamma), (x, v) = columns, state
    return (p < 1) & (alpha > 0) & (mu == 0) & (v == 0) & ((delta + gamma * x * x) * x == 0)


@compiled
def advance(columns, state, h, cosines, offsets, counts, law, tangents, members, states, growth, propagators):
    """Advance one block through all intervals. law: None for p = 1; tangents: 0, 1 or 2.

    growth comes in as zeros, propagators as identities.
    """
    widest_vectors()
    block = stack(BLOCK)
    now, osc, frame, lengths = lanes(block, NOW), lanes(block, OSC), lanes(block, FRAME), lanes(block, LENGTHS)
    vectors = state.shape[1] // EIGHT
    for l in range(state.shape[1]):
        now[X, l], now[V, l] = state[0, l], state[1, l]
        osc[ALPHA, l], osc[P, l], osc[MU, l] = columns[0, l], columns[1, l], columns[2, l]
        osc[DELTA, l], osc[GAMMA, l] = columns[4, l], columns[5, l]
        now[XI1, l] = now[ETA2, l] = frame[0, l] = frame[3, l] = 1.0
    for l, member in enumerate(members):
        states[0, 0, member], states[1, 0, member] = state[0, l], state[1, l]
    for i in range(len(counts)):
        for l in range(state.shape[1]):
            osc[H, l] = h[i, l]
        at, end = offsets[i], offsets[i] + 2 * counts[i]
        while at < end:
            for k in range(at, min(at + 2 * BETWEEN, end), 2):
                _step(block, vectors, law, tangents, cosines[k], cosines[k + 1], cosines[k + 2])
            at += 2 * BETWEEN
            if tangents == 2:
                for l, member in enumerate(members):
                    _propagate(now, frame, l, propagators, i, member)
            if tangents > 0:
                _orthonormalise(block, vectors, tangents)
                for l, member in enumerate(members):
                    for j in range(tangents):
                        growth[j, i, member] += np.log(lengths[j, l])
        for l, member in enumerate(members):
            states[0, i + 1, member], states[1, i + 1, member] = now[X, l], now[V, l]


@inlined
def _step(block, vectors, law, tangents, c0, c1, c2):
    """y <- y + h/6 (k1 + 2 k2 + 2 k3 + k4) in every lane; c0, c1, c2: cos(omega t) at the start, middle and end.

    Without a power the whole step stays in registers. With one, the lanes are the inner loop of each stage: many
    powers are then under way at once, instead of four that wait for one another.
    """
    now, argument, total, osc = eights(block, NOW), eights(block, STAGE), eights(block, SUM), eights(block, OSC)
    if law is None:
        # The number of tangents as a constant: without a branch between the stages nothing goes through memory.
        if tangents == 0:
            for c in range(vectors):
                _whole_step(now, argument, total, osc, c, 0, c0, c1, c2)
        elif tangents == 1:
            for c in range(vectors):
                _whole_step(now, argument, total, osc, c, 1, c0, c1, c2)
        else:
            for c in range(vectors):
                _whole_step(now, argument, total, osc, c, 2, c0, c1, c2)
    else:
        for c in range(vectors):
            stage(now, now, argument, total, osc, c, law, tangents, c0, 0.0, 0.5)
        for c in range(vectors):
            stage(now, argument, argument, total, osc, c, law, tangents, c1, 2.0, 0.5)
        for c in range(vectors):
            stage(now, argument, argument, total, osc, c, law, tangents, c1, 2.0, 1.0)
        for c in range(vectors):
            stage(now, argument, now, total, osc, c, law, tangents, c2, 1.0, 0.0)


@inlined
def _whole_step(now, argument, total, osc, c, tangents, c0, c1, c2):
    stage(now, now, argument, total, osc, c, None, tangents, c0, 0.0, 0.5)
    stage(now, argument, argument, total, osc, c, None, tangents, c1, 2.0, 0.5)
    stage(now, argument, argument, total, osc, c, None, tangents, c1, 2.0, 1.0)
    stage(now, argument, now, total, osc, c, None, tangents, c2, 1.0, 0.0)


@inlined
def stage(now, at, to, total, osc, c, law, tangents, cosine, weight, ahead):
    """Slope k at `at`; total += weight k; the next argument is now + ahead h k (ahead = 0: the step's end).

    weight = 0 is the first stage's, with which the total begins.
    """
    x, v = at[X, c], at[V, c]
    stiffness = osc[GAMMA, c] * x * x
    # |v|^(p-1), the costly part, serves the damping v |v|^(p-1) and the tangent's p |v|^(p-1).
    friction = osc[ALPHA, c] if law is None else osc[ALPHA, c] * evaluate(v, law)
    force = fma(-(osc[DELTA, c] + stiffness), x, osc[MU, c] * cosine)
    xi1, eta1, xi2, eta2 = at[XI1, c], at[ETA1, c], at[XI2, c], at[ETA2, c]
    _use(now, to, total, osc, c, X, v, weight, ahead)
    _use(now, to, total, osc, c, V, fma(-friction, v, force), weight, ahead)
    slope = friction if law is None else osc[P, c] * friction
    spring = -fma(3.0, stiffness, osc[DELTA, c])
    if tangents > 0:
        _use(now, to, total, osc, c, XI1, eta1, weight, ahead)
        _use(now, to, total, osc, c, ETA1, fma(-slope, eta1, spring * xi1), weight, ahead)
    if tangents > 1:
        _use(now, to, total, osc, c, XI2, eta2, weight, ahead)
        _use(now, to, total, osc, c, ETA2, fma(-slope, eta2, spring * xi2), weight, ahead)


@inlined
def _use(now, to, total, osc, c, row, k, weight, ahead):
    """Enter one row's slope k into the sum and into the next stage's argument or, at the last stage, the step."""
    summed = k if weight == 0.0 else fma(weight, k, total[row, c])
    if ahead == 0.0:
        to[row, c] = fma(osc[H, c] * (1.0 / 6.0), summed, now[row, c])
    else:
        total[row, c] = summed
        to[row, c] = fma(osc[H, c] * ahead, k, now[row, c])


@inlined
def _propagate(now, frame, l, propagators, i, member):
    """Propagator <- W Q^T propagator: W are the tangents now, Q what they were when last made orthonormal."""
    for j in range(2):
        x, v = propagators[0, j, i, member], propagators[1, j, i, member]
        first = frame[0, l] * x + frame[1, l] * v
        second = frame[2, l] * x + frame[3, l] * v
        propagators[0, j, i, member] = now[XI1, l] * first + now[XI2, l] * second
        propagators[1, j, i, member] = now[ETA1, l] * first + now[ETA2, l] * second


@inlined
def _orthonormalise(block, vectors, tangents):
    """Gram-Schmidt: the tangents become orthonormal, the diagonal of R goes to `LENGTHS`."""
    now, frame, lengths = eights(block, NOW), eights(block, FRAME), eights(block, LENGTHS)
    for c in range(vectors):
        xi, eta = now[XI1, c], now[ETA1, c]
        length = root(xi * xi + eta * eta)
        xi, eta = xi / length, eta / length
        # In the plane the second direction is known: at right angles to the first, on the second vector's side.
        height = xi * now[ETA2, c] - eta * now[XI2, c]
        side = where(height >= 0.0, 1.0, -1.0)
        lengths[0, c], lengths[1, c] = length, abs(height)
        now[XI1, c], now[ETA1, c] = frame[0, c], frame[1, c] = xi, eta
        now[XI2, c], now[ETA2, c] = frame[2, c], frame[3, c] = -side * eta, side * xi
