"""On which side of W^S an orbit is, from where it goes: a coordinate across W^S that needs nothing backward in time.

For p < 1/2 a creep erases the past, and W^S cannot be followed backward. But what it parts can be told forward: an
orbit that comes down from the outermost point of the right loop passes the saddle orbit and goes over the hump, or it
falls back into its well. The position beside the saddle orbit when the orbit leaves, and the growth along W^U until
then, say how far from W^S it has started. An orbit of W^S itself has come as near to the saddle orbit by then as it
would have been driven away, and what it still lacks counts exp(-34) of what it would at the start. Of the saddle orbit
this needs the expanding direction alone. The other one may contract to nothing, as it does where the orbit sticks.
"""

from typing import NamedTuple

import numpy as np

from .. import checks
from ..errors import NoSaddleOrbitError
from ..flow import integrate
from ..oscillator import Duffing
from .saddle import at_rest
from .shooting import central_orbit

_ROUNDS = 12  # forcing periods over which a direction is carried until it is that of W^U
_LEAST = 0.1  # growth rate along W^U, 1 at the saddle point without damping: below it nothing leaves the hump in time
_NEAR = 0.3  # distance in x from the saddle orbit: an orbit farther away has left the hump
_TIME = 17.0  # from the outermost point to the last look at an orbit
_TOLERANCE = {"rtol": 1e-12, "atol": 1e-14}


class ForwardFrame(NamedTuple):
    """The saddle orbits of N members at n equidistant times of a forcing period, by forward maps alone; dimensionless.

    osc : Duffing, the N members with delta = -1, gamma = 1
    t (n, N), states (2, n, N)
    directions (2, n, N) : unit vectors of (x, v) along W^U, x > 0 at phase 0
    growth (n, N) : logarithm of what the flow stretches them by until the next time
    """

    osc: Duffing
    t: np.ndarray
    states: np.ndarray
    directions: np.ndarray
    growth: np.ndarray


def forward_frame(osc):
    """The ForwardFrame of the family's N saddle orbits, also where they stick.

    Raises ValueError unless delta < 0 < gamma; NoSaddleOrbitError naming the first member whose orbit was not found,
    is no saddle between the wells, or repels so slowly that its neighbours stay on the hump as long as can be computed.
    """
    unit = checks.model(osc).dimensionless().members()
    _refuse(osc, at_rest(unit), "for p < 1 it is at rest at mu = 0, and the damping has no linearisation at v = 0")
    (t, states, maps, _), found = central_orbit(unit)
    _refuse(osc, ~found, "Newton's method, with continuation from weaker forcing, does not find it")
    directions, growth = _unstable(maps)
    _refuse(
        unit, np.abs(states[0]).max(axis=0) >= 1, "the periodic orbit that continues x = 0 is not between the wells"
    )
    rate = growth.sum(axis=0) / t[-1]
    _refuse(osc, ~(rate > 0), "the periodic orbit that continues x = 0 is no longer a saddle")
    slow = (
        f"its neighbours creep, and leave it at a rate below {_LEAST:g}: an interval of positions is caught on the hump"
    )
    _refuse(osc, rate < _LEAST, slow)
    # The orbit's second half mirrors the first: (-x, -v) has the same tangent maps.
    return ForwardFrame(
        unit,
        np.concatenate([t[:-1], t[:-1] + t[-1]]),
        np.concatenate([states, -states], axis=1),
        np.concatenate([directions, directions], axis=1),
        np.concatenate([growth, growth]),
    )


def overshoot(frame, x, t, member):
    """How far from W^S the orbits are that turn at x (n,), v = 0 at the times t (n,): positive where they go over.

    member : (n,) number of the frame's member that each belongs to

    A length along W^U, carried back to the turn by the growth of the linearised flow: continuous, its sign and its zero
    right to exp(-34), its size roughly. Second result (n,): whether an orbit is near the saddle orbit at the last look.
    """
    nodes, step = len(frame.t), (frame.t[1] - frame.t[0])[member]
    first = np.floor(t / step).astype(int) + 1
    looks = first + np.arange(int(np.ceil(_TIME / step.min())) + 1)[:, None]
    times = np.concatenate([t[None], looks * step])
    start = np.array([x, np.zeros_like(x)])
    orbit = integrate(frame.osc.members(member), start, times, **_TOLERANCE)
    away = orbit.states[0, 1:] - frame.states[0, looks % nodes, member]
    entered = np.logical_or.accumulate(away < _NEAR, axis=0)
    left = (entered & (np.abs(away) > _NEAR)) | (~entered & (orbit.states[1, 1:] > 0))
    left[-1] = True
    who, last = np.arange(x.size), left.argmax(axis=0)
    now, before = away[last, who], away[np.maximum(last - 1, 0), who]
    node, near, side = looks[last, who] % nodes, np.abs(now) <= _NEAR, np.sign(now)
    # An orbit that has left was at the distance _NEAR some time between two looks.
    part = np.clip((_NEAR - side * before) / np.where(side * (now - before) > 0, side * (now - before), 1), 0, 1)
    end = looks[last, who] - np.where(near, 0, 1 - part)
    across = np.where(near, now, side * _NEAR) / np.abs(frame.directions[0, node, member])
    return -across * np.exp(_grown(frame, t / step, member) - _grown(frame, end, member)), near


def _grown(frame, number, member):
    """Logarithm of the growth along W^U from time 0 to so many (n,) steps of the frame, whole or not."""
    nodes, whole = len(frame.t), np.floor(number).astype(int)
    within = np.concatenate([np.zeros_like(frame.growth[:1]), frame.growth.cumsum(axis=0)])
    total = whole // nodes * within[-1, member] + within[whole % nodes, member]
    return total + (number - whole) * frame.growth[whole % nodes, member]


def _unstable(maps):
    """Unit vectors (2, m, N) along W^U at the nodes of half a period, the logarithms (m, N) of their growth."""
    directions, growth = np.empty(maps.shape[1:]), np.empty(maps.shape[2:])
    vector = np.full(maps.shape[1::2], np.sqrt(0.5))
    for _ in range(2 * _ROUNDS):
        for j in range(maps.shape[2]):
            directions[:, j] = vector
            vector = np.einsum("ij...,j...->i...", maps[:, :, j], vector)
            stretch = np.hypot(*vector)
            vector, growth[j] = vector / stretch, np.log(stretch)
    return directions, growth


def _refuse(osc, members, reason):
    """Raise NoSaddleOrbitError, naming the first of the members (N,) marked."""
    marked = np.flatnonzero(members)
    if marked.size:
        member = osc.named(marked[0])
        raise NoSaddleOrbitError(f"no saddle orbit for {member} ({marked.size} such members): {reason}")
