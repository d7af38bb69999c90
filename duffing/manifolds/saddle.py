"""The saddle orbit: the hyperbolic periodic orbit near x = 0, whose manifolds the Melnikov function compares."""

from typing import NamedTuple

import numpy as np

from .. import checks
from ..errors import NoSaddleOrbitError
from ..flow import answered
from ..oscillator import Duffing
from .shooting import central_orbit


class SaddleOrbit(NamedTuple):
    """state (2, *family): x and v at phase 0; multipliers (2, *family): Floquet multipliers over one forcing period,
    the unstable one first; unstable, stable (2, *family): unit vectors along W^U and W^S at phase 0, with x > 0."""

    state: np.ndarray
    multipliers: np.ndarray
    unstable: np.ndarray
    stable: np.ndarray


class Frame(NamedTuple):
    """The saddle orbits of N members at n equidistant times of a forcing period, with both directions; dimensionless.

    osc : Duffing, the N members with delta = -1, gamma = 1
    t (n, N), states (2, n, N)
    directions (2, 2, n, N) : unit vectors of (x, v) along W^U (first) and W^S, x > 0 at phase 0
    growth (2, n, N) : logarithm of what the flow stretches each by until the next time; over a period of the unstable
        and the stable one they add up to -alpha S, S the friction time
    """

    osc: Duffing
    t: np.ndarray
    states: np.ndarray
    directions: np.ndarray
    growth: np.ndarray


def saddle_orbit(osc, on_failure="raise"):
    """The saddle orbit near x = 0, by Newton's method with the tangent map. Returns a SaddleOrbit.

    on_failure : "raise", or "nan": members without such an orbit are NaN, and one warning says so

    Raises ValueError unless delta < 0 < gamma; NoSaddleOrbitError naming the first member whose orbit sticks (p <= 1/2:
    the stroboscopic map is not invertible there), is not a saddle between the wells, or was not found.
    """

    def rows(members):
        part = osc.members(members)
        frame, scale = saddle_frame(part), part.units()[:2]
        directions = frame.directions[:, :, 0] * scale
        directions /= np.hypot(directions[:, 0], directions[:, 1])[:, None]
        return np.array([frame.states[:, 0] * scale, np.exp(frame.growth.sum(axis=1)), *directions])

    checks.double_well(osc)
    return SaddleOrbit(*answered(rows, osc, (4, 2), on_failure).reshape(4, 2, *osc.shape))


def saddle_frame(osc):
    """The Frame of the family's saddle orbits; errors as for `saddle_orbit`."""
    unit = checks.model(osc).dimensionless().members()
    _refuse(osc, at_rest(unit), "for p < 1 it is at rest at mu = 0, and the damping has no linearisation at v = 0")
    (t, states, maps, friction_time), found = central_orbit(unit)
    _refuse(osc, ~found, _NOT_FOUND)
    sticks = ~np.isfinite(friction_time).all(axis=0)
    _refuse(osc, sticks, "it sticks: its velocity passes through zero in a creep, the stroboscopic map not invertible")
    half = np.eye(2)[:, :, None]
    for j in range(maps.shape[2]):
        half = _times(maps[:, :, j], half)
    # The determinant by Liouville's theorem: a difference of products would lose its digits.
    log_area = -unit.alpha * friction_time.sum(axis=0)
    mean = (half[0, 0] + half[1, 1]) / 2
    discriminant = mean**2 - np.exp(log_area)
    unstable = mean + np.sqrt(np.maximum(discriminant, 0))
    hyperbolic = (discriminant > 0) & (unstable > 1) & (np.abs(states[0]).max(axis=0) < 1)
    _refuse(osc, ~hyperbolic, "the periodic orbit that continues x = 0 is no longer a saddle between the wells")
    _refuse(osc, log_area - np.log(unstable) < -300, "it all but sticks: its stable multiplier is below exp(-600)")
    multipliers = np.array([unstable, np.exp(log_area) / unstable])
    directions, growth = _directions(half, multipliers, maps, np.exp(-unit.alpha * friction_time))
    return Frame(
        unit,
        np.concatenate([t[:-1], t[:-1] + t[-1]]),
        np.concatenate([states, -states], axis=1),
        np.concatenate([directions, directions], axis=2),
        np.concatenate([growth, growth], axis=1),
    )


def at_rest(unit):
    """Which members (N,) have their saddle orbit at rest where the damping has no linearisation."""
    return (unit.mu == 0) & (unit.p < 1) & (unit.alpha > 0)


def _directions(half, multipliers, maps, areas):
    """Unstable and stable unit vectors (2, 2, m, N) and their growth (2, m, N), each carried along the time in which it
    attracts."""
    segments = maps.shape[2]
    directions, growth = np.empty((2, 2, *maps.shape[2:])), np.empty((2, *maps.shape[2:]))
    start = []
    for other in multipliers[::-1]:
        # The eigenvector of one multiplier spans the columns of (half - the other multiplier).
        columns = half - other * np.eye(2)[:, :, None]
        vector = np.where(np.hypot(*columns[:, 0]) > np.hypot(*columns[:, 1]), columns[:, 0], columns[:, 1])
        start.append(vector * np.sign(vector[0]))
    unstable, stable = start / np.hypot(*np.moveaxis(start, 1, 0))[:, None]
    for j in range(segments):
        directions[0, :, j] = unstable
        unstable = _times(maps[:, :, j], unstable)
        stretch = np.hypot(*unstable)
        unstable, growth[0, j] = unstable / stretch, np.log(stretch)
    for j in reversed(range(segments)):
        inverse = np.array([[maps[1, 1, j], -maps[0, 1, j]], [-maps[1, 0, j], maps[0, 0, j]]]) / areas[j]
        stable = _times(inverse, stable)
        stretch = np.hypot(*stable)
        directions[1, :, j], growth[1, j] = stable / stretch, -np.log(stretch)
        stable = directions[1, :, j]
    return directions, growth


def _times(matrix, other):
    """Product of (2, 2, N) with (2, 2, N) or (2, N)."""
    return np.einsum("ij...,j...->i..." if other.ndim < matrix.ndim else "ij...,jk...->ik...", matrix, other)


_NOT_FOUND = "Newton's method, with continuation from weaker forcing, does not find it"


def _refuse(osc, members, reason):
    """Raise NoSaddleOrbitError, naming the first of the members (N,) marked."""
    marked = np.flatnonzero(members)
    if marked.size:
        member = osc.named(marked[0])
        raise NoSaddleOrbitError(f"no hyperbolic saddle orbit for {member} ({marked.size} such members): {reason}")
