"""The stable and unstable manifolds of the saddle orbit as curves in the stroboscopic plane.

A point of W^U at time t has left the saddle orbit's neighbourhood some time ago: it is launched at a small distance
along the unstable direction and carried to t. The flight time is the curve's parameter, and the stroboscopic map adds
one period to it. The launch misses W^U by the square of its distance, across it, and the flow contracts that by about
the distance once more on the way out. W^S is the same with time reversed.
"""

from functools import partial

import numpy as np

from .. import checks
from ..errors import ConvergenceError
from ..flow import integrate
from .saddle import saddle_frame

UNSTABLE, STABLE = 0, 1
DISTANCE = 1e-6  # of the launch from the saddle orbit, in the unit of length sqrt(-delta/gamma)
_MOST = 100_000  # points of a curve
_PERIODS = 20  # after the unperturbed loop's outermost point: a branch that has not grown by then does not


def unstable_manifold(osc, side=1, length=6.0, phase=0.0, spacing=0.02, turn=0.1):
    """One branch of W^U of the saddle orbit at a phase, as a curve (2, n) that starts in the saddle orbit.

    osc : Duffing, a single oscillator with delta < 0 < gamma
    side : 1 for the branch that leaves towards x > 0, -1 for the other
    length : arc length of the curve
    phase : omega t modulo 2 pi at which the plane cuts the flow (radian)
    spacing, turn : the greatest distance of neighbouring points, and the greatest angle (radian) between neighbouring
        chords unless they are shorter than spacing / 100
    Lengths are of (x, v) in the units in which delta = -1, gamma = 1.

    Raises ValueError for invalid input, NoSaddleOrbitError as `saddle_orbit`, DivergedError or ConvergenceError where
    the branch cannot be followed so far.
    """
    return _curve(osc, UNSTABLE, side, length, phase, spacing, turn)


def stable_manifold(osc, side=1, length=6.0, phase=0.0, spacing=0.02, turn=0.1):
    """One branch of W^S: arguments, result and errors as for `unstable_manifold`."""
    return _curve(osc, STABLE, side, length, phase, spacing, turn)


def launch(frame, kind, t, member=0, side=1):
    """Points on W^U (kind UNSTABLE) or W^S (STABLE) at DISTANCE from the saddle orbit at about the times t (n,).

    member : (n,) number of the frame's member that each point belongs to
    A launch starts at a time of the frame, before t on W^U, after t on W^S, and nearer to the saddle orbit by what the
    flow stretches until t. Returns its time (n,), its state (2, n) and the derivative of the state by t (2, n).
    """
    nodes = len(frame.t)
    step = np.broadcast_to((frame.t[1] - frame.t[0])[member], t.shape)
    number = np.floor(t / step)
    part = t / step - number  # from 0 to 1 between two times of the frame
    node = number.astype(int) % nodes
    growth = frame.growth[kind, node, member]
    if kind == STABLE:
        node, number, part = (node + 1) % nodes, number + 1, part - 1
    offset = side * DISTANCE * np.exp(-growth * part) * frame.directions[kind][:, node, member]
    return number * step, frame.states[:, node, member] + offset, -growth / step * offset


def _curve(osc, kind, side, length, phase, spacing, turn):
    checks.single(osc)
    checks.choice("side", side, (1, -1))
    named = ("length", length), ("spacing", spacing), ("turn", turn)
    length, spacing, turn = (checks.positive(*pair) for pair in named)
    if length > _MOST * spacing:
        raise ValueError(f"length = {length}, spacing = {spacing}: must not ask for more than {_MOST} points")
    frame = saddle_frame(osc)
    section = checks.number("phase", phase) % (2 * np.pi) / frame.osc.omega[0]
    points_at = partial(_points, frame, kind, side, section)
    piece, total = frame.osc.period[0] / 32 * np.linspace(0, 1, 5), 0.0
    flight, curve = np.zeros(1), points_at(np.zeros(1))
    while total < length:
        more = flight[-1] + piece
        points = np.append(curve[:, -1:], points_at(more[1:]), axis=1)
        more, points = _refined(more, points, points_at, spacing, turn)
        flight, curve = np.append(flight, more[1:]), np.append(curve, points[:, 1:], axis=1)
        total = np.hypot(*np.diff(curve)).sum()
        if flight[-1] > np.log(4 / DISTANCE) + _PERIODS * frame.osc.period[0] and total < length:
            raise ConvergenceError(f"length = {length}: the branch is {total:.4g} long and goes into an attractor")
    _, curve = _refined(flight, curve, points_at, spacing, turn)  # across the joints of the pieces
    keep = np.append(0, np.hypot(*np.diff(curve)).cumsum()) <= length
    return curve[:, keep] * osc.units()[:2, None]


def _refined(flight, curve, points_at, spacing, turn):
    """Halve the intervals of the flight time until points are as near, and chords as aligned, as asked."""
    while True:
        chord = np.diff(curve)
        distance, heading = np.hypot(*chord), np.arctan2(chord[1], chord[0])
        bend = np.abs((np.diff(heading) + np.pi) % (2 * np.pi) - np.pi) > turn
        bent = np.append(bend, False) | np.append(False, bend)
        where = np.flatnonzero((distance > spacing) | (bent & (distance > spacing / 100)))
        if where.size == 0:
            return flight, curve
        if flight.size + where.size > _MOST:
            raise ConvergenceError(f"the curve needs more than {_MOST} points")
        middle = (flight[where] + flight[where + 1]) / 2
        flight = np.insert(flight, where + 1, middle)
        curve = np.insert(curve, where + 1, points_at(middle), axis=1)


def _points(frame, kind, side, section, flight):
    """States (2, n) at the time `section` of the points whose flight takes the times (n,)."""
    start, points, _ = launch(frame, kind, section - flight if kind == UNSTABLE else section + flight, side=side)
    moving = start != section
    times = np.array([start[moving], np.full(moving.sum(), section)])
    if moving.any():
        family = frame.osc.repeated(moving.sum())
        points[:, moving] = integrate(family, points[:, moving], times).states[:, 1]
    return points
