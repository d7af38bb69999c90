"""What is read off branches of periodic orbits: amplitudes, speeds, stroboscopic points, where they bifurcate."""

from typing import NamedTuple

import numpy as np

from duffing import checks
from duffing.orbits.bifurcations import Bifurcation, OrbitBranch
from duffing.orbits.periodic import cycle, path, periodic_orbit
from duffing.oscillator import Duffing

DRAWING = {"rtol": 1e-7, "atol": 1e-9}  # for curves: a line is wider than the error


class AnnotatedBranch(NamedTuple):
    """A branch, the name of the orbits on it and the bifurcations found (a tuple)."""

    name: str
    branch: OrbitBranch
    found: tuple[Bifurcation, ...]


def amplitude(osc, state, halves, samples=100):
    """Half the range of x over the orbits through the states (2, *family): (*family). Right to about 1e-3, by so many
    samples a period."""
    x = _path(osc, state, halves, samples)[0]
    return np.max(np.abs(x), axis=0) if halves % 2 else np.ptp(x, axis=0) / 2


def speed(osc, state, halves, samples=100):
    """Greatest |v| over the orbits through the states (2, *family): (*family). Sampled, like `amplitude`."""
    return np.max(np.abs(_path(osc, state, halves, samples)[1]), axis=0)


def stroboscopic(osc, state, halves):
    """x at phase 0 of the orbits through the states (2, n) and of their mirror images: (halves, n)."""
    return cycle(osc, state, halves)[0]


def curves(followed, value=amplitude):
    """The branches as curves to draw: list of (name, parameter (n,), value (n,) or (k, n), stable (n,)).

    The bifurcations stand among their points, so that stability changes where it does.
    """
    result = []
    for name, branch, found in followed:
        osc, state = branch.osc, branch.state
        # From a stable point on, a curve is stable up to the bifurcation: that counts as stable when a neighbour is.
        stable = branch.stable
        place = np.array([flaw.index + 1 for flaw in found], dtype=int)
        order = np.argsort(place, kind="stable")
        beside = [stable[k - 1] or stable[k] for k in place[order]]
        if found:
            chosen = [found[k] for k in order]
            at = np.insert(np.arange(len(stable)), place[order], len(stable) + np.arange(len(chosen)))
            osc = Duffing.joined([osc, *(flaw.osc for flaw in chosen)]).members(at)
            state = np.insert(state, place[order], np.transpose([flaw.state for flaw in chosen]), axis=1)
            stable = np.insert(stable, place[order], beside)
        result.append((name, getattr(osc, branch.field), value(osc, state, branch.halves), stable))
    return result


def marks(followed):
    """Their bifurcations as marks on amplitudes: list of (kind, parameter, value)."""
    return [
        (
            flaw.kind,
            float(getattr(flaw.osc, one.field)),
            float(amplitude(flaw.osc, flaw.state, flaw.halves)),
        )
        for _, one, found in followed
        for flaw in found
    ]


def at_exponent(followed, p):
    """Those branches whose damping exponent is p."""
    return tuple(one for one in followed if one.branch.osc.p[0] == p)


def side_by_side(followed):
    """Where each bifurcation lies for each exponent: list of (name, kind, {p: mu}), in the order along the branches."""
    places = {}
    for name, branch, found in followed:
        for number, one in enumerate(found):
            key = (name, one.kind, sum(other.kind == one.kind for other in found[:number]))
            places.setdefault(key, {})[float(branch.osc.p[0])] = float(one.osc.mu)
    return [(name, kind, where) for (name, kind, _), where in places.items()]


def orbits_at(followed, mu):
    """The orbits that the branches have at the forcing mu: dict name -> list of PeriodicOrbit, by Newton's method."""
    result = {}
    for name, branch, _ in followed:
        low, high = branch.parameter[:-1], branch.parameter[1:]
        for j in np.flatnonzero(((low - mu) * (high - mu) < 0) | (low == mu)):
            share = (mu - low[j]) / (high[j] - low[j])
            guess = (1 - share) * branch.state[:, j] + share * branch.state[:, j + 1]
            orbit = periodic_orbit(branch.osc.members(j, mu=mu), guess, branch.halves)
            known = result.setdefault(name, [])
            # Two branches that leave the same start both hold it.
            if not any(np.max(np.abs(orbit.state - other.state)) < 1e-6 for other in known):
                known.append(orbit)
    return result


def _path(osc, state, halves, samples):
    number = checks.count("samples", samples, least=2) * checks.count("halves", halves) // 2
    return path(osc, state, halves, number, **DRAWING)
