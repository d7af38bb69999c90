"""Lifetimes of transients: how long an orbit wanders before it keeps to the periodic orbit that attracts it.

Chaos above the critical amplitude need not last: orbits follow a chaotic set that repels them, and in the end are
captured. An orbit is called *settled* when its stroboscopic points repeat themselves; its *lifetime* is the number of
forcing periods after which it never leaves the neighbourhood of that periodic orbit again. It is read backwards, from
the end: a near miss counts as wandering.
"""

from typing import NamedTuple

import numpy as np

from .. import checks
from ..blocks import block_for, over_blocks
from ..flow import integrate, stroboscopic_times

LONGEST = 6  # longest period, in forcing periods, of an orbit that is recognised
REPEATS = 12  # successive returns that must agree
_TYPICAL = 160  # periods after which most orbits are captured


class Lifetimes(NamedTuple):
    """Transients of a family, in forcing periods.

    time (*family) : the lifetime, at most the periods asked for
    settled (*family) : whether the orbit was captured in that time; False is a right-censored observation
    multiple (*family) : period of the orbit settled on, in forcing periods; 0 where it did not settle
    end (2, *family) : the last stroboscopic point computed, on the attractor where settled
    growth (periods, *family) : what each period adds to the logarithm of a tangent vector's length, 0 where it was not
        computed; the tangent starts anew with every block
    """

    time: np.ndarray
    settled: np.ndarray
    multiple: np.ndarray
    end: np.ndarray
    growth: np.ndarray


def lifetimes(
    osc, state, periods=1000, settling=150, radius=0.1, tolerance=1e-4, block=40, tangents=0,
    executor=None, progress=None, checkpoint=None, **options,
):  # the problem, then how it is run  # fmt: skip
    """Lifetimes up to `periods` of the family's orbits from `state` at t = 0.

    state : (2,) for all members or (2, *family)
    settling : periods for which an orbit is watched beyond `periods`, since it settles some time after its capture; an
        orbit that needs longer for that counts as wandering
    radius : of the neighbourhood of the attracting orbit, in (x, v); the lifetime depends on its logarithm
    tolerance : two points agree that are nearer than this in (x, v)
    block : periods between two looks, more than LONGEST + REPEATS; the lifetime of an orbit that settles in time
        depends on it only through the point from which it is read backwards
    tangents : 1 for the growth of a tangent vector, 0 for none
    executor, progress, checkpoint : as for `duffing.blocks.over_blocks`
    options, errors : method and options as for `duffing.flow.integrate`
    """
    watched = checks.count("periods", periods) + checks.count("settling", settling, least=0)
    radius, tolerance = checks.positive("radius", radius), checks.positive("tolerance", tolerance)
    if tolerance >= radius:
        raise ValueError(f"tolerance = {tolerance}: must be less than the radius, {radius}")
    tangents, block = int(checks.choice("tangents", tangents, (0, 1))), checks.count("block", block)
    if block <= LONGEST + REPEATS:
        raise ValueError(f"block = {block}: must be more than {LONGEST + REPEATS}, the periods that a look takes")
    state = checks.state(state, checks.model(osc).shape)
    task = {"watched": watched, "radius": radius, "tolerance": tolerance, "look": block, "tangents": tangents}
    run = {"executor": executor, "progress": progress, "checkpoint": checkpoint}
    size = block_for(min(watched, _TYPICAL), **options)
    rows = over_blocks(_followed, osc, state, task | options, block=size, dwindling=True, **run)
    time, multiple, end, growth = rows[0].astype(int), rows[1].astype(int), rows[2:4], rows[4:]
    multiple[time > periods] = 0
    if not tangents:
        growth = np.zeros((watched, time.size))
    shape = osc.shape
    return Lifetimes(
        np.minimum(time, periods).reshape(shape),
        (multiple > 0).reshape(shape),
        multiple.reshape(shape),
        end.reshape(2, *shape),
        growth[:periods].reshape(periods, *shape),
    )


def _followed(osc, state, watched, radius, tolerance, look, tangents, **options):
    """Lifetimes, periods and ends of a block, then its growth if there are tangents: (4 or 4 + watched, n)."""
    size = state.shape[1]
    points, growth = np.zeros((2, watched + 1, size)), np.zeros((watched * tangents, size))
    points[:, 0] = state
    repeats, last = np.zeros(size, dtype=int), np.zeros(size, dtype=int)
    active = np.arange(size)
    for first in range(0, watched, look):
        length = min(look, watched - first)
        part = osc.members(active)
        t = stroboscopic_times(part, length)
        orbit = integrate(part, points[:, first, active], t, tangents=tangents, **options)
        points[:, first + 1 : first + length + 1, active] = orbit.states[:, 1:]
        if tangents:
            growth[first : first + length, active] = orbit.growth[0]
        last[active] = first + length
        repeats[active] = returns(
            points[:, max(0, first + length - LONGEST - REPEATS) : first + length + 1, active], tolerance
        )
        active = active[repeats[active] == 0]
        if active.size == 0:
            break
    found = [
        _read_backwards(points[:, : n + 1, i], q, radius) for i, (q, n) in enumerate(zip(repeats, last, strict=True))
    ]
    return np.concatenate([np.transpose(found), points[:, last, np.arange(size)], growth])


def returns(points, tolerance):
    """Least q <= LONGEST for which the last REPEATS points of (2, n, N) agree with those q before; 0 for none: (N,)."""
    found = np.zeros(points.shape[2], dtype=int)
    for q in range(LONGEST, 0, -1):
        if points.shape[1] >= REPEATS + q:
            later, earlier = points[:, -REPEATS:], points[:, -REPEATS - q : points.shape[1] - q]
            found[(np.hypot(*(later - earlier)) < tolerance).all(axis=0)] = q
    return found


def both_wells(osc, lived, method="auto", **options):
    """Whether the orbit on which each member settled visits both sides of x = 0: boolean (*family), False if unsettled.

    lived : the Lifetimes of the family osc; method, options : as for `duffing.flow.integrate`
    """
    longest = int(lived.multiple.max(initial=1)) or 1
    t = np.arange(longest * 32 + 1)[:, None] / 32 * 2 * np.pi / osc.columns()[3]
    x = integrate(osc, lived.end, t, method=method, **options).states[0].reshape(-1, *osc.shape)
    return lived.settled & (x.min(axis=0) < 0) & (x.max(axis=0) > 0)


def _read_backwards(points, q, radius):
    """Lifetime and period, as the radius sees it, of the orbit (2, n + 1) whose last points repeat after q; n and 0 for
    q = 0."""
    n = points.shape[1] - 1
    if q == 0:
        return n, 0
    cycle = points[:, n - np.arange(n, -1, -1) % q]
    away = np.flatnonzero(np.hypot(*(points - cycle)) > radius)
    # Points that spiral slowly into one agree after a turn of the spiral before they agree from one to the next.
    late = points[:, -REPEATS:]
    distinct = (d for d in range(1, q + 1) if q % d == 0 and np.hypot(*(late[:, d:] - late[:, :-d])).max() < radius)
    return (int(away[-1]) + 1 if away.size else 0), next(distinct)
