"""The paper's own algorithm: classical fourth-order Runge-Kutta with constant step, many trajectories side by side.

x' = v,  v' = mu cos(omega t) - delta x - gamma x^3 - alpha v |v|^(p-1), and with it up to two tangent vectors
xi' = eta,  eta' = -(delta + 3 gamma x^2) xi - alpha p |v|^(p-1) eta.
"""

import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from llvmlite import ir
from numba import carray, njit, types
from numba.core import cgutils
from numba.extending import intrinsic

from . import checks
from .errors import DivergedError
from .orbit import Orbit
from .powers import evaluate, power

LANES = 64  # trajectories of a block: their rows stay in the first-level cache, and loops over them fill the vector units
PAD = 8  # the widest vector of doubles: a block is filled up to a multiple of it
LEAST_SPEED = 2.0**-50  # below it |v|^(p-1) is held for p < 1: the damping stays 0 at v = 0, the tangent's singularity finite
BETWEEN = 50  # steps after which tangents are made orthonormal, so that nothing over- or underflows in a long interval
GRID = 2.0**40  # forcing phases are rounded to turns/GRID, so that equal phases are seen as equal and never drift

# Rows of a block's workspace: the state and tangents at the start of the step, at the stage, and the sum of slopes.
_X, _V, _TANGENT = 0, 1, 2
_START, _STAGE, _SUM = 0, 6, 12
_H, _ALPHA, _P, _MU, _DELTA, _GAMMA, _Q = 18, 19, 20, 21, 22, 23, 24
_ROWS = 28


def integrate(osc, state, t, tangents=0, steps_per_period=500, threads=None):
    """Solutions at the times t by Runge-Kutta steps of at most 2 pi / (omega steps_per_period).

    Parameters
    ----------
    osc : Duffing, a single oscillator or a family of N members
    state : (2,) or (2, *family) or (2, N), (x, v) at t[0]
    t : (n,) for all members or (n, N), increasing times; each interval is cut into the least number of equal steps
    tangents : 0, 1 or 2 tangent vectors; growth and propagators are of each interval
    threads : at most so many at once (default: the processors); the result is the same to the last bit

    Returns
    -------
    Orbit : states (2, n, N), growth (tangents, n - 1, N), propagators (2, 2, n - 1, N) for two tangents

    Raises
    ------
    ValueError : for invalid input
    DivergedError : when a solution or its tangent is not finite
    """
    columns = osc.columns()
    size = columns.shape[1]
    state = checks.state(state, (size,) if np.shape(state) == (2, size) else osc.shape)
    t = _times(t, size)
    tangents = checks.count("tangents", tangents, least=0)
    if tangents > 2:
        raise ValueError(f"tangents = {tangents}: must be 0, 1 or 2")
    steps_per_period = checks.count("steps_per_period", steps_per_period)
    threads = os.cpu_count() if threads is None else checks.count("threads", threads)

    n = len(t)
    states = np.empty((2, n, size))
    growth = np.empty((tangents, n - 1, size))
    propagators = np.empty((2, 2, n - 1 if tangents == 2 else 0, size))

    def run(block):
        members, law, (cosines, offsets, counts) = block
        padded = np.resize(members, -(-len(members) // PAD) * PAD)
        h = np.diff(t[:, padded], axis=0) / counts[:, None]
        _advance(
            columns[:, padded], state[:, padded], h, cosines, offsets, counts, law, (0,) * tangents,
            members, states, growth, propagators,
        )  # fmt: skip

    blocks = _blocks(columns, t, steps_per_period)
    if threads == 1 or len(blocks) == 1:
        for block in blocks:
            run(block)
    else:
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(run, blocks))
    _check_finite(states, growth, columns)
    return Orbit(states, growth, propagators if tangents == 2 else None)


def _times(t, size):
    t = np.asarray(t)
    if t.ndim == 2 and t.shape[1] == size and t.shape[0] > 0:
        return np.stack([checks.times(column) for column in t.T], axis=1) if size else t.astype(float)
    return np.repeat(checks.times(t)[:, None], size, axis=1)


def _blocks(columns, t, steps_per_period):
    """Cut the family into blocks of one p and one sequence of forcing phases: (members, power, forcing) each."""
    turns = t * columns[3] / (2 * np.pi)
    # A millionth of a step of slack: round-off in the times must not add a step.
    counts = np.maximum(np.ceil(np.diff(turns, axis=0) * steps_per_period - 1e-6), 1.0)
    phases = np.rint(turns * GRID)
    keys = np.concatenate([columns[1:2], counts, phases % GRID, np.diff(phases, axis=0)])
    groups = {}
    for member, key in enumerate(np.ascontiguousarray(keys.T)):
        groups.setdefault(key.tobytes(), []).append(member)
    blocks = []
    for members in groups.values():
        p, first = columns[1, members[0]], members[0]
        law = None if p == 1 else power(p - 1, LEAST_SPEED if p < 1 else 2.0**-1022)
        forcing = _cosines(phases[:, first], counts[:, first].astype(int))
        blocks += [(np.array(members[i : i + LANES]), law, forcing) for i in range(0, len(members), LANES)]
    return blocks


def _cosines(phases, counts):
    """cos(omega t) at the ends and middles of all steps: one table, with the interval's offset in it and its steps."""
    tables, offsets, known, length = [], [], {}, 0
    for start, turn, count in zip(phases[:-1] % GRID, np.diff(phases), counts, strict=True):
        if (start, turn, count) not in known:
            known[start, turn, count] = length
            angle = (start + turn * (np.arange(2 * count + 1) / (2 * count))) / GRID
            tables.append(np.cos(2 * np.pi * (angle - np.rint(angle))))
            length += 2 * count + 1
        offsets.append(known[start, turn, count])
    return np.concatenate([*tables, np.empty(0)]), np.array(offsets, dtype=int), counts


def _check_finite(states, growth, columns):
    bad = ~(np.isfinite(states).all(axis=(0, 1)) & np.isfinite(growth).all(axis=(0, 1)))
    if bad.any():
        names = ("alpha", "p", "mu", "omega", "delta", "gamma")
        first = ", ".join(f"{n} = {v:g}" for n, v in zip(names, columns[:, bad.argmax()], strict=True))
        raise DivergedError(f"{bad.sum()} of {bad.size} members have a solution or tangent that is not finite: {first}")


@intrinsic
def _stack_rows(typingctx):
    """Memory on the stack: LLVM sees that nothing else can point there, without which it vectorises no table look-up."""

    def codegen(context, builder, signature, arguments):
        rows = cgutils.alloca_once(builder, ir.ArrayType(ir.DoubleType(), _ROWS * LANES))
        rows.align = 64  # whole cache lines
        return builder.bitcast(rows, context.get_value_type(signature.return_type))

    return types.CPointer(types.float64)(), codegen


@njit(cache=True, nogil=True, error_model="numpy")
def _advance(columns, state, h, cosines, offsets, counts, law, basis, members, states, growth, propagators):
    """Advance one block through all intervals. law: None for p = 1; basis: a tuple as long as there are tangents."""
    w = carray(_stack_rows(), (_ROWS, LANES))
    lanes = state.shape[1]
    for l in range(lanes):
        w[_X, l], w[_V, l] = state[0, l], state[1, l]
        w[_ALPHA, l], w[_P, l], w[_MU, l] = columns[0, l], columns[1, l], columns[2, l]
        w[_DELTA, l], w[_GAMMA, l] = columns[4, l], columns[5, l]
        for j in range(len(basis)):
            for i in range(2):
                w[_TANGENT + 2 * j + i, l] = w[_Q + 2 * j + i, l] = 1.0 if i == j else 0.0
    for l, member in enumerate(members):
        states[0, 0, member], states[1, 0, member] = w[_X, l], w[_V, l]
    for i in range(len(counts)):
        for l in range(lanes):
            w[_H, l] = h[i, l]
        for l, member in enumerate(members):
            for j in range(len(basis)):
                growth[j, i, member] = 0.0
            if len(basis) == 2:
                for j in range(4):
                    propagators[j // 2, j % 2, i, member] = 1.0 if j == 0 or j == 3 else 0.0
        at = offsets[i]
        done = 0
        while done < counts[i]:
            for _ in range(min(BETWEEN, counts[i] - done)):
                _stage(w, lanes, law, basis, cosines[at], _START, 1.0, 0.5)
                _stage(w, lanes, law, basis, cosines[at + 1], _STAGE, 2.0, 0.5)
                _stage(w, lanes, law, basis, cosines[at + 1], _STAGE, 2.0, 1.0)
                _stage(w, lanes, law, basis, cosines[at + 2], _STAGE, 1.0, 0.0)
                at += 2
                done += 1
            for l, member in enumerate(members):
                if len(basis) == 2:
                    _propagate(w, l, propagators[:, :, i, member])
                _orthonormalise(w, l, basis, growth[:, i, member])
        for l, member in enumerate(members):
            states[0, i + 1, member], states[1, i + 1, member] = w[_X, l], w[_V, l]


@njit(forceinline=True)
def _stage(w, lanes, law, basis, cosine, at, weight, ahead):
    """One stage: slope k at the row group `at`; sum += weight k; next argument = start + ahead h k (0: end of step)."""
    for l in range(lanes):
        h = w[_H, l]
        x, v = w[at + _X, l], w[at + _V, l]
        stiffness = w[_GAMMA, l] * x * x
        # |v|^(p-1), the costly part, serves the damping v |v|^(p-1) and the tangent's p |v|^(p-1).
        friction = w[_ALPHA, l] if law is None else w[_ALPHA, l] * evaluate(v, law)
        a = w[_MU, l] * cosine - (w[_DELTA, l] + stiffness) * x - friction * v
        _update(w, l, _X, v, h, at, weight, ahead)
        _update(w, l, _V, a, h, at, weight, ahead)
        if law is not None:
            friction = w[_P, l] * friction
        for j in range(len(basis)):
            xi, eta = w[at + _TANGENT + 2 * j, l], w[at + _TANGENT + 2 * j + 1, l]
            b = -(w[_DELTA, l] + 3.0 * stiffness) * xi - friction * eta
            _update(w, l, _TANGENT + 2 * j, eta, h, at, weight, ahead)
            _update(w, l, _TANGENT + 2 * j + 1, b, h, at, weight, ahead)


@njit(forceinline=True)
def _update(w, l, row, k, h, at, weight, ahead):
    total = k if at == _START else w[_SUM + row, l] + weight * k
    if ahead == 0.0:
        w[row, l] += h * (1.0 / 6.0) * total
    else:
        w[_SUM + row, l] = total
        w[_STAGE + row, l] = w[row, l] + (ahead * h) * k


@njit(forceinline=True)
def _propagate(w, l, propagator):
    """propagator <- W Q^T propagator: W are the tangents now, Q what they were when last made orthonormal."""
    for j in range(2):
        first = w[_Q, l] * propagator[0, j] + w[_Q + 1, l] * propagator[1, j]
        second = w[_Q + 2, l] * propagator[0, j] + w[_Q + 3, l] * propagator[1, j]
        for i in range(2):
            propagator[i, j] = w[_TANGENT + i, l] * first + w[_TANGENT + 2 + i, l] * second


@njit(forceinline=True)
def _orthonormalise(w, l, basis, growth):
    """Gram-Schmidt: the tangents become orthonormal, the logarithms of the diagonal of R are added to growth."""
    if len(basis) == 0:
        return
    xi, eta = w[_TANGENT, l], w[_TANGENT + 1, l]
    length = np.sqrt(xi * xi + eta * eta)
    xi, eta = xi / length, eta / length
    growth[0] += np.log(length)
    w[_TANGENT, l], w[_TANGENT + 1, l] = xi, eta
    w[_Q, l], w[_Q + 1, l] = xi, eta
    if len(basis) == 2:
        # In the plane the second direction is known: at right angles to the first, on the second vector's side.
        height = xi * w[_TANGENT + 3, l] - eta * w[_TANGENT + 2, l]
        side = 1.0 if height >= 0.0 else -1.0
        growth[1] += np.log(abs(height))
        w[_TANGENT + 2, l], w[_TANGENT + 3, l] = -side * eta, side * xi
        w[_Q + 2, l], w[_Q + 3, l] = -side * eta, side * xi
