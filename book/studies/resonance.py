"""Resonance curves: orbits against the frequency, in a well and round both; the least forcing of the large orbit."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy.special

from duffing import checks, paper
from duffing.errors import ConvergenceError
from duffing.orbits.bifurcations import FOLD, bifurcation_curves, bifurcations, orbit_branches
from duffing.orbits.continuation import BOUND

from ..remember import remembered
from .bifurcations import IN_WELL, LARGE, joined, settled
from .followed import AnnotatedBranch, at_exponent, curves, marks, speed

EXPONENTS = (0.1, 0.3, 0.5, 1.0, 2.0, 3.0)


@remembered
def response(mu, p=EXPONENTS, low=0.5, turned=0.65, middle=0.9, high=2.2):
    """In-well orbits against the frequency at the forcing mu: tuple of AnnotatedBranch.

    From the small orbit at both ends of the range and, between the resonance and its superharmonic, both ways from the
    middle, since a curve may leave the range on top of a resonance and miss what lies beyond. Upwards from the middle
    weakly damped orbits turn back, unstable, and are followed down to `turned` only: their multipliers grow beyond
    100, and Newton's method needs ever shorter steps. The steps are short enough to enter the superharmonic peaks.

    Raises ConvergenceError where a branch ends inside its range.
    """
    omega = np.repeat([low, middle, middle, high], len(p))
    family = replace(paper.OSCILLATOR, p=np.tile(p, 4), mu=mu, omega=omega)
    guess = settled(family, (1.0, 0.0))
    # Weak damping needs more time to settle, but is near to the undamped, linearised well; strong damping is not.
    weak = (omega == middle) & (family.p >= 1)
    guess[:, weak] = np.array([[1 + mu / (2 - middle**2)], [0.0]])
    upper = np.repeat([middle, middle, high, high], len(p))
    lower = np.repeat([low, low, turned, low], len(p))
    sense = np.repeat([1.0, -1.0, 1.0, -1.0], len(p))
    return _in_frequency(IN_WELL, family, guess, 2, sense, (lower, upper), largest=0.02, points=400)


@remembered
def large_response(mu, p=EXPONENTS, low=0.5, high=2.2):
    """Symmetric orbits round both wells against the frequency, from the one at omega = 1: tuple of AnnotatedBranch."""
    p = np.array(p)
    middle = replace(paper.OSCILLATOR, p=np.tile(p, 2), mu=mu, omega=1.0)
    start = settled(middle, (1.0, 1.4))
    return _in_frequency(LARGE, middle, start, 1, np.repeat([1.0, -1.0], p.size), (low, high), points=100)


def panel(found, p=EXPONENTS):
    """What a panel of `figures.responses` draws of followed branches: dict p -> (curves, marks)."""
    return {one: (curves(at_exponent(found, one)), marks(at_exponent(found, one))) for one in p}


def _in_frequency(name, osc, guess, halves, direction, bounds, **steps):
    ways = orbit_branches(osc, guess, halves, field="omega", bounds=bounds, direction=direction, **steps)
    for one in ways:
        if one.end != BOUND:
            raise ConvergenceError(
                f"p = {one.osc.p[0]:g}, mu = {one.osc.mu[0]:g}: the branch {name!r} ends at omega = "
                f"{one.parameter[-1]:.4f} ({one.end}), inside its range"
            )
    return tuple(AnnotatedBranch(name, one, tuple(found)) for one, found in zip(ways, bifurcations(ways), strict=True))


class Threshold(NamedTuple):
    """The least mu (n,) at which an orbit exists against omega (n,), and its state (2, n) at phase 0 there."""

    omega: np.ndarray
    mu: np.ndarray
    state: np.ndarray


@remembered
def least_forcing(p=EXPONENTS, low=0.5, high=2.2):
    """The least mu at which the large orbit exists, its fold, against omega: dict p -> Threshold."""
    seeds = replace(paper.OSCILLATOR, p=np.array(p), mu=0.3)
    large = orbit_branches(seeds, settled(seeds, (1.0, 1.4)), 1, bounds=(0.1, 0.35), direction=-1, points=60)
    start = [next(one for one in found if one.kind == FOLD) for found in bifurcations(large)]
    sense = np.repeat([-1.0, 1.0], len(p))
    ways = bifurcation_curves(
        start * 2, second="omega", bounds=(low, high), direction=sense, step=0.02, largest=0.1, points=60
    )
    result = {}
    for value, down, up in zip(p, ways[: len(p)], ways[len(p) :], strict=True):
        u = joined(down.u, up.u)
        result[value] = Threshold(joined(down.parameter, up.parameter), u[2], u[:2])
    return result


def crossing(one, other):
    """(omega, mu) at which two Thresholds cross first, their points joined by straight lines.

    Raises ConvergenceError where they do not cross.
    """
    low, high = (f(one.omega[k], other.omega[k]) for f, k in ((max, 0), (min, -1)))
    omega = np.linspace(low, high, 2001)
    apart = np.interp(omega, one.omega, one.mu) - np.interp(omega, other.omega, other.mu)
    changes = np.flatnonzero(apart[1:] * apart[:-1] <= 0)
    if changes.size == 0:
        raise ConvergenceError(f"the curves do not cross between omega = {low:g} and {high:g}")
    j = changes[0]
    where = omega[j] + (omega[j + 1] - omega[j]) * apart[j] / (apart[j] - apart[j + 1])
    return float(where), float(np.interp(where, one.omega, one.mu))


class Meeting(NamedTuple):
    """Where the least forcing of the large orbit is that of linear damping: p, (omega, mu), the orbit's greatest |v|
    there, and the one at which the damping brakes like the linear one."""

    p: float
    omega: float
    mu: float
    speed: float
    equal: float


@remembered
def meetings():
    """The Meeting of every exponent but 1 with linear damping, as a tuple."""
    least, result = least_forcing(), []
    for p in least:
        if p != 1:
            omega, mu = crossing(least[p], least[1.0])
            state = np.array([np.interp(omega, least[p].omega, row) for row in least[p].state])
            fast = speed(replace(paper.OSCILLATOR, p=p, mu=mu, omega=omega), state, 1)
            result.append(Meeting(p, omega, mu, float(fast), float(equal_braking(p))))
    return tuple(result)


@remembered
def least_stable(mu, frequencies=1000):
    """The least stable amplitude in a well against the frequency: omega (n,) and dict p -> amplitude (n,).

    Raises ConvergenceError where an exponent has no stable orbit at one of the frequencies.
    """
    omega, result = np.linspace(0.5, 2.2, frequencies), {}
    for p in EXPONENTS:
        least = np.full(frequencies, np.inf)
        for _, where, value, stable in curves(at_exponent(response(mu), p)):
            for j in np.flatnonzero(stable[1:] & stable[:-1]):
                one, other = sorted(((where[j], value[j]), (where[j + 1], value[j + 1])))
                on = (omega >= one[0]) & (omega <= other[0])
                least[on] = np.minimum(least[on], np.interp(omega[on], *zip(one, other, strict=True)))
        if not np.isfinite(least).all():
            raise ConvergenceError(f"p = {p:g}, mu = {mu:g}: no stable orbit at omega = {omega[np.argmax(least)]:.4f}")
        result[p] = least
    return omega, result


def reversal(mu, p=EXPONENTS):
    """Largest amount by which the least stable amplitude of an exponent exceeds that of a larger one, and the least and
    the greatest omega where it does so by more than one per cent of it (nan if nowhere)."""
    omega, least = least_stable(mu)
    pairs = [(least[a] - least[b], least[b]) for a in p for b in EXPONENTS if a < b]
    where = omega[np.any([over > 0.01 * below for over, below in pairs], axis=0)]
    ends = (float(where.min()), float(where.max())) if where.size else (np.nan, np.nan)
    return float(max(over.max() for over, _ in pairs)), *ends


def equal_braking(p):
    """The greatest speed v of a harmonic motion from which damping with the exponent p != 1 takes as much energy in a
    period as linear damping of the same alpha: c_p v^p = v, c_p = (2/pi) B(p/2 + 1, 1/2)."""
    if np.any(np.asarray(p) == 1):
        raise ValueError(f"p = {p}: must differ from 1, the damping compared with")
    p = np.asarray(checks.parameter("p", p, allowed="a finite number > 0", lower=0.0, strict=True))
    return (2 / np.pi * scipy.special.beta(p / 2 + 1, 0.5)) ** (1 / (1 - p))
