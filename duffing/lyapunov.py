"""Lyapunov exponents: mean growth rates of tangent vectors, or of the distance of two trajectories."""

from typing import NamedTuple

import numpy as np

from . import checks
from .blocks import block_for, over_blocks
from .flow import integrate, stroboscopic_times
from .integrators.companion import two_trajectory_growth


class LyapunovSpectrum(NamedTuple):
    """exponents (k, *family), largest first, per unit time; error (k, *family), one standard error from batch means;
    history (k, periods, *family), the running estimates after each period, or None."""

    exponents: np.ndarray
    error: np.ndarray
    history: np.ndarray | None


def lyapunov_spectrum(
    osc, state=(0.45, 0.1), periods=200, transient=40, k=2, method="auto",
    executor=None, progress=None, checkpoint=None, history=True, on_failure="raise", **options,
):  # the problem, then how it is run  # fmt: skip
    """The k largest Lyapunov exponents of the orbits that start in `state` at t = 0, per unit time.

    state : (2,) for all members or (2, *family)
    periods, transient : forcing periods averaged over and, before them, thrown away
    k : 1 (the largest alone, cheaper) or 2
    method, options : as for `duffing.flow.integrate`; method="rk4" with transient=0 is the paper's algorithm
    executor, progress, checkpoint : as for `duffing.blocks.over_blocks`: where it runs, whether it shows how far it is,
        and the folder from which it can be resumed
    on_failure : "raise", or "nan": members that diverge or do not converge are NaN, and one warning says so
    history : False leaves out the running estimates, which for a large family need the most memory

    Returns a LyapunovSpectrum. An exponent is -inf (its error 0) where a creep through zero force has annihilated the
    tangent direction (p <= 1/2). With fewer than eight periods there is no error estimate and `error` is inf.
    Raises ValueError for invalid input, DivergedError or ConvergenceError as the integrators do, LostWorkerError as
    `over_blocks` does.

    Source: Benettin et al. (1980) for the method; Wolf et al. (1985) as cited by the paper.
    """
    checks.model(osc)
    if checks.count("k", k) > 2:
        raise ValueError(f"k = {k}: must be 1 or 2, the number of exponents of a plane map")
    periods, transient = checks.count("periods", periods), checks.count("transient", transient, least=0)
    state = checks.state(state, osc.shape)
    task = {"periods": periods, "transient": transient, "k": k, "method": method, "history": bool(history), **options}
    run = {"executor": executor, "progress": progress, "checkpoint": checkpoint, "on_failure": on_failure}
    run |= {"block": block_for(transient + periods, method, **options), "rows": (k, 2 + periods * bool(history))}
    rows = over_blocks(_spectrum_rows, osc, state, task, **run).reshape(k, -1, *osc.shape)
    return LyapunovSpectrum(rows[:, 0], rows[:, 1], rows[:, 2:] if history else None)


def two_trajectory_exponent(osc, state=(0.45, 0.1), periods=200, transient=40, d0=1e-8, steps_per_period=500):
    """lambda_1 by the paper's algorithm with two trajectories: Runge-Kutta, distance reset to d0 once a period.

    Arguments and result as for `lyapunov_spectrum` with k = 1; d0 : the distance of the trajectories (at first in x).
    """
    checks.model(osc)
    transient = checks.count("transient", transient, least=0)
    total = transient + checks.count("periods", periods)
    growth = two_trajectory_growth(osc, checks.state(state, osc.shape), total, d0=d0, steps_per_period=steps_per_period)
    return averages(growth[None, transient:].reshape(1, periods, *osc.shape), osc.period)


def standard_error(samples):
    """One standard error of the mean of a stationary, correlated series (its axis 0) by batch means; inf if too short.

    The number of batches is about the square root of the length, so that batches outlast the correlations as it grows.
    """
    batches = int(np.sqrt(len(samples)))
    if len(samples) < 8:
        return np.full(np.shape(samples)[1:], np.inf)
    length = len(samples) // batches
    # The oldest samples are left out where the length does not divide.
    means = _mean(np.moveaxis(samples[-batches * length :].reshape(batches, length, *samples.shape[1:]), 1, 0))
    return np.sqrt(_mean((means - _mean(means)) ** 2) / (batches - 1))


def _mean(samples):
    # One after the other: NumPy's own sum goes by another order for one member than for many.
    return np.cumsum(samples, axis=0)[-1] / len(samples)


def _spectrum_rows(osc, state, periods, transient, k, method, history, **options):
    """Exponents, errors and, after them, the history: array (k, 2 or 2 + periods, N)."""
    t = stroboscopic_times(osc, transient + periods)
    growth = integrate(osc, state, t, tangents=k, method=method, **options).growth[:, transient:]
    exponents, error, running = averages(growth, osc.period)
    return np.concatenate([exponents[:, None], error[:, None], *([running] if history else [])], axis=1)


def averages(growth, period):
    """The LyapunovSpectrum of what each period adds to the tangents' logarithms, growth (k, periods, *family)."""
    # The frame need not come out largest first over a finite time (a focus turns it).
    history = np.cumsum(growth, axis=1) / (np.arange(1, growth.shape[1] + 1).reshape(-1, *[1] * (growth.ndim - 2)))
    history = history / period
    annihilated = np.isneginf(history[:, -1])
    finite = np.where(annihilated[:, None], 0.0, growth)
    error = np.stack([standard_error(row) for row in finite]) / period
    order = np.argsort(-history[:, -1], axis=0, kind="stable")
    history = np.take_along_axis(history, order[:, None], axis=0)
    return LyapunovSpectrum(history[:, -1], np.take_along_axis(error, order, axis=0), history)
