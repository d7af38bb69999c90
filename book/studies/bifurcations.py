"""What the chapter on bifurcations computes: branches in mu, their loci in the (p, mu) plane, brute force."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import paper
from duffing.errors import ConvergenceError
from duffing.flow import integrate
from duffing.melnikov import critical_amplitude
from duffing.orbits.bifurcations import (
    FLIP,
    FOLD,
    OrbitBranch,
    bifurcation_curves,
    bifurcations,
    orbit_branches,
    switch_branches,
)
from duffing.orbits.continuation import BOUND
from duffing.orbits.diagram import bifurcation_diagram
from duffing.orbits.periodic import cycle, periodic_orbits

from ..remember import remembered
from .followed import (
    DRAWING,
    AnnotatedBranch,
    at_exponent,
    curves,
    marks,
    orbits_at,
    stroboscopic,
)

EXPONENTS = (0.1, 0.5, 1.0, 2.0)
IN_WELL, LARGE, SADDLE, THIRD = "in a well", "round both wells", "saddle orbit", "period 3"
STARTS = np.array([[-1.2, -0.3, 1.0, -1.2, -0.3, 1.0, -1.2, -0.8], [0.2, 0.2, 0.2, 1.2, 1.2, 1.2, 0.6, 0.6]])
HALVES = {IN_WELL: 2, LARGE: 1, SADDLE: 1, THIRD: 3}


@remembered
def branches(p=EXPONENTS, last=0.5):
    """The main branches in mu for each exponent: tuple of AnnotatedBranch.

    The orbits in a well, round both wells, near x = 0 (the saddle orbit) and of period 3 (symmetric), each in both
    directions from one of them; then what leaves their flips, the doubled and the asymmetric orbits, up to mu = 0.3.
    """
    p = np.array(p)
    seeds = [
        (IN_WELL, 0.05, settled(replace(paper.OSCILLATOR, p=p, mu=0.05), (1.05, 0.0)), (-1, 1), (0.01, last)),
        (LARGE, 0.25, settled(replace(paper.OSCILLATOR, p=p, mu=0.25), (1.0, 1.4)), (-1, 1), (0.01, last)),
        (SADDLE, 0.3, np.array([-0.15 + 0 * p, 0 * p]), (-1, 1), (0.01, last)),
        (THIRD, _MU_THIRD, _third(p), (-1, 1), (0.15, 0.3)),
    ]
    first = _both_ways(seeds, p)
    flips = [(one.name, flip) for one in first for flip in one.found if flip.kind == FLIP]
    doubled = switch_branches([flip for _, flip in flips], bounds=(0.01, 0.3), points=40)
    found = bifurcations(doubled)
    return first + tuple(
        AnnotatedBranch(f"{name}, {'doubled' if flip.halves % 2 == 0 else 'asymmetric'}", branch, tuple(points))
        for (name, flip), branch, points in zip(flips, doubled, found, strict=True)
    )


def settled(osc, start, periods=60):
    """States (2, N) at phase 0 after so many periods from the start."""
    t = osc.columns()[3] ** -1 * 2 * np.pi * np.array([[0.0], [periods]])
    return integrate(osc, start, t, **DRAWING).states[:, -1]


_MU_THIRD = 0.262  # the symmetric orbit of period 3 exists there at every p


def _third(p):
    """States (2, len(p)) of the symmetric orbit of period 3: the one that attracts at p = 1, mu = 0.22, carried on."""
    seed = replace(paper.OSCILLATOR, p=1.0, mu=0.22)
    starts = np.reshape(np.meshgrid(np.linspace(-1.4, 1.4, 8), np.linspace(-1.0, 1.0, 6)), (2, -1))
    state = periodic_orbits(seed, starts, 3)
    state = state.state[:, np.argmin(np.abs(state.multipliers[0]))]
    (way,) = orbit_branches(replace(seed, mu=np.array([0.22])), state, 3, bounds=(0.2, _MU_THIRD))
    start = replace(paper.OSCILLATOR, p=np.ones(p.size), mu=_MU_THIRD)
    ways = orbit_branches(
        start,
        np.repeat(way.state[:, -1:], p.size, axis=1),
        3,
        field="p",
        bounds=(np.minimum(p, 0.999), np.maximum(p, 1.001)),
        direction=np.where(p < 1, -1.0, 1.0),
        largest=0.2,
    )
    # The branch to p = 1 itself leads away from it; its start is the orbit.
    return np.array([one.state[:, 0] if value == 1 else one.state[:, -1] for value, one in zip(p, ways, strict=True)]).T


def _both_ways(seeds, p):
    """AnnotatedBranch of the seeds (name, mu, states (2, n), directions, bounds), all in lock-step."""
    names, halves, states, mu, sense, low, high = [], [], [], [], [], [], []
    for name, value, state, directions, bounds in seeds:
        for direction in directions:
            states.append(state)
            names += [name] * p.size
            for column, item in (
                (halves, HALVES[name]),
                (mu, value),
                (sense, direction),
                (low, bounds[0]),
                (high, bounds[1]),
            ):
                column += [item] * p.size
    family = replace(paper.OSCILLATOR, p=np.tile(p, len(states)), mu=np.array(mu))
    found = orbit_branches(
        family,
        np.concatenate(states, axis=1),
        np.array(halves),
        bounds=(np.array(low), np.array(high)),
        direction=np.array(sense, dtype=float),
        points=120,
    )
    on_them = bifurcations(found)
    return tuple(AnnotatedBranch(name, one, tuple(b)) for name, one, b in zip(names, found, on_them, strict=True))


def panels(found, p=EXPONENTS):
    """What `figures.branch_panels` draws of followed branches: dict p -> (curves, marks, mu_c)."""
    chosen = {one: at_exponent(found, one) for one in p}
    mu_c = {one: float(critical_amplitude(replace(paper.OSCILLATOR, p=one))) for one in p}
    return {one: (curves(chosen[one]), marks(chosen[one]), mu_c[one]) for one in p}


def overlays(found, p=EXPONENTS):
    """What `figures.overlay` draws: dict p -> (`brute_force`, stroboscopic curves of the followed branches)."""
    return {one: (brute_force(one), curves(at_exponent(found, one), stroboscopic)) for one in p}


def falls(loci, low=0.1, high=2.0):
    """Relative fall of mu from p = low to high on each Locus: dict name -> list of falls, in the order of mu at low."""
    result = {}
    for one in sorted(loci, key=lambda one: np.interp(low, one.p, one.mu)):
        first, last = np.interp((low, high), one.p, one.mu)
        result.setdefault(one.name, []).append(float(1 - last / first))
    return result


class Locus(NamedTuple):
    """A bifurcation's curve in the (p, mu) plane: a name, p (n,) increasing, mu (n,) and states (2, n)."""

    name: str
    p: np.ndarray
    mu: np.ndarray
    state: np.ndarray


@remembered
def loci_in_p(low=0.1, high=3.0):
    """Loci in the (p, mu) plane of the bifurcations found at p = 1 on the main branches: tuple of Locus."""
    found = [(one.name, flaw) for one in at_exponent(branches(), 1.0) for flaw in one.found]
    curves = []
    for name, kind in ((IN_WELL, FOLD), (IN_WELL, FLIP), (LARGE, FOLD), (THIRD, FOLD), (THIRD, FLIP)):
        curves += [(f"{name}, {kind}", flaw) for place, flaw in found if (place, flaw.kind) == (name, kind)]
    start = [flaw for _, flaw in curves]
    ways = bifurcation_curves(
        start * 2, bounds=(low, high), direction=np.repeat([-1.0, 1.0], len(start)), step=0.05, largest=0.1, points=80
    )
    result = []
    for (name, _), down, up in zip(curves, ways[: len(start)], ways[len(start) :], strict=True):
        u = joined(down.u, up.u)
        result.append(Locus(name, joined(down.parameter, up.parameter), u[2], u[:2]))
    return tuple(result)


def joined(down, up):
    """Both ways from the same start as one curve (m, n) or (n,); the last axis runs along it."""
    return np.concatenate([down[..., :0:-1], up], axis=-1)


@remembered
def brute_force(p, first=0.05, last=0.29, forcings=61, transient=100):
    """Late stroboscopic x against mu, both sweeps and the STARTS: dict name -> (mu, x), each (n,)."""
    mu = np.linspace(first, last, forcings)
    found = bifurcation_diagram(replace(paper.OSCILLATOR, p=p), mu, STARTS, transient, 12, **DRAWING)
    result = {}
    for name, points in (
        ("many starts", found.scattered),
        ("forward sweep", found.forward),
        ("backward sweep", found.backward),
    ):
        x = points[0]
        mu = found.mu.reshape(1, -1, *[1] * (x.ndim - 2))
        result[name] = np.broadcast_to(mu, x.shape).ravel(), x.ravel()
    return result


@remembered
def agreement(p, mu=(0.09, 0.12, 0.15, 0.18, 0.21, 0.24), periods=500):
    """Distance of what the STARTS settle on to the nearest orbit of the followed branches: (len(mu), starts)."""
    followed = at_exponent(branches(), p)
    halves = {name: branch.halves for name, branch, _ in followed}
    starts = STARTS.shape[1]
    family = replace(paper.OSCILLATOR, p=p, mu=np.repeat(mu, starts))
    t = family.period * np.array([0.0, periods])
    late = integrate(family, np.tile(STARTS, len(mu)), t, rtol=1e-11, atol=1e-13).states[:, -1]
    late = late.reshape(2, len(mu), starts)
    result = []
    for j, value in enumerate(mu):
        one = replace(paper.OSCILLATOR, p=p, mu=value)
        names = ((name, orbit) for name, orbits in orbits_at(followed, value).items() for orbit in orbits)
        points = [cycle(one, orbit.state, halves[name]) for name, orbit in names]
        away = late[:, j, :, None] - np.concatenate(points, axis=1)[:, None]
        result.append(np.min(np.hypot(*away), axis=1))
    return np.array(result)


@remembered
def in_exponent(mu=0.2, low=0.1, high=3.0):
    """The small orbit in a well at the forcing mu followed in p: a AnnotatedBranch in the order of p.

    Raises ConvergenceError where it does not reach both ends.
    """
    seeds = replace(paper.OSCILLATOR, p=np.ones(2), mu=mu)
    ways = orbit_branches(
        seeds, settled(seeds, (1.05, 0.0)), field="p", bounds=(low, high), direction=np.array([-1.0, 1.0]), largest=0.1
    )
    down, up = ways
    if (down.parameter[-1], up.parameter[-1]) != (low, high):
        raise ConvergenceError(f"mu = {mu:g}: the orbit does not reach p = {low:g} and {high:g}")
    state, parameter, multipliers = (
        joined(getattr(down, part), getattr(up, part)) for part in ("state", "parameter", "multipliers")
    )
    family = up.osc.members(np.zeros(parameter.size, dtype=int), p=parameter)
    both = OrbitBranch(family, "p", up.halves, state, parameter, multipliers, BOUND)
    return AnnotatedBranch(IN_WELL, both, tuple(bifurcations([both])[0]))
