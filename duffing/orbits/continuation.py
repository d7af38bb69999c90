"""Pseudo-arclength continuation of solution branches g(u, parameter) = 0, many branches side by side.

Each step predicts along the tangent and corrects by Newton's method in the plane normal to it, so that a branch is
followed through its folds, where it cannot be written as u(parameter). The branches go in lock-step because the
functions g here are cheap only for whole families; each keeps its own step. Source: Keller (1977); Allgower and Georg
(2003).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .. import checks
from ..errors import ConvergenceError

BOUND, CLOSED, STEPS, LOST = "bound", "closed", "steps", "lost"
_ITERATIONS = 7
_BEND = 0.97  # least cosine of the angle between the tangents of neighbouring points
_FAR = 0.3  # a correction longer than this has left the branch


class Branch(NamedTuple):
    """Points of one branch in the order in which they were met.

    u (m, n), parameter (n,) : the solutions
    tangent (m + 1, n) : unit tangent (du, dparameter) of the curve in the direction followed
    end : "bound" (the parameter reached one of its bounds, exactly), "closed" (back at the start), "steps" (the number
        of points asked for), "lost" (Newton's method fails however small the step)
    """

    u: np.ndarray
    parameter: np.ndarray
    tangent: np.ndarray
    end: str


def follow_branches(
    function, u, parameter, *, bounds, direction=1, step=0.01, smallest=1e-5, largest=0.05, points=400, tolerance=1e-9
):
    """The branches through N starting points: a list of N Branch, the starts corrected at fixed parameter first.

    Parameters
    ----------
    function : function(u (m, n), parameter (n,), member (n,)) -> g (m, n), dg/du (m, m, n), dg/dparameter (m, n);
        member says which of the N branches each of the n columns belongs to
    u, parameter : (m, N), (N,) guesses of the starts
    bounds : (low, high) of the parameter, numbers or (N,) each
    direction : 1 or -1, the sense in which the parameter changes at the start; or (m + 1, N), the first tangents: the
        start is then corrected normal to them
    step, smallest, largest : lengths along the curve in the space of (u, parameter)
    points : greatest number of points of a branch
    tolerance : of Newton's method, the length of its last step

    Raises ValueError for invalid input, ConvergenceError naming the first start that Newton's method does not correct.
    """
    u, parameter, low, high, tangent = _start(u, parameter, bounds, direction)
    checks.count("points", points, least=2)
    lengths = [checks.positive(*pair) for pair in (("smallest", smallest), ("step", step), ("largest", largest))]
    if sorted(lengths) != lengths:
        raise ValueError(f"step = {step}: must be between smallest = {smallest} and largest = {largest}")
    everyone = np.arange(parameter.size)
    z, jacobian, _, found = correct(function, np.vstack([u, parameter]), tangent, everyone, tolerance)
    if not found.all():
        bad = np.argmin(found)
        raise ConvergenceError(
            f"parameter = {parameter[bad]:g}: Newton's method finds no solution from the guess u = {u[:, bad]}"
        )
    tangent = _tangent(jacobian, tangent)
    trail = [[(z[:, j].copy(), tangent[:, j].copy())] for j in everyone]
    ends = [STEPS] * everyone.size
    length = np.full(everyone.size, float(step))
    live = everyone
    while live.size:
        now, ahead = z[:, live], tangent[:, live]
        trial = now + length[live] * ahead
        # Where the step would pass a bound, it is aimed at the bound and corrected at fixed parameter.
        limit = np.clip(trial[-1], low[live], high[live])
        last = limit != trial[-1]
        share = np.where(last, (limit - now[-1]) / np.where(last, trial[-1] - now[-1], 1), 1.0)
        trial = now + share * length[live] * ahead
        trial[-1] = limit
        normal = np.where(last, np.eye(len(z))[:, -1:], ahead)
        new, jacobian, iterations, found = correct(function, trial, normal, live, tolerance)
        turned = _tangent(jacobian, ahead)
        good = found & ((turned * ahead).sum(axis=0) > _BEND)
        inside = (new[-1] >= low[live]) & (new[-1] <= high[live])
        good &= inside | last
        z[:, live[good]], tangent[:, live[good]] = new[:, good], turned[:, good]
        quick = np.where(iterations <= 3, 1.5, 1.0)
        length[live] = np.where(good, np.minimum(length[live] * quick, largest), length[live] / 2)
        keep = np.ones(live.size, dtype=bool)
        for j, member in enumerate(live):
            if not good[j]:
                if length[member] < smallest:
                    ends[member], keep[j] = LOST, False
                continue
            trail[member].append((new[:, j], turned[:, j]))
            first = trail[member][0]
            if last[j]:
                ends[member], keep[j] = BOUND, False
            elif len(trail[member]) > 3 and _returns(first, trail[member][-2], trail[member][-1]):
                ends[member], keep[j] = CLOSED, False
            elif len(trail[member]) >= points:
                keep[j] = False
        live = live[keep]
    return [_branch(points_of, end) for points_of, end in zip(trail, ends, strict=True)]


def _start(u, parameter, bounds, direction):
    parameter = np.atleast_1d(np.asarray(checks.parameter("parameter", parameter)))
    u = np.asarray(u, dtype=float)
    if u.ndim != 2 or u.shape[1] != parameter.size or not np.all(np.isfinite(u)):
        raise ValueError(f"u has shape {u.shape}: must be (m, {parameter.size}), finite numbers, one column a branch")
    if not isinstance(bounds, Sequence | np.ndarray) or isinstance(bounds, str) or len(bounds) != 2:
        raise ValueError(f"bounds = {bounds!r}: must be two, (low, high)")
    low, high = (checks.floats("bounds", value, "numbers, or one a branch") for value in bounds)
    if {low.shape, high.shape} - {(), parameter.shape}:
        raise ValueError(f"bounds = {bounds!r}: must be numbers, or {parameter.size} each, one a branch")
    low, high = np.broadcast_to(low, parameter.shape), np.broadcast_to(high, parameter.shape)
    if not (np.all(low <= parameter) and np.all(parameter <= high) and np.all(low < high)):
        raise ValueError(f"bounds = {bounds}: must be two different numbers with the parameter {parameter} between")
    direction = np.asarray(direction, dtype=float)
    if direction.shape == (len(u) + 1, parameter.size):
        return u, parameter, low, high, direction / np.linalg.norm(direction, axis=0)
    if direction.ndim > 1 or not np.all(np.abs(direction) == 1):
        raise ValueError(
            f"direction = {direction}: must be 1 or -1, or tangents of shape {(len(u) + 1, parameter.size)}"
        )
    tangent = np.zeros((len(u) + 1, parameter.size))
    tangent[-1] = direction
    return u, parameter, low, high, tangent


def correct(function, z, normal, member, tolerance):
    """Newton's method for g = 0 from the points z = (u, parameter), in the planes through them normal to the vectors.

    function, tolerance : as for `follow_branches`; z, normal (m + 1, n); member (n,)
    Returns z (m + 1, n), the Jacobians (n, m, m + 1), the numbers of iterations (n,) and whether each was found (n,).
    """
    z, size = z.copy(), z.shape[1]
    m = len(z) - 1
    jacobian, iterations = np.zeros((size, m, m + 1)), np.full(size, _ITERATIONS)
    found, live = np.zeros(size, dtype=bool), np.arange(size)
    for attempt in range(_ITERATIONS):
        g, by_u, by_parameter = function(z[:-1, live], z[-1, live], member[live])
        jacobian[live, :, :m], jacobian[live, :, m] = np.moveaxis(by_u, -1, 0), by_parameter.T
        right = np.zeros((live.size, m + 1, 1))
        right[:, :m, 0] = -g.T
        change = _solve(jacobian[live], normal[:, live], right)[..., 0].T
        size_of = np.linalg.norm(np.clip(change, -1e100, 1e100), axis=0)  # a step that is far too long has a square
        sound = size_of < _FAR
        z[:, live[sound]] += change[:, sound]
        done = sound & (size_of < tolerance)
        found[live[done]], iterations[live[done]] = True, attempt + 1
        live = live[sound & ~done]
        if live.size == 0:
            break
    return z, jacobian, iterations, found


def _tangent(jacobian, ahead):
    """Unit vectors (m + 1, n) that the Jacobians annihilate, in the sense of the vectors `ahead`."""
    right = np.zeros((len(jacobian), jacobian.shape[2], 1))
    right[:, -1] = 1.0
    vector = _solve(jacobian, ahead, right)[..., 0].T
    return vector / np.linalg.norm(vector, axis=0)


def _solve(jacobian, normal, right):
    matrix = np.concatenate([jacobian, normal.T[:, None, :]], axis=1)
    singular = np.abs(np.linalg.det(matrix)) < 1e-300
    matrix[singular] = np.eye(matrix.shape[-1])  # a step that leads nowhere: rejected by the residual or by the bend
    return np.linalg.solve(matrix, np.where(singular[:, None, None], 1e3, right))


def _returns(first, before, now):
    """Whether the last step passed the first point, in the first point's direction."""
    behind = ((before[0] - first[0]) * first[1]).sum() < 0 <= ((now[0] - first[0]) * first[1]).sum()
    return behind and np.linalg.norm(now[0] - first[0]) <= np.linalg.norm(now[0] - before[0])


def _branch(trail, end):
    z, tangent = (np.array(part).T for part in zip(*trail, strict=True))
    return Branch(z[:-1], z[-1], tangent, end)
