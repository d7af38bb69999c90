"""Lyapunov exponents: mean growth rates of tangent vectors, or of the distance of two trajectories."""

from typing import NamedTuple

import numpy as np

from . import checks
from .companion import two_trajectory_growth
from .flow import integrate, stroboscopic_times
from .sweep import over_blocks


class LyapunovSpectrum(NamedTuple):
    """exponents (k, *family), largest first, per unit time; error (k, *family), one standard error from batch means;
    history (k, periods, *family), the running estimates after each period."""

    exponents: np.ndarray
    error: np.ndarray
    history: np.ndarray


def lyapunov_spectrum(
    osc, state=(0.45, 0.1), periods=200, transient=40, k=2, method="auto", executor=None, progress=None, **options
):
    """The k largest Lyapunov exponents of the orbits that start in `state` at t = 0, per unit time.

    state : (2,) for all members or (2, *family)
    periods, transient : forcing periods averaged over and, before them, thrown away
    k : 1 (the largest alone, cheaper) or 2
    method, options : as for `duffing.flow.integrate`; method="rk4" with transient=0 is the paper's algorithm
    executor, progress : as for `duffing.sweep.over_blocks`

    Returns a LyapunovSpectrum. An exponent is -inf (its error 0) where a creep through zero force has annihilated the
    tangent direction (p <= 1/2). With fewer than eight periods there is no error estimate and `error` is inf.
    Raises ValueError for invalid input, DivergedError or ConvergenceError as the integrators do.

    Source: Benettin et al. (1980) for the method; Wolf et al. (1985) as cited by the paper.
    """
    if checks.count("k", k) > 2:
        raise ValueError(f"k = {k}: must be 1 or 2, the number of exponents of a plane map")
    checks.count("periods", periods)
    checks.count("transient", transient, least=0)
    task = {"periods": periods, "transient": transient, "k": k, "method": method, **options}
    growth = over_blocks(_growth_per_period, osc, checks.state(state, osc.shape), task, executor, progress)
    return _average(growth.reshape(k, periods, *osc.shape), osc.period)


def two_trajectory_exponent(osc, state=(0.45, 0.1), periods=200, transient=40, d0=1e-8, steps_per_period=500):
    """lambda_1 by the paper's algorithm with two trajectories: Runge-Kutta, distance reset to d0 once a period.

    Arguments and result as for `lyapunov_spectrum` with k = 1; d0 : the distance of the trajectories (at first in x).
    """
    checks.count("transient", transient, least=0)
    checks.positive("d0", d0)
    total = transient + checks.count("periods", periods)
    growth = two_trajectory_growth(osc, state, total, d0=d0, steps_per_period=steps_per_period)
    return _average(growth[None, transient:].reshape(1, periods, *osc.shape), osc.period)


def standard_error(samples):
    """One standard error of the mean of a stationary, correlated series (its axis 0) by batch means; inf if too short.

    The number of batches is about the square root of the length, so that batches outlast the correlations as it grows.
    """
    batches = int(np.sqrt(len(samples)))
    if len(samples) < 8:
        return np.full(np.shape(samples)[1:], np.inf)
    length = len(samples) // batches
    # The oldest samples are left out where the length does not divide.
    means = samples[-batches * length :].reshape(batches, length, *samples.shape[1:]).mean(axis=1)
    return means.std(axis=0, ddof=1) / np.sqrt(batches)


def _growth_per_period(osc, state, periods, transient, k, method, **options):
    t = stroboscopic_times(osc, transient + periods)
    return integrate(osc, state, t, tangents=k, method=method, **options).growth[:, transient:]


def _average(growth, period):
    # growth: (k, periods, *family). The frame need not come out largest first over a finite time (a focus turns it).
    history = np.cumsum(growth, axis=1) / (np.arange(1, growth.shape[1] + 1).reshape(-1, *[1] * (growth.ndim - 2)))
    history = history / period
    annihilated = np.isneginf(history[:, -1])
    finite = np.where(annihilated[:, None], 0.0, growth)
    error = np.stack([standard_error(row) for row in finite]) / period
    order = np.argsort(-history[:, -1], axis=0, kind="stable")
    history = np.take_along_axis(history, order[:, None], axis=0)
    return LyapunovSpectrum(history[:, -1], np.take_along_axis(error, order, axis=0), history)
