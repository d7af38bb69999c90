"""The boundary crisis: chaos meets the stable manifold of a saddle orbit on the border of another orbit's basin.

The chaotic set lies along the unstable manifold W^U of the saddle orbit near x = 0. On the border of the basin of the
large orbit round both wells lies the large saddle orbit, whose stable manifold is that border. W^U is followed from one
fundamental domain of it, and its distance from the border is read where an orbit comes nearest to the large saddle
orbit: the unstable coordinate there, in which the border is the line 0. It is positive as long as chaos keeps to its
side; at zero the two manifolds touch, a heteroclinic tangency, and beyond it orbits leak out. (Grebogi, Ott and Yorke.)
Lengths in (x, v) are for wells about as large as with delta = -1, gamma = 1; for others see `Duffing.dimensionless`.
"""

from typing import NamedTuple

import numpy as np

from .. import checks
from ..errors import ConvergenceError
from ..flow import integrate, stroboscopic_times
from ..orbits.periodic import half_period_map, periodic_orbit, periodic_orbits

TOLERANCE = {"rtol": 1e-8, "atol": 1e-10}
REACH = 0.25  # from the large saddle orbit within which its linear coordinate is used
_ZOOMS = 12  # neighbourhoods looked at more closely
_LAUNCH = 1e-6  # from the inner saddle orbit, along its unstable direction
_PARTS = 4  # of a step in mu, over which the large saddle orbit is followed
_SEARCH = np.reshape(np.meshgrid(np.linspace(-1.6, -0.2, 8), np.linspace(0.8, 1.5, 5)), (2, -1))


class Saddles(NamedTuple):
    """The two saddle orbits of a family of n oscillators, as fixed points of the half map (`periodic`).

    inner, outer : (2, n) states at phase 0, near x = 0 and round both wells
    unstable : (2, n) unit vector along W^U of the inner one; normal : (2, n) unit vector across W^S of the outer one,
        towards x = 0
    multipliers : (2, n) of the inner one over the half map, the unstable one first, in modulus
    expansion : (n,) unstable multiplier of the outer one over the half map, in modulus
    """

    inner: np.ndarray
    outer: np.ndarray
    unstable: np.ndarray
    normal: np.ndarray
    multipliers: np.ndarray
    expansion: np.ndarray


def large_saddle(osc):
    """State (2,) at phase 0 of the large saddle orbit of a single oscillator, by Newton's method from a grid of starts.

    Raises ConvergenceError where there is none (the forcing is below the fold in which large orbits are born).
    """
    found = periodic_orbits(osc, _SEARCH, halves=1)
    unstable = (np.abs(found.multipliers[0]) > 1) & (found.state[1] > 0.6)
    if not unstable.any():
        raise ConvergenceError(f"mu = {osc.mu}: no large saddle orbit was found")
    return found.state[:, np.flatnonzero(unstable)[np.argmax(found.state[1, unstable])]]


def saddles(osc, outer):
    """Saddles of the family, the large ones near the guesses `outer`, (2,) or (2, n). Errors as `periodic_orbit`."""
    outer = checks.state(outer, checks.model(osc).shape, "outer")
    _, _, mu, omega, delta, _ = osc.columns()
    centre = np.array(
        [-mu / (omega**2 - delta), 0.4 * mu / (1 + omega**2)]
    )  # the linear, undamped response; a little v
    inner = periodic_orbit(osc, centre.reshape(2, *osc.shape), 1)
    outer = periodic_orbit(osc, outer.reshape(2, *osc.shape), 1)
    states = [orbit.state.reshape(2, -1) for orbit in (inner, outer)]
    maps = [np.moveaxis(half_period_map(osc, state, 1).derivative, -1, 0) for state in states]
    unstable = _eigenvector(maps[0])
    normal = _eigenvector(np.swapaxes(maps[1], -1, -2))
    normal *= -np.sign(np.sum(normal * states[1], axis=0))
    moduli = [np.abs(orbit.multipliers.reshape(2, -1)) for orbit in (inner, outer)]
    return Saddles(*states, unstable, normal, moduli[0], moduli[1][0])


def distance_to_basin_boundary(osc, found, points=600, periods=12, method="auto", **options):
    """Signed distance (n,) of W^U of the inner saddle orbits from the border, negative where it reaches beyond.

    osc : family of n members; found : their Saddles
    points : on the fundamental domain, and about as many again around the nearest of these, where the folds of W^U are
    periods : for which they are followed. The longer, the more of the manifold comes by; a tip that falls between the
        points is missed. Both can only make the distance too large.
    method, options, errors : as for `duffing.flow.integrate`

    Raises ConvergenceError naming the first member no point of which comes within REACH of the large saddle orbit.
    """
    distance = _distance(osc, found, points, periods, method, **options)
    if not np.all(np.isfinite(distance)):
        bad = int(np.argmax(~np.isfinite(distance)))
        raise ConvergenceError(f"mu = {osc.columns()[2, bad]}: no point comes within {REACH} of the large saddle orbit")
    return distance


def beyond(osc, found, **options):
    """Whether W^U of the inner saddle orbits reaches beyond the border (n,): one that stays away from it does not.

    osc : family of n members; found : their Saddles; options : as for `distance_to_basin_boundary`
    """
    return _distance(osc, found, **options) < 0


def _distance(osc, found, points=600, periods=12, method="auto", **options):
    """`distance_to_basin_boundary`, infinite for a member no point of which comes near the large saddle orbit."""
    n = found.inner.shape[1]
    share = np.tile(np.arange(checks.count("points", points)) / points, (n, 1))
    options = {"method": method, **(options if method == "rk4" else TOLERANCE | options)}
    first = _heights(osc, found, share, periods, options)
    nearest = np.take_along_axis(share, np.argsort(first, axis=1)[:, :_ZOOMS], axis=1)
    around = np.linspace(-1, 1, max(points // _ZOOMS, 2)) / points
    closer = _heights(osc, found, (nearest[..., None] + around).reshape(n, -1), periods, options)
    return np.minimum(first.min(axis=1), closer.min(axis=1))


def _heights(osc, found, share, periods, options):
    """Unstable coordinate (n, m), at the nearest approach to the outer saddle orbit, of the points of W^U that lie at
    the shares (n, m) of a fundamental domain; infinite for those that stay away."""
    n, m = share.shape
    step = _LAUNCH * found.multipliers[0, :, None] ** (2 * share)  # a forcing period is two half maps
    start = found.inner[:, :, None] + found.unstable[:, :, None] * step
    wide = osc.repeated(m)
    t = stroboscopic_times(wide, checks.count("periods", periods))
    path = integrate(wide, start.reshape(2, -1), t, **options).states
    away = path.reshape(2, periods + 1, n, m) - found.outer[:, None, :, None]
    radius = np.hypot(*away)
    nearest = np.expand_dims(np.argmin(radius, axis=0), (0, 1))
    height = np.sum(np.take_along_axis(away, nearest, axis=1)[:, 0] * found.normal[..., None], axis=0)
    return np.where(radius.min(axis=0) < REACH, height, np.inf)


def crisis(osc, lower, upper, outer, steps=9, **options):
    """The forcings (n,) at which `distance_to_basin_boundary` changes its sign, by so many steps of bisection.

    osc : family of n members, its own mu not used; lower, upper : (n,) forcings with a positive and a negative distance
    outer : guesses (2,) or (2, n) of the large saddle orbits; options : as for `distance_to_basin_boundary`

    Raises ConvergenceError naming the first member whose bracket holds no change of sign.
    """
    shape = checks.model(osc).columns().shape[1:]
    lower, upper = (
        np.broadcast_to(checks.parameter(name, mu), shape).copy() for name, mu in (("lower", lower), ("upper", upper))
    )
    ends = []
    for mu in (lower, upper):
        found = saddles(osc.members(mu=mu), outer)
        ends.append(distance_to_basin_boundary(osc.members(mu=mu), found, **options))
    wrong = ~((ends[0] > 0) & (ends[1] < 0))
    if wrong.any():
        bad = int(np.argmax(wrong))
        raise ConvergenceError(
            f"mu from {lower[bad]} to {upper[bad]}: distances {ends[0][bad]:.3g} and {ends[1][bad]:.3g} are no bracket"
        )
    return _bisected(osc, lower, upper, found.outer, steps, options)


def crisis_above(osc, lower, outer, step=0.02, tries=15, steps=5, **options):
    """The first forcings (n,) above `lower` at which W^U reaches beyond the border, on a grid and then by bisection.

    osc : family of n members, its own mu not used; lower : (n,) forcings at which it does not reach beyond
    outer : guesses (2,) or (2, n) of the large saddle orbits at `lower`
    step, tries : of the grid; infinite for a member whose W^U keeps to its side up to lower + tries * step
    steps : of bisection; options : as for `distance_to_basin_boundary`, but a manifold that stays away counts as on
        its side

    Raises ConvergenceError naming the first member whose W^U reaches beyond at `lower`.
    """
    shape = checks.model(osc).columns().shape[1:]
    lower = np.broadcast_to(checks.parameter("lower", lower), shape).copy()
    checks.positive("step", step)
    found = saddles(osc.members(mu=lower), outer)
    outer, upper = found.outer.copy(), np.full(shape, np.inf)
    change = np.zeros_like(outer)
    leaks = beyond(osc.members(mu=lower), found, **options)
    if leaks.any():
        bad = int(np.argmax(leaks))
        raise ConvergenceError(f"mu = {lower[bad]}: W^U reaches beyond the border there already")
    for _ in range(checks.count("tries", tries)):
        live = np.flatnonzero(np.isinf(upper))
        if live.size == 0:
            break
        near = outer[:, live]
        for part in np.arange(1, _PARTS) / _PARTS:
            guess = near + change[:, live] / _PARTS
            near = periodic_orbit(osc.members(live, mu=(lower + part * step)[live]), guess, 1).state
        family = osc.members(live, mu=(lower + step)[live])
        found = saddles(family, near + change[:, live] / _PARTS)
        leaks = beyond(family, found, **options)
        upper[live[leaks]] = lower[live[leaks]] + step
        on, states = live[~leaks], found.outer[:, ~leaks]
        lower[on] += step
        change[:, on], outer[:, on] = states - outer[:, on], states
    seen = np.flatnonzero(np.isfinite(upper))
    if seen.size:
        upper[seen] = _bisected(osc.members(seen), lower[seen], upper[seen], outer[:, seen], steps, options)
    return upper


def _bisected(osc, lower, upper, outer, steps, options):
    """The forcings (n,) between lower and upper at which the distance changes its sign."""
    for _ in range(checks.count("steps", steps)):
        middle = (lower + upper) / 2
        found = saddles(osc.members(mu=middle), outer)
        outer = found.outer
        inside = _distance(osc.members(mu=middle), found, **options) > 0
        lower, upper = np.where(inside, middle, lower), np.where(inside, upper, middle)
    return (lower + upper) / 2


def _eigenvector(matrices):
    """Unit eigenvectors (2, n) of the largest modulus, of real matrices (n, 2, 2) with real eigenvalues."""
    values, vectors = np.linalg.eig(matrices)
    largest = np.argmax(np.abs(values), axis=1)
    return np.real(vectors[np.arange(len(largest)), :, largest]).T
