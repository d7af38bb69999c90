"""The attractors of one oscillator, and where starts end: labels by the attractor that has caught the state.

A periodic attractor has caught a state when the state lies in its trapping disk (`trapping`), which the flow carries
into itself. A chaotic one, when the state has stayed in the cells that the attractor visits for STREAK periods on end.
What is not caught is not given away: it is searched for orbits not yet known, and what is left is UNRESOLVED. Lengths
in (x, v) are for wells about as large as those of delta = -1, gamma = 1; for others see `Duffing.dimensionless`.
"""

from typing import NamedTuple

import numpy as np

from .. import checks
from ..blocks import block_for, over_blocks
from ..flow import integrate
from ..lyapunov import lyapunov_spectrum
from ..orbits.periodic import half_period_map, path, periodic_orbits
from .capture import UNRESOLVED, capture, first_capture, points_of
from .trapping import Trap, trap

CELL = 0.02  # width of a chaotic attractor's cells in x and v
LONGEST, NEAR = 16, 1e-2  # longest period looked for, and how nearly a state must return for Newton's method to try
_SAMPLE = 24  # states not yet caught that a search takes
# Chaotic orbits followed, the periods for which none of them may be caught, and those over which they are stretched.
_WITNESSES, _PROOF, _STRETCH = 32, 500, 200


class Cells(NamedTuple):
    """The cells that an orbit visits: corner (2,) of the first one, visited (nx, nv) boolean."""

    corner: np.ndarray
    visited: np.ndarray

    def holds(self, states):
        """Which of the states (2, ...) lie in a visited cell: boolean array (...)."""
        i, j = (np.floor((part - low) / CELL).astype(int) for part, low in zip(states, self.corner, strict=True))
        nx, nv = self.visited.shape
        inside = (i >= 0) & (i < nx) & (j >= 0) & (j < nv)
        return inside & self.visited[np.clip(i, 0, nx - 1), np.clip(j, 0, nv - 1)]


class Attractor(NamedTuple):
    """An attractor at phase 0.

    place : "left" or "right" (of x = 0 all the time) or "both"
    period : in forcing periods; 0 for a chaotic attractor
    points (2, n) : its stroboscopic points, n = period, or a sample of a chaotic attractor
    amplitude : half the range of x
    multipliers : complex (2,), of the half map's power that closes the orbit (`periodic`); empty for chaos
    region : Trap or Cells
    """

    place: str
    period: int
    points: np.ndarray
    amplitude: float
    multipliers: np.ndarray
    region: Trap | Cells

    @property
    def name(self):
        """Such as "left well, period 1"."""
        where = "both wells" if self.place == "both" else f"{self.place} well"
        return f"{where}, period {self.period}" if self.period else f"{where}, chaotic"


class Settled(NamedTuple):
    """labels (N,) : index into attractors, or UNRESOLVED; periods (N,) : forcing periods until the state was caught,
    from the first phase 0 on, infinite for the unresolved; attractors : those given and those found on the way."""

    labels: np.ndarray
    periods: np.ndarray
    attractors: tuple


def find_attractors(osc, starts=None, periods=400, **options):
    """The attractors that the starts reach: a tuple of Attractor, in the order left, right, both, chaotic ones last.

    osc : a single oscillator; starts : (2, M) at phase 0, by default a grid of 16 x 12 over |x| <= 1.6, |v| <= 1.2
    periods : that a start is followed. What is left then, at most 32 states, is followed for 500 more; when none of
        them is caught in that time and their largest exponents are positive, by three standard errors and by more than
        regular motion has in so short a time, they are on a chaotic attractor (a transient would have to last some
        thousand periods on average); otherwise, or without damping, on none.
    options : method and options as for `duffing.flow.integrate`

    No search from finitely many starts can promise to be complete: `settle` goes on looking. Chaotic attractors in the
    same place are not told apart. Errors as for `integrate`.
    """
    if starts is None:
        starts = np.reshape(np.meshgrid(np.linspace(-1.6, 1.6, 16), np.linspace(-1.2, 1.2, 12)), (2, -1))
    settled, left = _settle(osc, checks.starts(starts), (), periods, 0.0, {}, options)
    return ordered(settled.attractors + (_chaotic(osc, left, settled.attractors, options) if left.size else ()))


def settle(
    osc, states, attractors=(), periods=200, phase=0.0, executor=None, progress=None, checkpoint=None, **options
):
    """Follow states until an attractor has caught them: Settled.

    osc : a single oscillator; states : (2, N) at the forcing phase `phase` (radian)
    attractors : known ones, as from `find_attractors`; periodic ones that are not among them are found on the way and
        come after them; periods : the most that a state is followed
    executor, progress, checkpoint : as for `duffing.blocks.over_blocks`, which is called once between two searches for
        attractors not yet known (after 32, 64, 128 ... periods), with the states that nothing has caught
    options, errors : method and options as for `duffing.flow.integrate`
    """
    run = {"executor": executor, "progress": progress, "checkpoint": checkpoint}
    known = checks.instances("attractors", attractors, Attractor)
    return _settle(osc, checks.starts(states, "states"), known, periods, phase, run, options)[0]


def ordered(attractors):
    """The same in the order left, right, both; in a place by their amplitude, chaotic ones last."""

    def rank(one):
        place = ("left", "right", "both").index(one.place)
        return place, one.period == 0, round(one.amplitude, 6), -one.points[0].max()

    return tuple(sorted(attractors, key=rank))


def _settle(osc, now, attractors, periods, phase, run, options):
    """Settled from the states `now` (2, N), and those that nothing has caught, as they are at the end (2, n).

    run : how, for `over_blocks`
    """
    checks.single(osc)
    periods = checks.count("periods", periods)
    labels, caught = np.full(now.shape[1], UNRESOLVED), np.full(now.shape[1], np.inf)
    live, streaks = np.arange(now.shape[1]), np.zeros((len(attractors), now.shape[1]))
    first, search = 0, 2 * LONGEST
    start = checks.number("phase", phase) % (2 * np.pi) / osc.omega
    while True:
        last = min(search, periods)
        regions = tuple((one.period, one.region) for one in attractors)
        task = {"regions": regions, "first": first, "last": last, "start": start, **options}
        size, state = block_for(last - first, **options), np.vstack([now, streaks])
        rows = over_blocks(capture, osc.repeated(now.shape[1]), state, task, block=size, dwindling=True, **run)
        label, hit = rows[0].astype(int), rows[0] != UNRESOLVED
        labels[live[hit]], caught[live[hit]] = label[hit], rows[1, hit]
        live, now, streaks = live[~hit], rows[2:4, ~hit], rows[4:, ~hit]
        if live.size == 0 or last == periods:
            return Settled(labels, caught, attractors), now
        found = _unknown(osc, now, attractors, options)
        streaks = np.vstack([streaks, np.zeros((len(found), live.size))])
        attractors, first, search = attractors + found, last, 2 * search


def _unknown(osc, states, known, options):
    """Periodic attractors near some of the states (2, n) that are not among the known ones, each with its mirror."""
    sample = states[:, :: -(-states.shape[1] // _SAMPLE)]
    sign = (-1.0) ** np.arange(2 * LONGEST + 1)
    half = np.arange(2 * LONGEST + 1) * osc.period / 2
    returns = integrate(osc.repeated(sample.shape[1]), sample, half, **options).states * sign[:, None]
    distance = np.hypot(*(returns[:, 1:] - sample[:, None]))
    # The first near return may be to an orbit that has just doubled its period, the nearest to one not yet doubled.
    least = distance.min(axis=0)
    near = least < NEAR
    closes = 1 + np.array([(distance < NEAR).argmax(axis=0), (distance <= 3 * least).argmax(axis=0)])
    new = []
    for halves in sorted(set(closes[:, near].ravel().tolist())):
        orbits = periodic_orbits(osc, sample[:, near & (closes == halves).any(axis=0)], halves)
        for state, multipliers in zip(orbits.state.T, orbits.multipliers.T, strict=True):
            for one in _mirrored(osc, state, multipliers, halves, options):
                if not any(_same(one, other) for other in (*known, *new)):
                    new.append(one)
    return tuple(new)


def _mirrored(osc, state, multipliers, halves, options):
    """The attractor through the state, and its mirror image where that is another one; none if it does not attract."""
    if np.abs(multipliers[0]) >= 1:
        return
    for point in (state, half_period_map(osc, state, 1).image[:, 0])[: 1 + (halves % 2 == 0)]:

        def follow(states, repeats):
            family, t = osc.repeated(states.shape[1]), np.array([0.0, repeats * halves * osc.period / 2])
            return (-1) ** (repeats * halves) * integrate(family, states, t, **options).states[:, 1]

        region = trap(follow, point, half_period_map(osc, point, halves).derivative[:, :, 0])
        if region is not None:
            period = halves if halves % 2 else halves // 2
            curve = path(osc, point, 2 * period, 64 * period)
            amplitude = float(np.ptp(curve[0]) / 2)
            yield Attractor(_place(curve[0]), period, curve[:, :-1:64], amplitude, multipliers, region)


def _chaotic(osc, states, known, options):
    """The chaotic attractors on which the states (2, n) are, a tuple; none if one of them is caught after all."""
    sample = states[:, :: -(-states.shape[1] // _WITNESSES)]
    points = points_of(osc, sample, _PROOF, options)
    regions = [(one.period, one.region) for one in known]
    caught = first_capture(regions, points, np.zeros((len(known), sample.shape[1])))[0] != UNRESOLVED
    if osc.alpha == 0 or caught.any():
        return ()
    spectrum = lyapunov_spectrum(osc.repeated(sample.shape[1]), sample, periods=_STRETCH, transient=0, k=1, **options)
    # The tangents of regular motion grow as well, in proportion to time: chaos stretches them by more than its square.
    least = 2 * np.log(_STRETCH) / (_STRETCH * osc.period)
    if np.any(spectrum.exponents <= np.maximum(3 * spectrum.error, least)):
        return ()
    half = integrate(osc.repeated(sample.shape[1]), sample, np.linspace(0, 10, 161) * osc.period, **options).states
    mirror = -integrate(osc.repeated(sample.shape[1]), sample, np.array([0.0, osc.period / 2]), **options).states[:, 1]
    points = np.concatenate([points, points_of(osc, mirror, _PROOF, options)], axis=2)
    places = [_place(x) for x in half[0].T]
    places = np.array(places + [{"left": "right", "right": "left"}.get(place, place) for place in places])
    found = []
    for place in sorted(set(places)):
        cloud = points[:, :, places == place].reshape(2, -1)
        amplitude = float(np.ptp(half[0]) / 2)
        found.append(Attractor(str(place), 0, cloud, amplitude, np.empty(0, dtype=complex), _cells(cloud)))
    return tuple(found)


def _cells(cloud):
    corner = cloud.min(axis=1)
    i, j = np.floor((cloud - corner[:, None]) / CELL).astype(int)
    visited = np.zeros((i.max() + 1, j.max() + 1), dtype=bool)
    visited[i, j] = True
    return Cells(corner, visited)


def _same(one, other):
    return one.period == other.period and np.min(np.hypot(*(other.points - one.points[:, :1]))) < 1e-4


def _place(x):
    return "right" if np.all(x > 0) else "left" if np.all(x < 0) else "both"
