"""Chaos compared fairly: what orbits do while they wander, transient or not, over many starts.

An exponent averaged over a fixed time mixes the chaos with the regular motion that ends it, in shares which depend on
the start. Here the average runs over the wandering alone (`lifetimes`): it belongs to the chaotic set, which exists for
every forcing well above the tangency, whether it attracts or not.
"""

from typing import NamedTuple

import numpy as np

from duffing import checks
from duffing.flow import integrate
from duffing.transients.lifetimes import lifetimes

SINCE, UNTIL = 15, 40  # periods left out after the start and before the capture, in which the motion is already regular
BLOCK, FRESH = 60, 3  # periods of a block of `lifetimes`, and those of it in which the tangent is still turning
SAMPLES, PASSES = 32, 8  # points a period, and periods of each orbit, from which the dissipated energy is computed


class Wandering(NamedTuple):
    """Averages over the wandering of the starts, for n oscillators; nan where no start wanders long enough.

    share : of the starts still wandering after the periods asked for
    exponent, error : lambda_1 per unit time and one standard error
    dissipated, spread : energy taken by the damping per forcing period, and its standard error
    periods : number of periods that the exponent is averaged over
    """

    share: np.ndarray
    exponent: np.ndarray
    error: np.ndarray
    dissipated: np.ndarray
    spread: np.ndarray
    periods: np.ndarray


def wandering(osc, starts, periods=240, method="auto", executor=None, progress=None, checkpoint=None, **options):
    """The Wandering of the starts (2, m) under each of the oscillators (n,), watched for `periods` forcing periods.

    executor, progress, checkpoint : as for `lifetimes`
    method, options, errors : as for `duffing.flow.integrate`
    """
    starts = np.asarray(starts, dtype=float)
    n, m = osc.columns().shape[1], starts.shape[1]
    wide = osc.repeated(m)
    state = np.tile(starts, n)
    block = min(BLOCK, checks.count("periods", periods))
    run = {"executor": executor, "progress": progress, "checkpoint": checkpoint}
    lived = lifetimes(wide, state, periods, block=block, tangents=1, method=method, **run, **options)
    number = np.arange(periods)[:, None]
    counted = (number >= SINCE) & (number < lived.time - UNTIL * lived.settled) & (number % block >= FRESH)
    growth = np.where(counted, lived.growth, 0.0).sum(axis=0) / wide.period
    exponent, error = mean_ratio(growth.reshape(n, m), counted.sum(axis=0).reshape(n, m))
    taken = _dissipated(wide, state, lived.time - UNTIL * lived.settled > SINCE + PASSES, method, options)
    return Wandering(
        1 - lived.settled.reshape(n, m).mean(axis=1),
        exponent,
        error,
        *mean_ratio(taken.reshape(n, m), PASSES * (taken > 0).reshape(n, m)),
        counted.sum(axis=0).reshape(n, m).sum(axis=1),
    )


def mean_ratio(total, number):
    """Mean of what was counted and one standard error, (n,) each, for rows of independent runs: total, number (n, m).

    The runs differ in length: it is the sum of all totals over the sum of all numbers, its error the runs' scatter.
    nan in a row with nothing counted, an infinite error where a single run counted.
    """
    runs, whole = np.sum(number > 0, axis=1), np.sum(number, axis=1).astype(float)
    safe = np.where(whole > 0, whole, 1.0)
    mean = np.sum(total, axis=1) / safe
    off = np.where(number > 0, total - mean[:, None] * number, 0.0)
    scatter = np.sqrt(np.sum(off**2, axis=1) * runs / np.maximum(runs - 1, 1)) / safe
    empty = runs == 0
    return np.where(empty, np.nan, mean), np.where(empty, np.nan, np.where(runs == 1, np.inf, scatter))


def dissipated_energy(osc, state, periods=1, transient=0, method="auto", **options):
    """Energy (*family) that the damping takes in `periods` forcing periods, after a transient: the integral of
    alpha |v|^(p+1).

    By the trapezoidal rule with SAMPLES points a period, in which the kink at v = 0 costs little.
    method, options, errors : as for `duffing.flow.integrate`
    """
    count = checks.count("periods", periods) * SAMPLES
    transient = checks.count("transient", transient, least=0)
    cycles = transient + np.arange(count + 1) / SAMPLES
    if transient:
        cycles = np.concatenate([[0.0], cycles])
    alpha, p, _, omega, *_ = osc.columns()
    t = cycles[:, None] * 2 * np.pi / omega
    v = integrate(osc, state, t, method=method, **options).states[1, -count - 1 :]
    return np.trapezoid(alpha * np.abs(v) ** (p + 1), dx=1 / SAMPLES, axis=0).reshape(osc.shape) * osc.period


def _dissipated(wide, state, chosen, method, options):
    """Energy taken in PASSES periods from SINCE on, (N,), by the members chosen; 0 for the others."""
    taken = np.zeros(chosen.size)
    if chosen.any():
        part = wide.members(chosen)
        taken[chosen] = dissipated_energy(part, state[:, chosen], PASSES, SINCE, method, **options)
    return taken
