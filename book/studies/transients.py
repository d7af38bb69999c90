"""What the chapters on transients and on the window of chaos compute: lifetimes, the fold and the crisis."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import paper
from duffing.errors import ConvergenceError
from duffing.orbits.bifurcations import FOLD, bifurcations, orbit_branches
from duffing.orbits.periodic import periodic_orbit
from duffing.poincare import poincare_section
from duffing.transients.crisis import crisis, distance_to_basin_boundary, large_saddle, saddles
from duffing.transients.lifetimes import both_wells, lifetimes

from ..remember import remembered
from .accuracy import integrator
from .survival import exponential, rate

SINCE = 20  # periods before a transient is chaotic: orbits that start in a basin's interior are captured sooner
# A coarse bracket of the crisis for each exponent, and where the small orbits are met on their way to the fold.
P_CRISIS = (0.1, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 2.5, 3.0)
BELOW = (0.270, 0.259, 0.252, 0.248, 0.243, 0.240, 0.239, 0.244, 0.256)
ABOVE = 0.008
FAR = 0.22


def starts_between_wells(columns, rows):
    """A grid of starts on and around the hump: (2, columns * rows) of x in [-1, 1] and v in [-0.4, 0.4].

    The basin of the large orbit, as it is before the crisis, is farther out: its orbits are not counted as wandering
    while they spiral slowly into it.
    """
    x, v = np.meshgrid(np.linspace(-1.0, 1.0, columns), np.linspace(-0.4, 0.4, rows))
    return np.stack([x.ravel(), v.ravel()])


def sample(mu, p=paper.P_SMALL, columns=20, rows=10, periods=1000, osc=paper.OSCILLATOR, **sweep):
    """Lifetimes of the `starts_between_wells` at one forcing: time, settled, and whether in the large orbit of one
    forcing period, each (columns * rows,). sweep : how, as for `lifetimes`."""
    return _sample(mu, p, columns, rows, periods, osc, **sweep)


@remembered
def _sample(mu, p, columns, rows, periods, osc, **sweep):
    # Called in one way only, so that `sample` and `escape` share what is remembered.
    state = starts_between_wells(columns, rows)
    family = replace(osc, p=p, mu=np.full(state.shape[1], mu))
    lived = lifetimes(family, state, periods, **sweep, **integrator(p))
    return lived.time, lived.settled, both_wells(family, lived, **integrator(p)) & (lived.multiple == 1)


class Escape(NamedTuple):
    """mu (n,); mean (n,), error (n,) : mean lifetime in periods, nan where no capture was seen; bound (n,) : there, the
    least mean lifetime that leaves "no capture seen" a chance of 1 in 20, else nan; small, large (2, n) : rates of
    capture by the small orbits in the wells (and by others, in their windows) and by the large one, per period, and
    their errors, nan where nothing wanders longer than `since`; wanderers (n,) : number of starts that do.
    """

    mu: np.ndarray
    mean: np.ndarray
    error: np.ndarray
    bound: np.ndarray
    small: np.ndarray
    large: np.ndarray
    wanderers: np.ndarray


@remembered
def escape(mu, p=paper.P_SMALL, columns=16, rows=8, periods=600, since=SINCE, osc=paper.OSCILLATOR, **sweep):
    """The Escape of chaos for a tuple of forcings, over the orbits that wander longer than `since` periods."""
    found = np.full((9, len(mu)), np.nan)
    for k, value in enumerate(mu):
        time, settled, large = sample(value, p, columns, rows, periods, osc, **sweep)
        late = time > since
        found[0, k], found[8, k] = value, late.sum()
        if (settled & late).any():
            found[1:3, k] = exponential(time, settled, since)[:2]
        elif late.any():
            found[3, k] = np.sum(time[late] - since) / np.log(20)
        if late.any():
            found[4:8, k] = *rate(time, settled & ~large, since), *rate(time, large, since)
    return Escape(*found[:4], found[4:6], found[6:8], found[8])


@remembered
def sample_of_the_paper(osc=paper.OSCILLATOR):
    """Lifetimes of the one motion of Fig. 5b, in periods: by the paper's algorithm, and in friction time."""
    osc = replace(osc, mu=paper.MU_REGULAR)
    return tuple(int(lifetimes(osc, paper.START, **options).time) for options in ({"method": "rk4"}, {}))


@remembered
def folds(p=P_CRISIS, osc=paper.OSCILLATOR):
    """Where the small orbits in the wells end for each p of the tuple: forcings (n,), states at phase 0 (2, n)."""
    family = replace(osc, p=np.array(p), mu=np.full(len(p), FAR))
    small = periodic_orbit(family, (1.22, 0.1))
    branches = orbit_branches(family, small.state, bounds=(FAR - 0.01, 0.28))
    ends = [next((one for one in found if one.kind == FOLD), None) for found in bifurcations(branches)]
    if None in ends:
        raise ConvergenceError(f"p = {p[ends.index(None)]}: the small orbits were not followed to a fold")
    return np.array([float(end.osc.mu) for end in ends]), np.array([end.state for end in ends]).T


@remembered
def crises(p=P_CRISIS, points=800, steps=6, by_step=False, osc=paper.OSCILLATOR):
    """The forcing (n,) of the boundary crisis for each p of the tuple, within 0.008 / 2^steps.

    In friction time for p < 1; by_step : by the paper's step throughout, for comparison
    """
    p = np.array(p)
    lower, found = np.interp(p, P_CRISIS, BELOW), np.empty(p.size)
    outer = np.transpose([large_saddle(osc.members(0, p=q, mu=mu)) for q, mu in zip(p, lower, strict=True)])
    for chosen, options in ((p >= 1, {"method": "rk4"}), (p < 1, {"method": "rk4"} if by_step else {})):
        if chosen.any():
            ends, family = lower[chosen], replace(osc, p=p[chosen])
            found[chosen] = crisis(family, ends, ends + ABOVE, outer[:, chosen], steps=steps, points=points, **options)
    return found


@remembered
def crisis_exponent(p=P_CRISIS, osc=paper.OSCILLATOR):
    """The exponent (n,) of the mean lifetime above the crisis, (mu - mu_X)^-gamma, for each p of the tuple.

    gamma = 1/2 + ln |l1| / |ln |l2||, l1, l2 the multipliers of the saddle orbit whose unstable manifold touches the
    border (Grebogi, Ott, Romeiras and Yorke 1987, heteroclinic tangency); 1/2 where l2 = 0.
    """
    mu = crises(p)
    outer = [large_saddle(osc.members(0, p=q, mu=value)) for q, value in zip(p, mu, strict=True)]
    larger, smaller = saddles(replace(osc, p=np.array(p), mu=mu), np.transpose(outer)).multipliers
    return 0.5 + np.divide(np.log(larger), -np.log(smaller, where=smaller > 0, out=np.full(mu.size, -np.inf)))


@remembered
def below_fold(distance, p=paper.P_SMALL, columns=20, rows=20, periods=1000, **sweep):
    """Mean lifetimes of chaos at the distances in mu below the fold of the small orbits, and one standard error: (n,)
    each."""
    mu = folds((p,))[0][0]
    found = [exponential(*sample(float(mu - d), p, columns, rows, periods, **sweep)[:2], SINCE) for d in distance]
    return np.array([one.mean for one in found]), np.array([one.error for one in found])


@remembered
def edge(mu, p=paper.P_SMALL, points=600, osc=paper.OSCILLATOR, **options):
    """Distance of chaos from the border of the large orbit's basin for a tuple of mu: (n,)."""
    family = replace(osc, p=p, mu=np.array(mu))
    return distance_to_basin_boundary(
        family, saddles(family, large_saddle(replace(osc, p=p, mu=mu[0]))), points=points, **options
    )


@remembered
def passage_time(distance, p=paper.P_SMALL, longest=2000, osc=paper.OSCILLATOR):
    """Periods (n,) that an orbit needs to leave the place of the fold by 0.1, at the distances in mu above it."""
    mu, state = folds((p,))
    family = replace(osc, p=p, mu=mu[0] + np.array(distance))
    points = poincare_section(family, state[:, 0], longest, **integrator(p))
    left = np.hypot(*(points - state[:, :1, None])) > 0.1
    if not left.any(axis=0).all():
        raise ConvergenceError(f"longest = {longest}: not long enough for every orbit to leave the place of the fold")
    return left.argmax(axis=0) + 1
