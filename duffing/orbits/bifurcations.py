"""Branches of periodic orbits in one parameter, the bifurcations on them, and their loci in a second parameter.

The test functions are values of the characteristic polynomial of the derivative D of N^k (see `periodic`):

    fold: det(D - 1) = 1 - tr D + det D = 0,       flip: det(D + 1) = 1 + tr D + det D = 0.

A flip of an even power of N is a period doubling, that of an odd power the breaking of the symmetry. No other
bifurcation is generic: det D < 1 leaves no pair of multipliers on the unit circle.
"""

from typing import NamedTuple

import numpy as np

from .. import checks
from ..errors import ConvergenceError
from ..oscillator import FIELDS, Duffing
from .continuation import correct, follow_branches
from .periodic import half_period_map, multipliers_of

FOLD, FLIP = "fold", "flip"
_SIGN = {FOLD: -1.0, FLIP: 1.0}
_SHIFT = 1e-6  # of finite differences: the maps' error of 1e-10 leaves a derivative right to 1e-4


class OrbitBranch(NamedTuple):
    """A branch of n periodic orbits: N^k (state) = state, k = halves.

    osc : the family of n members; field : the name of the parameter that varies along the branch
    state (2, n), parameter (n,), multipliers (2, n) : of N^k, the larger modulus first
    end : how it ended, as in `continuation.Branch`
    """

    osc: Duffing
    field: str
    halves: int
    state: np.ndarray
    parameter: np.ndarray
    multipliers: np.ndarray
    end: str

    @property
    def stable(self):
        """Which of the orbits attract (n,)."""
        return np.abs(self.multipliers[0]) < 1


class Bifurcation(NamedTuple):
    """A bifurcation of N^k, k = halves: kind "fold" or "flip", the oscillator where it happens, state (2,) and the
    direction (2,) in which N^k stretches by +1 or -1; index : the point of the branch before it."""

    kind: str
    osc: Duffing
    halves: int
    state: np.ndarray
    direction: np.ndarray
    index: int


def orbit_branches(osc, state, halves=2, *, field="mu", bounds=(0.0, 0.5), options=None, **steps):
    """Branches of periodic orbits through the guesses, in the parameter `field`: a list of OrbitBranch.

    osc : family of N members, the starts; state (2, N); halves : a number or (N,)
    bounds : of the parameter; options : of the integrator; steps : as for `continuation.follow_branches`
    """
    checks.choice("field", field, FIELDS)
    starts = checks.model(osc).members()
    halves = checks.counts("halves", halves, starts.mu.size)
    function = _closing(starts, field, halves, options or {})
    found = follow_branches(function, checks.state(state, osc.shape), getattr(starts, field), bounds=bounds, **steps)
    sizes = [branch.parameter.size for branch in found]
    member = np.repeat(np.arange(len(found)), sizes)
    family = starts.members(member, **{field: np.concatenate([branch.parameter for branch in found])})
    every = np.concatenate([branch.u for branch in found], axis=1)
    multipliers = multipliers_of(half_period_map(family, every, halves[member], **(options or {})))
    result = []
    for j, branch in enumerate(found):
        own = member == j
        orbits = family.members(own), field, int(halves[j]), branch.u, branch.parameter, multipliers[:, own]
        result.append(OrbitBranch(*orbits, branch.end))
    return result


def bifurcations(branches):
    """The bifurcations on branches of one field, each located by Newton's method: a list of lists of Bifurcation.

    They are found where a test function changes its sign between two points; a pair of changes between two neighbouring
    points escapes. Raises ConvergenceError where Newton's method does not settle.
    """
    guesses, names = [], []
    for number, branch in enumerate(branches):
        for kind in (FOLD, FLIP):
            value = np.prod(1 + _SIGN[kind] * branch.multipliers, axis=0).real
            for j in np.flatnonzero(value[1:] * value[:-1] < 0):
                share = value[j] / (value[j] - value[j + 1])
                z = np.vstack([branch.state, branch.osc.columns()])
                guesses.append(z[:, j] + share * (z[:, j + 1] - z[:, j]))
                names.append((number, kind, j, branch.halves, branch.field))
    result = [[] for _ in branches]
    if not guesses:
        return result
    guesses = np.array(guesses).T
    field = names[0][-1]
    if any(name[-1] != field for name in names):
        raise ValueError(f"branches vary {sorted({name[-1] for name in names})}: must be of one field")
    other = "p" if field != "p" else "mu"  # unused: Newton's method keeps it
    kinds, halves = [name[1] for name in names], np.array([name[3] for name in names])
    near = Duffing(*guesses[2:])
    function = _degenerate(near, field, other, halves, kinds, {})
    z = np.vstack([guesses[:2], getattr(near, field), getattr(near, other)])
    normal = np.zeros_like(z)
    normal[-1] = 1.0
    z, _, _, settled = correct(function, z, normal, np.arange(z.shape[1]), 1e-8)
    if not settled.all():
        bad = np.argmin(settled)
        raise ConvergenceError(f"the {kinds[bad]} near {field} = {getattr(near, field)[bad]:g} is not found")
    family = near.members(**{field: z[2]})
    directions = _directions(half_period_map(family, z[:2], halves).derivative, kinds)
    for j, (number, kind, index, k, _) in enumerate(names):
        result[number].append(Bifurcation(kind, family.members(j), k, z[:2, j], directions[:, j], int(index)))
    return [sorted(found, key=lambda one: one.index) for found in result]


def switch_branches(flips, *, field="mu", bounds=(0.0, 0.5), distance=0.01, options=None, **steps):
    """The branches of orbits with twice the `halves` that leave the flips: a list of OrbitBranch.

    The asymmetric orbits at a symmetry breaking, the doubled ones at a period doubling. The first point is off the old
    branch by the distance along the flip's direction.
    """
    halves = np.array([2 * flip.halves for flip in flips])
    family = Duffing.joined([flip.osc for flip in flips])
    directions = np.vstack([np.array([flip.direction for flip in flips]).T, np.zeros(len(flips))])
    state = np.array([flip.state for flip in flips]).T + distance * directions[:2]
    return orbit_branches(
        family, state, halves, field=field, bounds=bounds, options=options, direction=directions, **steps
    )


def bifurcation_curves(found, *, field="mu", second="p", bounds=(0.1, 3.0), options=None, **steps):
    """Curves of bifurcations in the plane of two parameters: a list of Branch, u = (x, v, field), parameter = second.

    found : list of Bifurcation, the starts; bounds : of the second parameter; steps : as for `follow_branches`
    """
    starts = Duffing.joined([one.osc for one in found])
    halves = np.array([one.halves for one in found])
    function = _degenerate(starts, field, second, halves, [one.kind for one in found], options or {})
    u = np.vstack([np.array([one.state for one in found]).T, getattr(starts, field)])
    return follow_branches(function, u, getattr(starts, second), bounds=bounds, tolerance=1e-7, **steps)


def _closing(osc, field, halves, options):
    """g = N^k (u) - u and its derivatives, for `follow_branches`."""

    def function(u, parameter, member):
        size = member.size
        family = osc.members(np.tile(member, 2), **{field: np.concatenate([parameter, parameter + _SHIFT])})
        done = half_period_map(family, np.tile(u, 2), np.tile(halves[member], 2), **options)
        by_parameter = (done.image[:, size:] - done.image[:, :size]) / _SHIFT
        return done.image[:, :size] - u, done.derivative[:, :, :size] - np.eye(2)[:, :, None], by_parameter

    return function


def _degenerate(osc, field, second, halves, kinds, options):
    """g = (N^k (x, v) - (x, v), characteristic polynomial of the derivative at +1 or -1) of u = (x, v, field)."""
    sign = np.array([_SIGN[kind] for kind in kinds])

    def function(u, parameter, member):
        size = member.size
        z = np.tile(np.vstack([u, parameter]), 5)
        for row in range(4):
            z[row, (row + 1) * size : (row + 2) * size] += _SHIFT
        family = osc.members(np.tile(member, 5), **{field: z[2], second: z[3]})
        done = half_period_map(family, z[:2], np.tile(halves[member], 5), **options)
        trace = done.derivative[0, 0] + done.derivative[1, 1]
        test = 1 + np.tile(sign[member], 5) * trace + np.exp(done.log_area)
        value = np.vstack([done.image - z[:2], test]).reshape(3, 5, size)
        by_all = (value[:, 1:] - value[:, :1]) / _SHIFT
        by_all[:2, :2] = done.derivative[:, :, :size] - np.eye(2)[:, :, None]
        return value[:, 0], by_all[:, :3], by_all[:, 3]

    return function


def _directions(derivative, kinds):
    """Unit vectors (2, n) that the derivative multiplies by +1 (fold) or -1 (flip)."""
    sign = np.array([_SIGN[kind] for kind in kinds])
    (a, b), (c, d) = derivative + sign * np.eye(2)[:, :, None]
    first = np.hypot(a, b) > np.hypot(c, d)
    vector = np.where(first, [-b, a], [-d, c])
    return vector / np.hypot(*vector)
