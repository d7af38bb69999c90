"""The periodic orbit near x = 0 by multiple shooting: Newton's method with the tangent map of each segment.

For mu = 0 it is the saddle point x = 0. It is its own mirror image under (x, v, t) -> (-x, -v, t + pi/omega): it
continues the saddle point, its image does so too, and a hyperbolic orbit has only one continuation. So half a period
is enough, cut into segments over which the flow stretches moderately: over a whole period it stretches by
exp(2 pi / omega), a factor 10^27 at omega = 0.1. All here is dimensionless: delta = -1, gamma = 1.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy.special

from ..flow import integrate

_SEGMENT = 1.0  # longest segment: the time in which the saddle point stretches by e
_TOLERANCE = {"rtol": 1e-12, "atol": 1e-14}
_STEPS = 30


class Segments(NamedTuple):
    """Half a forcing period of N members in m segments.

    t (m + 1, N) : the times of the nodes, from 0 to T/2
    states (2, m, N) : x and v at the nodes; at T/2 they are minus those at 0
    maps (2, 2, m, N) : tangent map of each segment
    friction_time (m, N) : friction time of each segment, infinite where a creep annihilates a tangent direction
    """

    t: np.ndarray
    states: np.ndarray
    maps: np.ndarray
    friction_time: np.ndarray


def central_orbit(unit):
    """The periodic orbit near x = 0 of the dimensionless family `unit` of N members: (Segments, found (N,)).

    Newton's method starts from the linear response; where it fails, from the orbits at weaker forcing, step by step.
    """
    segments = int(np.ceil((unit.period / 2 / _SEGMENT).max()))
    t = np.linspace(np.zeros_like(unit.mu), unit.period / 2, segments + 1)
    states, found = _newton(unit, t, linear_response(unit, t[:-1]))
    if not found.all():
        lost = ~found
        states[:, :, lost], found[lost] = _continuation(unit.members(lost), t[:, lost])
    return Segments(t, states, *_shoot(unit, t, states)[1:]), found


def linear_response(unit, t):
    """States (2, n, N) at the times t (n, N) of the orbit of x'' + c x' - x = mu cos(omega t), A its amplitude.

    c = alpha (omega A)^(p-1) (2/pi) B(p/2 + 1, 1/2) takes as much energy in a period as the power law does.
    """
    stiffness = 1 + unit.omega**2
    share = unit.alpha * 2 / np.pi * scipy.special.beta(unit.p / 2 + 1, 0.5)
    low, high = np.zeros_like(unit.mu), np.abs(unit.mu) / stiffness
    for _ in range(60):
        middle = (low + high) / 2
        weak = np.hypot(stiffness * middle, share * (unit.omega * middle) ** unit.p) < np.abs(unit.mu)
        low, high = np.where(weak, middle, low), np.where(weak, high, middle)
    # x = Re[mu e^(i omega t) / (-stiffness + i omega c)], of modulus A = high.
    lag = np.arctan2(share * (unit.omega * high) ** unit.p, -stiffness * high)
    x = np.sign(unit.mu) * high * np.exp(1j * (unit.omega * t - lag))
    return np.array([x.real, (1j * unit.omega * x).real])


def _continuation(unit, t):
    """States (2, m, n) and found (n,) from the same orbit at 1/16, 2/16, ... of the forcing."""
    states = None
    for k in range(1, 17):
        part = replace(unit, mu=unit.mu * k / 16)
        states = linear_response(part, t[:-1]) if states is None else states * k / (k - 1)
        states, found = _newton(part, t, states)
        if not found.any():
            break
    return states, found


def _newton(unit, t, states):
    """Refined states (2, m, N) and whether each member converged; steps are halved until the residual falls."""
    size = unit.mu.size
    gap, maps, _ = _shoot(unit, t, states)
    factor, found = np.ones(size), np.zeros(size, dtype=bool)
    for _ in range(_STEPS):
        step = _step(gap, maps)
        last = ~found & (np.abs(step).max(axis=(0, 1)) < 1e-9)
        states = np.where(last, states + step, states)
        found |= last
        if found.all():
            break
        trial = states + factor * step
        new_gap, new_maps, _ = _shoot(unit, t, trial)
        better = ~found & (np.abs(new_gap).max(axis=(0, 1)) < np.abs(gap).max(axis=(0, 1)))
        states, gap, maps = (np.where(better, *pair) for pair in ((trial, states), (new_gap, gap), (new_maps, maps)))
        factor = np.where(better, np.minimum(1, 2 * factor), factor / 2)
    return states, found


def _shoot(unit, t, states):
    """Gap (2, m, N) between each segment's end and the next node, tangent maps and friction times of the segments."""
    segments, size = states.shape[1:]
    tiled = unit.members(np.tile(np.arange(size), segments))
    times = np.array([t[:-1].ravel(), t[1:].ravel()])
    orbit = integrate(tiled, states.reshape(2, -1), times, tangents=2, **_TOLERANCE)
    following = np.concatenate([states[:, 1:], -states[:, :1]], axis=1)
    gap = following - orbit.states[:, 1].reshape(2, segments, size)
    return gap, orbit.propagators.reshape(2, 2, segments, size), orbit.friction_time.reshape(segments, size)


def _step(gap, maps):
    """Newton's step: maps_j step_j - step_(j+1) = gap_j, the last node being minus the first."""
    segments, size = gap.shape[1:]
    matrix = np.zeros((size, segments, 2, segments, 2))
    for j in range(segments):
        matrix[:, j, :, j, :] += np.moveaxis(maps[:, :, j], -1, 0)
        matrix[:, j, :, (j + 1) % segments, :] -= np.eye(2) if j + 1 < segments else -np.eye(2)
    rows = 2 * segments
    step = np.linalg.solve(matrix.reshape(size, rows, rows), gap.transpose(2, 1, 0).reshape(size, rows, 1))
    return step.reshape(size, segments, 2).transpose(2, 1, 0)
