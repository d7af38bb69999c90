"""What small p does to exponents, in friction time: the true curve, many starts, smaller steps, dry friction."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import checks, paper
from duffing.basins.attractors import find_attractors
from duffing.errors import ConvergenceError
from duffing.flow import integrate
from duffing.lyapunov import lyapunov_spectrum, two_trajectory_exponent

from ..remember import remembered
from . import reproduction
from .accuracy import CURVES


def starts(columns=8, rows=4, osc=paper.OSCILLATOR):
    """A grid of starts over both wells: array (2, columns * rows) of x in [-1.4, 1.4] and v in [-0.6, 0.6].

    That is for delta = -1, gamma = 1; other wells have theirs in proportion.
    """
    checks.double_well(osc)
    x, v = np.meshgrid(np.linspace(-1.4, 1.4, columns), np.linspace(-0.6, 0.6, rows))
    return np.stack([x.ravel(), v.ravel()]) * osc.units()[:2, None]


@remembered
def exact_curve(p=paper.P_SMALL, step=0.002, last=0.4, osc=paper.OSCILLATOR):
    """lambda_1 versus mu in friction time from the paper's start, after forty periods: (mu, lambda_1), each (n,)."""
    mu = reproduction.mu_grid(step, last)
    spectrum = lyapunov_spectrum(replace(osc, p=p, mu=mu), paper.START, 199, 40, k=1, **CURVES)
    return mu, spectrum.exponents[0]


@remembered
def window(columns=8, rows=4, step=0.001, first=0.255, last=0.285, periods=199, osc=paper.OSCILLATOR):
    """lambda_1 over the window of chaos from many starts: (mu (n,), exponents (starts, n))."""
    mu = first + step * np.arange(round((last - first) / step) + 1)
    state = starts(columns, rows, osc)
    family = replace(osc, mu=np.tile(mu, (state.shape[1], 1)))
    state = np.repeat(state[:, :, None], mu.size, axis=2)
    return mu, lyapunov_spectrum(family, state, periods, 40, k=1, **CURVES).exponents[0]


@remembered
def longest_period(mu, periods=600, osc=paper.OSCILLATOR):
    """The longest period, in forcing periods, of the attracting orbits that the starts of `window` reach at mu."""
    return max(one.period for one in find_attractors(replace(osc, mu=mu), starts(osc=osc), periods))


class ChaoticRange(NamedTuple):
    """Forcings at which starts are chaotic: first, last with any; half_first, half_last, half_count with more than half
    of them; gaps, least : between the latter two, how many have not more than half, and the least part of them."""

    first: float
    last: float
    half_first: float
    half_last: float
    half_count: int
    gaps: int
    least: float


def chaotic_range(mu, exponents, above=0.05):
    """The ChaoticRange of the exponents (starts, n) at the forcings mu (n,); above : the least of chaos."""
    part = (exponents > above).mean(axis=0)
    any_of, most = mu[part > 0], mu[part > 0.5]
    between = part[(mu >= most.min()) & (mu <= most.max())]
    ends = map(float, (any_of.min(), any_of.max(), most.min(), most.max()))
    return ChaoticRange(*ends, most.size, int(np.sum(between <= 0.5)), float(between.min()))


class Chaos(NamedTuple):
    """Chaos at one mu: mean and standard error of lambda_1 over independent runs, the spread (one standard deviation)
    of a single run of the paper's length, and the number of runs."""

    mean: float
    error: float
    spread: float
    runs: int


@remembered
def chaos(mu=paper.MU_CHAOTIC, columns=8, rows=4, osc=paper.OSCILLATOR):
    """lambda_1 on the chaotic attractor, from the runs of `starts` whose exponent is positive over the paper's time."""
    state = starts(columns, rows, osc)
    family = replace(osc, mu=np.full(state.shape[1], mu))
    exponents = lyapunov_spectrum(family, state, paper.PERIODS - 40, 40, k=1, **CURVES).exponents[0]
    inside = exponents[exponents > 0]
    if inside.size < 2:
        raise ConvergenceError(
            f"mu = {mu}: {inside.size} of {exponents.size} runs are chaotic, two are needed for a scatter"
        )
    spread = inside.std(ddof=1)
    return Chaos(float(inside.mean()), float(spread / np.sqrt(inside.size)), float(spread), int(inside.size))


@remembered
def step_study(mu, factors=(1, 10, 50), distances=(1e-4, 1e-8), osc=paper.OSCILLATOR):
    """lambda_1 by the paper's algorithm with steps 1, 10, 50 times smaller, by tangent and by two trajectories.

    Returns dict (method, factor) -> (len(mu),), where method is "tangent" or the trajectories' distance.
    """
    family = replace(osc, mu=np.array(mu))
    table = {}
    for factor in factors:
        options = {"periods": paper.PERIODS, "transient": 0, "steps_per_period": factor * paper.STEPS_PER_PERIOD}
        tangent = lyapunov_spectrum(family, paper.START, k=1, method="rk4", **options)
        table["tangent", factor] = tangent.exponents[0]
        for d0 in distances:
            table[d0, factor] = two_trajectory_exponent(family, paper.START, d0=d0, **options).exponents[0]
    return table


class AttractingOrbits(NamedTuple):
    """Attracting orbits of one forcing period: state (2, n) at phase 0; exponents (2, n), the logarithms of the moduli
    of the multipliers over the period, largest first; friction_time (n,) spent in a period; gap (n,), how far the
    state is from its own image."""

    state: np.ndarray
    exponents: np.ndarray
    friction_time: np.ndarray
    gap: np.ndarray


@remembered
def attracting_orbits(mu, p=paper.P_SMALL, settle=200, osc=paper.OSCILLATOR):
    """The orbits that attract the paper's start at the forcings mu (a tuple), and their Floquet exponents."""
    family = replace(osc, p=p, mu=np.array(mu))
    t = family.period * np.array([0.0, settle, settle + 1.0])
    orbit = integrate(family, paper.START, t, tangents=2)
    multipliers = np.linalg.eigvals(np.moveaxis(orbit.propagators[:, :, -1], -1, 0))
    total = -family.alpha * orbit.friction_time[-1]  # of both logarithms, by Liouville's theorem
    # The smaller one by that sum: where friction time is long it is lost in the first one's rounding.
    largest = np.maximum(np.log(np.max(np.abs(multipliers), axis=1)), total / 2)
    exponents = np.array([largest, total - largest]) / family.period
    gap = np.max(np.abs(orbit.states[:, 2] - orbit.states[:, 1]), axis=0)
    return AttractingOrbits(orbit.states[:, 2], exponents, orbit.friction_time[-1], gap)


@remembered
def dry_limit(p, mu, osc=paper.OSCILLATOR):
    """lambda_1 as p goes to zero, from the paper's start: (len(p), len(mu)); half the range of x in the last period."""
    family = replace(osc, p=np.array(p)[:, None], mu=np.array(mu))
    exponents = lyapunov_spectrum(family, paper.START, 199, 40, k=1, **CURVES).exponents[0]
    t = family.period * np.concatenate([[0.0], 239 + np.arange(51) / 50])
    x = integrate(family, paper.START, t, **CURVES).states[0, 1:]
    return exponents, (np.ptp(x, axis=0) / 2).reshape(family.shape)
