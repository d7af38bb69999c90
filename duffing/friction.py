"""The friction-time integrator: every p > 0, forward and backward, both tangent vectors, creep included."""

import math
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from . import checks
from .dop853 import STAGES, advance, error, land
from .errors import ConvergenceError, DivergedError
from .friction_time import ETA1, ETA2, OMEGA, START, S, T, W, X, XI1, XI2, compiled, parameters, rate, variable, velocity
from .orbit import Orbit

_DONE, _DIVERGED, _TOO_MANY_STEPS = range(3)
_ESCAPED = 1e60  # |x| from which only a solution that becomes infinite in finite time comes
_BLOCK = 8


def integrate(osc, state, t, tangents=0, rtol=1e-10, atol=1e-12, max_steps=100_000, threads=None):
    n = np.shape(t)[0]
    q = parameters(osc.columns())
    size = q.shape[1]
    start = checks.state(state, osc.shape)
    times = np.ascontiguousarray(np.broadcast_to(np.asarray(t, float).reshape(n, -1), (n, size)))
    states = np.empty((2, n, size))
    logs = np.zeros((3, n - 1, size))
    angles = np.zeros((n, size))
    friction_time = np.zeros((n - 1, size))
    evaluations = np.zeros(size, dtype=np.int64)
    status = np.zeros(size, dtype=np.int64)
    states[:, 0] = start
    for i in range(size):
        status[i] = _follow(q[:, i].copy(), times[:, i].copy(), tangents, rtol, atol, max_steps, states[:, :, i], logs[:, :, i], angles[:, i], friction_time[:, i], evaluations[i:i+1])
    if (status == _DIVERGED).any():
        raise DivergedError(f"diverged {status}")
    if (status == _TOO_MANY_STEPS).any():
        raise ConvergenceError(f"too many steps {status}")
    propagators = _propagators(logs, angles) if tangents == 2 else None
    return Orbit(states, logs[:tangents], propagators, friction_time)


def _propagators(logs, angles):
    def rotation(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
    r = np.exp(logs[:2])
    R = np.array([[r[0], r[0] * logs[2]], [np.zeros_like(r[0]), r[1]]])
    return np.einsum("ij...,jk...,lk...->il...", rotation(angles[1:]), R, rotation(angles[:-1]))


@compiled
def _follow(q, times, tangents, rtol, atol, max_steps, states, logs, angles, friction_time, evaluations):
    K = np.zeros((STAGES, 8))
    y, new = np.zeros(8), np.zeros(8)
    y[X], y[W] = states[0, 0], variable(q, states[1, 0])
    y[XI1], y[ETA2] = 1.0, 1.0
    h = 0.01 * 2 * math.pi / q[OMEGA]
    for i in range(times.size - 1):
        q[START], y[T], y[S] = times[i], 0.0, 0.0
        sums = logs[:, i]
        h, status, count = _until(q, y, times[i + 1] - times[i], h, tangents, rtol, atol, max_steps, sums, K, new)
        evaluations[0] += count
        if status != _DONE:
            return status
        states[0, i + 1], states[1, i + 1] = y[X], velocity(q, y[W])
        friction_time[i] = y[S]
        if tangents > 0:
            _orthonormalise(y, tangents, sums)
            angles[i + 1] = math.atan2(y[ETA1], y[XI1])
    return _DONE


@compiled
def _until(q, y, target, h, tangents, rtol, atol, max_steps, sums, K, new):
    h = math.copysign(h, target)
    rate(q, y, tangents, K[0])
    count = 1
    for _ in range(max_steps):
        advance(q, y, h, tangents, K, new)
        count += 12
        e = error(q, y, new, h, K, rtol, atol)
        if not e <= 1.0:
            h *= max(0.2, 0.9 * e ** -0.125) if e > 1.0 else 0.2
            continue
        arrived = abs(new[T]) >= abs(target)
        if arrived:
            _, more = land(q, y, h, tangents, T, target, K, new)
            count += more
        else:
            h *= min(6.0, 0.9 * e ** -0.125) if e > 0 else 6.0
        y[:] = new
        K[0] = K[12]
        if arrived:
            return h, _DONE, count
        if not abs(y[X]) < _ESCAPED:
            return h, _DIVERGED, count
        if tangents == 2:
            area = y[XI1] * y[ETA2] - y[ETA1] * y[XI2]
            if abs(area) < 0.01 * math.hypot(y[XI1], y[ETA1]) * math.hypot(y[XI2], y[ETA2]):
                _orthonormalise(y, tangents, sums)
                rate(q, y, tangents, K[0])
    return h, _TOO_MANY_STEPS, count


@compiled
def _orthonormalise(y, tangents, sums):
    r11 = math.hypot(y[XI1], y[ETA1])
    if tangents == 2:
        r12 = (y[XI1] * y[XI2] + y[ETA1] * y[ETA2]) / r11
        r22 = (y[XI1] * y[ETA2] - y[ETA1] * y[XI2]) / r11
        sums[2] += r12 / r11 * math.exp(sums[1] - sums[0])
        sums[1] += math.log(r22)
    sums[0] += math.log(r11)
    y[XI1] /= r11
    y[ETA1] /= r11
    y[XI2], y[ETA2] = -y[ETA1], y[XI1]
