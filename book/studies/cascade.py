"""Chaos inside one well: the period-doubling cascade of the large in-well orbit, its end, and who is on it."""

from typing import NamedTuple

import numpy as np

from duffing.errors import ConvergenceError
from duffing.flow import integrate, stroboscopic_times
from duffing.lyapunov import lyapunov_spectrum
from duffing.melnikov import critical_amplitude
from duffing.orbits.bifurcations import FLIP, FOLD, bifurcations, orbit_branches, switch_branches
from duffing.oscillator import Duffing
from duffing.transients.lifetimes import lifetimes, returns

from ..remember import remembered
from . import small_p
from .bifurcations import settled

FEIGENBAUM = 4.669201609  # the limit of the ratio of two successive intervals between period doublings
WEAK = 0.6  # of the critical amplitude: the small orbit is alone in its well there
TOLERANCE = {"rtol": 1e-7, "atol": 1e-9}
CHAOTIC = 0.01  # lambda_1 above which motion that does not settle is called chaotic


class Cascade(NamedTuple):
    """The cascade for n oscillators, forcing amplitudes.

    fold (n,) : the end of the small orbits in the wells
    flips (k, n) : period doublings of the large in-well orbit, from 1 to 2, from 2 to 4 ... forcing periods
    state (2, n) : of the orbit of the last doubling, at phase 0
    """

    fold: np.ndarray
    flips: np.ndarray
    state: np.ndarray

    @property
    def ratio(self):
        """Ratios (k - 2, n) of successive intervals between the doublings."""
        steps = np.diff(self.flips, axis=0)
        return steps[:-1] / steps[1:]

    @property
    def accumulation(self):
        """Where the doublings accumulate (n,): the intervals after the last one as a geometric series of Feigenbaum's
        ratio. It is met within a few per cent there, so that the sum errs by a few per cent of its last interval."""
        return self.flips[-1] + (self.flips[-1] - self.flips[-2]) / (FEIGENBAUM - 1)


def small_branches(osc, points=200):
    """Branches in mu of the small in-well orbits of a family (its own mu not used) from weak forcing on."""
    start = osc.members(mu=WEAK * np.ravel(critical_amplitude(osc)))
    bounds = (start.mu / 2, np.full(start.mu.size, 0.9))
    return orbit_branches(start, settled(start, (1.05, 0.0)), bounds=bounds, points=points)


@remembered
def small_folds(alpha, omega, p):
    """The forcings (n,) at which the small in-well orbits end in a fold; the arguments broadcast.

    Raises ConvergenceError naming the first oscillator without one: beyond a cusp the orbit grows without a fold.
    """
    osc = _family(alpha, omega, p)
    return _first(bifurcations(small_branches(osc, points=60)), FOLD, osc)


@remembered
def cascade(alpha, omega, p, doublings=2):
    """The Cascade for the oscillators; the arguments broadcast. doublings : of the orbit after the first flip.

    Raises ConvergenceError where the orbit has no fold or no flip, or a doubling is not found.
    """
    osc = _family(alpha, omega, p)
    found = bifurcations(small_branches(osc))
    fold, flips = _first(found, FOLD, osc), [_first(found, FLIP, osc)]
    now = [next(one for one in points if one.kind == FLIP) for points in found]
    for number in range(doublings):
        away = 0.01 / 2.5**number  # the branch of 2^k periods is the shorter, the larger k
        steps = {"distance": away, "step": away, "largest": 0.02, "smallest": 1e-7, "points": 60}
        found = bifurcations(switch_branches(now, bounds=(0.01, 0.9), **steps))
        flips.append(_first(found, FLIP, osc))
        now = [next(one for one in points if one.kind == FLIP) for points in found]
    return Cascade(fold, np.array(flips), np.array([one.state for one in now]).T)


def ratios_over_alpha(alpha, omega=1.0, exponents=(0.1, 1.0)):
    """mu_A / mu_c against alpha: dict p -> (alpha, ratio (n,))."""
    mu_c = {p: critical_amplitude(Duffing(np.array(alpha), p, 0.0, omega)) for p in exponents}
    return {p: (alpha, cascade(alpha, omega, p).accumulation / mu_c[p]) for p in exponents}


def ratios_over_omega(omega, alpha=0.1):
    """mu_A / mu_c against omega; omega : dict p -> (n,). Returns dict p -> (omega, ratio (n,))."""
    mu_c = {p: critical_amplitude(Duffing(alpha, p, 0.0, np.array(one))) for p, one in omega.items()}
    return {p: (one, cascade(alpha, one, p).accumulation / mu_c[p]) for p, one in omega.items()}


class Swept(NamedTuple):
    """Chaos in the well carried upwards in mu: mu (k, n); exponent (k, n) of each step, nan once it is captured;
    end (n,) : the last forcing at which it was not, nan where it lasts to the end of the sweep."""

    mu: np.ndarray
    exponent: np.ndarray
    end: np.ndarray


@remembered
def swept(alpha, omega, p, step=2e-5, steps=40, periods=300, settling=100, doublings=2):
    """The Swept from each cascade's accumulation on: `periods` a step, the state carried on to the next mu.

    Captured is an orbit that repeats itself every forcing period: on the chaotic attractor and in its windows none
    does. A transient longer than the step is still counted as the attractor's.
    """
    found, osc = cascade(alpha, omega, p, doublings), _family(alpha, omega, p)
    state = found.state + 1e-4
    mu = found.accumulation + step * np.arange(steps)[:, None]
    exponent, lost = np.empty(mu.shape), np.zeros(mu.shape[1], dtype=bool)
    for k, forcing in enumerate(mu):
        one = osc.members(mu=forcing)
        orbit = integrate(one, state, stroboscopic_times(one, settling + periods), tangents=1, **TOLERANCE)
        state = orbit.states[:, -1]
        lost |= returns(orbit.states, 1e-3) == 1
        exponent[k] = np.where(lost, np.nan, orbit.growth[0, settling:].mean(axis=0) / one.period)
    inside = np.isfinite(exponent).sum(axis=0)
    last = mu[np.maximum(inside - 1, 0), np.arange(mu.shape[1])]
    return Swept(mu, exponent, np.where((inside > 0) & (inside < steps), last, np.nan))


class Share(NamedTuple):
    """starts : how many; share : of them on chaos inside a well; cross : on motion between the wells that has not
    settled; exponent : mean lambda_1 of the former, nan where there is none."""

    starts: int
    share: float
    cross: float
    exponent: float


@remembered
def share(alpha, omega, p, mu, columns=24, rows=16, periods=1000, last=200):
    """The Share of a grid of initial conditions over both wells, after so many periods, at one forcing."""
    state = small_p.starts(columns, rows)
    family = Duffing(alpha, p, np.full(state.shape[1], mu), omega)
    lived = lifetimes(family, state, periods, **TOLERANCE)
    left = np.flatnonzero(~lived.settled)
    if left.size == 0:
        return Share(state.shape[1], 0.0, 0.0, np.nan)
    part = family.members(left)
    exponent = lyapunov_spectrum(part, lived.end[:, left], last, 0, k=1, **TOLERANCE).exponents[0]
    x = integrate(part, lived.end[:, left], part.period[0] * np.arange(961) / 16, **TOLERANCE).states[0]
    crosses = (x.min(axis=0) < 0) & (x.max(axis=0) > 0)
    inside = ~crosses & (exponent > CHAOTIC)
    mean = float(exponent[inside].mean()) if inside.any() else np.nan
    return Share(state.shape[1], inside.sum() / state.shape[1], crosses.sum() / state.shape[1], mean)


def _family(alpha, omega, p):
    alpha, omega, p = np.broadcast_arrays(*np.atleast_1d(alpha, omega, p))
    return Duffing(alpha=alpha, omega=omega, p=p, mu=np.zeros(alpha.shape))


def _first(found, kind, osc):
    """The forcing (n,) of the first bifurcation of a kind on each branch."""
    places = [next((float(one.osc.mu) for one in points if one.kind == kind), None) for points in found]
    if None in places:
        raise ConvergenceError(f"{osc.named(places.index(None))}: no {kind} of the in-well orbit was found")
    return np.array(places)
