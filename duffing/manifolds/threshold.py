"""Splitting and tangency by following orbits forward only: for small p, where W^S cannot be followed backward.

On v = 0, x > 1 at a phase there is a threshold x_s: orbits that turn below it fall back into the well, orbits that turn
above it go over the hump. That is W^S. An orbit launched on W^U turns at x_u, goes on, and passes the saddle orbit on
the one side or the other. So the manifolds touch at a mu from which an orbit of W^U goes over. All here is
dimensionless: delta = -1, gamma = 1.
"""

import numpy as np
from scipy.optimize import elementwise

from .. import checks
from ..errors import ConvergenceError
from ..flow import integrate
from ..integrators.friction_time.turning_points import to_turning_point
from .curves import DISTANCE
from .passage import forward_frame, overshoot

_LOWEST, _HIGHEST = 1.01, 2.5  # bracket of x_s: from x = 1, a place of rest, a motion without force never starts
_WELL = 0.5  # |x| beyond which an orbit from the hump is in a well
_ALL_ROUND, _LAUNCHES = 65, 17  # launches from one point of W^U to its image, and in a window about the best of them
_ZOOMS = 8  # each makes the window four times narrower
_FLAT = 0.01  # of the height: neighbours that are lower by less are as high
_FAR = 1e-3  # at most, the image's distance: a long period would carry it from DISTANCE out of the linearised flow
_NEAREST = (
    1e-14  # launch: rounding errors of the saddle orbit shift it along W^U; splitting at a phase then errs by 1e-6
)
_MARGIN = 0.05  # the image is known to the first order in the distance of the launch
_FACTOR, _STEPS = 1.03, 30  # of mu from one trial to the next in search of a bracket
_EXACT = {"xatol": 1e-14, "xrtol": 0, "fatol": 0, "frtol": 0}
_TOLERANCE = {"xatol": 0, "xrtol": 1e-10, "fatol": 0, "frtol": 0}  # of the tangency
_JUMP = 1e-6  # of mu: a height beyond it on both sides of the root, 1e-10 mu apart, does not vanish there
_SKIP = 1e-4  # of the period, likewise: rounding errors at low frequencies leave up to 1e-5 of it at a root


def threshold(frame, phase, member):
    """x_s (n,) at the phases (n,) of the frame's members (n,): the ForwardFrame of `forward_frame`.

    Raises ConvergenceError where no x_s from 1.01 to 2.5 parts the orbits that fall back from those that go over.
    """

    def side(x, t, member):
        return overshoot(frame, x.ravel(), t.ravel(), member.ravel())[0].reshape(x.shape)

    t = phase / frame.osc.omega[member]
    ends = np.full(t.shape, _LOWEST), np.full(t.shape, _HIGHEST)
    found = elementwise.find_root(side, ends, args=(t, member), tolerances=_EXACT)
    missing = np.flatnonzero(~found.success)
    # At a jump between both sides, no orbit would stay near the saddle orbit.
    if missing.size == 0:
        missing = np.flatnonzero(~overshoot(frame, found.x, t, member)[1])
    if missing.size:
        raise ConvergenceError(
            f"{frame.osc.named(member[missing[0]])}: on v = 0 at the phase {phase[missing[0]]:g} no x from {_LOWEST:g} "
            f"to {_HIGHEST:g} (dimensionless) parts the orbits that fall back from those that go over the hump"
        )
    return found.x


def launched(frame, place, member):
    """Where orbits launched on the right branch of W^U next turn with x > 1: a TurningPoint of n orbits.

    place : (n,), 0 for a point of W^U near the saddle orbit, 1 for its image a period later: that too is so near that
        the linearised flow still says where W^U is

    Raises ConvergenceError where no distance suits both.
    """
    stretch = frame.growth.sum(axis=0)[member]
    distance = np.minimum(DISTANCE, _FAR * np.exp(-stretch))
    lost = np.flatnonzero(distance < _NEAREST)
    if lost.size:
        raise ConvergenceError(
            f"{frame.osc.named(member[lost[0]])}: over a period orbits leave the saddle orbit by a factor of "
            f"{np.exp(stretch[lost[0]]):.0e}, too much for doubles to tell where W^U is"
        )
    node = frame.growth.argmax(axis=0)[member]  # where the orbit creeps least
    direction = frame.directions[:, node, member]
    offset = distance * np.exp(place * stretch) * np.sign(direction[0]) * direction
    return to_turning_point(
        frame.osc.members(member), frame.states[:, node, member] + offset, frame.t[node, member], beyond=1.0
    )


def crossing(frame, phase, member):
    """x_u (n,) where the right branch of W^U first crosses v = 0, x > 1 at the phases (n,); errors as `threshold`."""
    period = frame.osc.period[member]

    def late(place, t, member):
        return launched(frame, place.ravel(), member.ravel()).t.reshape(place.shape) - t

    ends = np.full(phase.shape, -_MARGIN), np.full(phase.shape, 1 + _MARGIN)
    t = phase / frame.osc.omega[member]
    t = t + period * np.floor((launched(frame, np.zeros(phase.size), member).t - t) / period)
    found = elementwise.find_root(late, ends, args=(t, member), tolerances=_EXACT)
    # Where the mass comes to rest under a force that holds it there, no orbit turns for a while: the time jumps.
    crosses = found.success & (np.abs(found.f_x) <= _SKIP * period)
    if not crosses.all():
        missing = np.argmin(crosses)
        raise ConvergenceError(
            f"{frame.osc.named(member[missing])}: W^U has no first crossing of v = 0, x > 1 "
            f"(dimensionless) at the phase {phase[missing]:g}: orbits that leave the hump then come to rest in the well"
        )
    return launched(frame, found.x, member).x


def split(frame, phase):
    """x_u - x_s (n, N) at the phases (n,)."""
    size = frame.osc.mu.size
    member, each = np.tile(np.arange(size), phase.size), np.repeat(phase, size)
    return (crossing(frame, each, member) - threshold(frame, each, member)).reshape(phase.size, size)


def highest(frame):
    """Greatest overshoot (N,) of the orbits of W^U: positive where one of them goes over the hump.

    The launches draw together about the best of them until their neighbours are as high, in proportion to the height:
    near zero the whole way. No smoothness is assumed; the peak must be wider than two launches of the first round.
    """
    left = np.arange(frame.osc.mu.size)
    result, centre = np.empty(left.size), np.full(left.size, 0.5)
    width, launches = 0.5 + _MARGIN, _ALL_ROUND
    for _ in range(1 + _ZOOMS):
        place = centre[left] + width * np.linspace(-1, 1, launches)[:, None]
        member = np.tile(left, launches)
        turn = launched(frame, place.ravel(), member)
        height = overshoot(frame, turn.x, turn.t, member)[0].reshape(place.shape)
        best, who = height.argmax(axis=0), np.arange(left.size)
        result[left], centre[left] = height[best, who], place[best, who]
        beside = np.minimum(height[np.maximum(best - 1, 0), who], height[np.minimum(best + 1, launches - 1), who])
        left = left[result[left] - beside > _FLAT * np.abs(result[left])]
        if left.size == 0:
            break
        width, launches = 4 * width / (launches - 1), _LAUNCHES
    return result


def tangency(unit):
    """The mu (N,) at which W^U and W^S of the dimensionless family touch, near its own mu (N,).

    The sign change nearest that mu that the search meets; a smaller one is not excluded. Raises NoSaddleOrbitError as
    `forward_frame`, ConvergenceError where none is between 0.4 and 2.4 times that, or where the splitting jumps.
    """

    def top(mu, member):
        forced = unit.members(member.ravel(), mu=mu.ravel())
        return highest(forward_frame(forced)).reshape(mu.shape)

    mu, who = unit.mu, np.arange(unit.mu.size)
    over, near, far, left = top(mu, who) > 0, np.array(mu), np.array(mu), who
    for _ in range(_STEPS):
        far[left] = near[left] * np.where(over[left], 1 / _FACTOR, _FACTOR)
        left = left[(top(far[left], left) > 0) == over[left]]
        if left.size == 0:
            bracket = np.minimum(near, far), np.maximum(near, far)
            found = elementwise.find_root(top, bracket, args=(who,), tolerances=_TOLERANCE)
            jumps = np.flatnonzero(~(np.abs(found.f_x) <= _JUMP * mu))
            if jumps.size:
                raise ConvergenceError(
                    f"{unit.named(jumps[0])}: near mu = {found.x[jumps[0]]:g} (dimensionless) the splitting jumps "
                    "instead of vanishing"
                )
            return found.x
        near[left] = far[left]
    raise ConvergenceError(
        f"{unit.named(left[0])}: no tangency was found at mu between {min(mu[left[0]], far[left[0]]):g} and "
        f"{max(mu[left[0]], far[left[0]]):g} (dimensionless)"
    )


def caught(osc, phase, periods=20):
    """The ends (2,) of the interval on v = 0, x > 1 (dimensionless) from which orbits neither fall back nor go over.

    osc : a single oscillator, delta < 0 < gamma; phase : omega t (radian); periods : for which they stay on the hump

    Where the saddle orbit repels, the interval shrinks to the point x_s as the periods grow: after a few its width is
    rounding error. Where friction wins over the force, mu below about alpha at small p, the mass comes all but to rest
    wherever it arrives, and the interval stays. Lengths in the oscillator's own unit. Errors as for `trajectory`,
    ConvergenceError where orbits from x = 1.01 do not fall back or those from 2.5 do not go over.
    """
    unit = checks.single(osc).dimensionless()
    checks.double_well(osc)
    count = checks.count("periods", periods)
    t = checks.number("phase", phase) / unit.omega + unit.period / 32 * np.arange(32 * count + 1)
    bounds = np.array([[_LOWEST, _HIGHEST], [_LOWEST, _HIGHEST]])
    ends = _fates(unit, bounds[0], t)
    if tuple(ends) != (-1, 1):
        raise ConvergenceError(
            f"{osc.named()}: the fates from the ends of the search are {ends.tolist()}, not -1 and 1"
        )
    while True:
        middle = bounds.mean(axis=1)
        if np.all((middle == bounds[:, 0]) | (middle == bounds[:, 1])):
            return middle * osc.units()[0]
        fates = _fates(unit, middle, t)
        above = fates > np.array([-1, 0])  # of the lower end, of the upper end
        bounds[:, 1], bounds[:, 0] = np.where(above, middle, bounds[:, 1]), np.where(above, bounds[:, 0], middle)


def _fates(unit, x, t):
    """-1 where the orbit from rest at x (n,) falls back first, 1 where it goes over the hump first, 0 where neither."""
    orbit = integrate(unit.repeated(x.size), np.array([x, np.zeros_like(x)]), t, rtol=1e-12, atol=1e-14).states
    back, over = (orbit[0] > _WELL) & (orbit[1] > 0), orbit[0] < -_WELL
    first = (back | over).argmax(axis=0), np.arange(x.size)
    return over[first].astype(int) - back[first]
