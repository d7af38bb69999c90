"""Resonance curves: orbits against the frequency, in a well and round both; the least forcing of the large orbit."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy.special

from .. import checks, paper
from ..errors import ConvergenceError
from ..orbits.bifurcations import FOLD, bifurcations, loci, orbit_branches
from ..orbits.followed import Followed
from .bifurcation_study import IN_WELL, LARGE, joined, settled
from .remember import remembered

EXPONENTS = (0.1, 0.3, 0.5, 1.0, 2.0, 3.0)


@remembered
def response(mu, p=EXPONENTS, low=0.5, middle=0.9, high=2.2):
    """In-well orbits against the frequency at the forcing mu: tuple of Followed.

    From the small orbit at both ends of the range and, between the resonance and its superharmonic, both ways from the
    middle, since a curve may leave the range on top of a resonance and miss what lies beyond.
    """
    omega = np.repeat([low, middle, middle, high], len(p))
    family = replace(paper.OSCILLATOR, p=np.tile(p, 4), mu=mu, omega=omega)
    guess = settled(family, (1.0, 0.0))
    # Weak damping needs more time to settle, but is near to the undamped, linearised well; strong damping is not.
    weak = (omega == middle) & (family.p >= 1)
    guess[:, weak] = np.array([[1 + mu / (2 - middle**2)], [0.0]])
    upper = np.repeat([middle, middle, high, high], len(p))
    return _in_frequency(IN_WELL, family, guess, 2, np.repeat([1.0, -1.0, 1.0, -1.0], len(p)), (low, upper))


@remembered
def large_response(mu, p=EXPONENTS, low=0.5, high=2.2):
    """Symmetric orbits round both wells against the frequency, from the one at omega = 1: tuple of Followed."""
    p = np.array(p)
    middle = replace(paper.OSCILLATOR, p=np.tile(p, 2), mu=mu, omega=1.0)
    start = settled(middle, (1.0, 1.4))
    return _in_frequency(LARGE, middle, start, 1, np.repeat([1.0, -1.0], p.size), (low, high))


def _in_frequency(name, osc, guess, halves, direction, bounds):
    ways = orbit_branches(osc, guess, halves, field="omega", bounds=bounds, direction=direction, points=100)
    return tuple(Followed(name, one, tuple(found)) for one, found in zip(ways, bifurcations(ways), strict=True))


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
    ways = loci(start * 2, second="omega", bounds=(low, high), direction=sense, step=0.02, largest=0.1, points=60)
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


def equal_braking(p):
    """The greatest speed v of a harmonic motion from which damping with the exponent p != 1 takes as much energy in a
    period as linear damping of the same alpha: c_p v^p = v, c_p = (2/pi) B(p/2 + 1, 1/2)."""
    if np.any(np.asarray(p) == 1):
        raise ValueError(f"p = {p}: must differ from 1, the damping compared with")
    p = np.asarray(checks.parameter("p", p, allowed="a finite number > 0", lower=0.0, strict=True))
    return (2 / np.pi * scipy.special.beta(p / 2 + 1, 0.5)) ** (1 / (1 - p))
