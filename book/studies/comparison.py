"""What the chapter on the exponents compares between exponents p: at equal forcing, at equal multiples of mu_c, and
at equal energy taken by the damping."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import checks, paper
from duffing.flow import integrate
from duffing.lyapunov import lyapunov_spectrum
from duffing.melnikov import critical_amplitude

from ..remember import remembered
from . import small_p
from .accuracy import integrator
from .transients import starts_between_wells
from .wandering import Wandering, mean_ratio, wandering

P = (0.1, 0.5, 1.0, 2.0)
MU_EQUAL = 0.268  # just above the onset of lasting chaos at p = 0.1; at the other exponents chaos is transient there
ENERGY_EQUAL = 0.22  # energy taken in a period; every exponent reaches it while it wanders
CHAOTIC = 0.05  # an exponent above this is called chaotic; regular motion has a negative one
MU_STRONG = 1.3  # beyond the range of the paper's figures, where chaos at p = 0.1 lasts again (at 0.85 it is transient)
RATIOS = (1.85, 2.45, 3.30, 5.60)  # each in the middle of the chaos of one of the exponents P
MU = {
    0.1: (0.264, 0.266, 0.268, 0.270, 0.272, 0.274, 0.277, 0.280, 0.285),
    0.5: (0.246, 0.250, 0.254, 0.257, 0.259, 0.262, 0.265, 0.268, 0.272),
    1.0: (0.210, 0.225, 0.230, 0.235, 0.240, 0.245, 0.250, 0.255, 0.260, 0.264, 0.268, 0.272),
    2.0: (0.220, 0.225, 0.230, 0.235, 0.240, 0.245, 0.250, 0.255, 0.260, 0.264, 0.268),
}  # forcings at which starts wander long enough
GRID = {0.1: (8, 5), 0.5: (8, 6), 1.0: (32, 16), 2.0: (16, 10)}  # columns and rows of starts: more where fewer wander


@remembered
def compared(p, mu=None, columns=None, rows=None, periods=240, osc=paper.OSCILLATOR, **sweep):
    """The Wandering at the exponent p for a tuple of forcings (default MU[p]): mu (n,), mu / mu_c (n,), Wandering.

    columns, rows : of the grid of `starts_between_wells` (default GRID[p]); sweep : how, as for `lifetimes`
    """
    mu = np.array(MU[p] if mu is None else mu)
    family = replace(osc, p=p, mu=mu)
    starts = starts_between_wells(columns or GRID[p][0], rows or GRID[p][1])
    ratio = mu / critical_amplitude(replace(osc, p=p))
    return mu, ratio, Wandering(*wandering(family, starts, periods, **sweep, **integrator(p)))


def curves(found):
    """What `figures.exponents_compared` draws of dict p -> (mu, mu / mu_c, Wandering) as `compared` gives them."""
    return {
        p: (mu, ratio, w.dissipated, w.spread, w.exponent, w.error, w.share > 0.5)
        for p, (mu, ratio, w) in found.items()
    }


@remembered
def equal_forcing(p=P, mu=MU_EQUAL):
    """lambda_1 of the wandering motion at one forcing, and one standard error, for each p: (len(p),) each."""
    found = [compared(exponent, (mu,))[2] for exponent in p]
    return np.array([one.exponent[0] for one in found]), np.array([one.error[0] for one in found])


@remembered
def equal_energy(p=P, value=ENERGY_EQUAL, within=0.06):
    """lambda_1 where the damping takes one energy in a period, and one standard error, for each p: (len(p),) each."""
    found = [compared(exponent)[2] for exponent in p]
    return tuple(np.transpose([at_equal(value, w.dissipated, w.exponent, w.error, within) for w in found]))


def lead(exponents, errors):
    """By how many standard errors of their difference the first exponent is smaller than the nearest of the others."""
    return float(np.min((exponents[1:] - exponents[0]) / np.hypot(errors[1:], errors[0])))


class Chaotic(NamedTuple):
    """Of the starts at n forcings: share (n,) with lambda_1 > CHAOTIC; exponent, error (n,) : the mean of lambda_1 over
    these and one standard error, nan where there is none; largest (n,) : the largest lambda_1 of all starts."""

    share: np.ndarray
    exponent: np.ndarray
    error: np.ndarray
    largest: np.ndarray


@remembered
def chaotic_starts(mu, p, columns=8, rows=5, periods=199, osc=paper.OSCILLATOR, **sweep):
    """The Chaotic of a grid of starts over the paper's time, forty periods left out, for a tuple of forcings.

    sweep : how, as for `lyapunov_spectrum`
    """
    state = small_p.starts(columns, rows)
    family = replace(osc, p=p, mu=np.repeat(np.array(mu)[:, None], state.shape[1], axis=1))
    start = np.repeat(state[:, None], len(mu), axis=1)
    found = lyapunov_spectrum(family, start, periods, 40, k=1, **sweep, **integrator(p)).exponents[0]
    chaotic = found > CHAOTIC
    return Chaotic(chaotic.mean(axis=1), *mean_ratio(np.where(chaotic, found, 0.0), 1 * chaotic), found.max(axis=1))


@remembered
def chaotic_exponents(mu, p=paper.P_SMALL, columns=8, rows=5, periods=400, osc=paper.OSCILLATOR):
    """Two Chaotic for a tuple of forcings: by the paper's fixed step, and in friction time."""
    state = small_p.starts(columns, rows)
    family = replace(osc, p=p, mu=np.repeat(np.array(mu)[:, None], state.shape[1], axis=1))
    start, found = np.repeat(state[:, None], len(mu), axis=1), []
    for options in ({"method": "rk4"}, integrator(p)):
        one = lyapunov_spectrum(family, start, periods, 40, k=1, history=False, **options).exponents[0]
        chaotic = one > paper.THRESHOLD  # a mean that a capture has diluted is no exponent of chaos
        mean = mean_ratio(np.where(chaotic, one, 0.0), 1 * chaotic)
        found.append(Chaotic(chaotic.mean(axis=1), *mean, one.max(axis=1)))
    return tuple(found)


def at_equal_ratio(ratios=RATIOS, p=P, osc=paper.OSCILLATOR, **sizes):
    """The Chaotic, each part (len(ratios), len(p)), at ratio times mu_c; sizes : as for `chaotic_starts`."""
    mu = [np.array(ratios) * critical_amplitude(replace(osc, p=exponent)) for exponent in p]
    found = [chaotic_starts(part, exponent, **sizes) for part, exponent in zip(mu, p, strict=True)]
    return Chaotic(*(np.transpose(parts) for parts in zip(*found, strict=True)))


@remembered
def speeds(mu, p, columns=8, rows=5, periods=60, transient=40, osc=paper.OSCILLATOR):
    """The greatest |v| of a grid of starts after a transient, and the share of time with |v| > 1."""
    return speeds_of(replace(osc, p=p, mu=mu), small_p.starts(columns, rows), periods, transient, **integrator(p))


def speeds_of(osc, starts, periods, transient, **options):
    """The greatest |v| under one oscillator from the starts (2, m), and the share of time with |v| > 1.

    options : as for `duffing.flow.integrate`
    """
    family = replace(osc, mu=np.full(starts.shape[1], osc.mu))
    t = osc.period * np.concatenate([[0.0], transient + np.arange(periods * 50) / 50])
    v = np.abs(integrate(family, starts, t, **options).states[1, 1:])
    return float(v.max()), float(np.mean(v > 1))


def at_equal(value, x, y, error, within):
    """y at x = value and one standard error, from the straight line of least squares, weighted by the errors, through
    the points nearer than `within`; points without a finite error do not count.

    Raises ValueError where fewer than three points are left.
    """
    x, y, error = (np.asarray(part, dtype=float) for part in (x, y, error))
    within = checks.positive("within", within)
    usable = np.isfinite(x) & np.isfinite(y) & np.isfinite(error) & (np.abs(x - value) < within)
    if usable.sum() < 3:
        raise ValueError(f"within = {within}: must leave at least three points, leaves {usable.sum()}")
    design = np.array([np.ones(usable.sum()), x[usable] - value]).T / error[usable, None]
    covariance = np.linalg.inv(design.T @ design)
    return float(covariance[0] @ design.T @ (y[usable] / error[usable])), float(np.sqrt(covariance[0, 0]))
