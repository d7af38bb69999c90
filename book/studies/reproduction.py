"""The arrays behind the paper's figures, computed by the paper's own algorithm with the parameters of `paper`.

Every function takes an oscillator, the paper's unless another is given. Results are kept for the process, since several
chapters and the ledger look at the same curves.
"""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import checks, paper
from duffing.flow import trajectory
from duffing.lyapunov import lyapunov_spectrum, two_trajectory_exponent
from duffing.melnikov import critical_amplitude

from ..remember import remembered


def mu_grid(step=0.001, last=0.5):
    """Forcing amplitudes 0, step, ... last: decimals as printed, so that mu = 0.27 is on the grid.

    Raises ValueError unless 0 < step <= last.
    """
    step, last = checks.positive("step", step), checks.positive("last", last)
    if step > last:
        raise ValueError(f"step = {step}: must be at most last = {last}")
    decimals = max(6, 3 - math.floor(math.log10(step)))
    return np.round(np.arange(round(last / step) + 1) * step, decimals)


@remembered
def exponent_curve(
    p,
    step=0.001,
    last=0.5,
    osc=paper.OSCILLATOR,
    d0=None,
    steps_per_period=paper.STEPS_PER_PERIOD,
    start=paper.START,
):
    """lambda_1 versus mu as in Fig. 4: (mu, lambda_1), each (n,); the start anew for every mu, no transient cut.

    d0 : None for the tangent vector, else the distance of the two trajectories
    """
    mu = mu_grid(step, last)
    family = replace(osc, p=p, mu=mu)
    options = {"periods": paper.PERIODS, "transient": 0, "steps_per_period": steps_per_period}
    if d0 is None:
        spectrum = lyapunov_spectrum(family, start, k=1, method="rk4", **options)
    else:
        spectrum = two_trajectory_exponent(family, start, d0=d0, **options)
    return mu, spectrum.exponents[0]


@remembered
def onsets(p, step=0.001, last=0.35, osc=paper.OSCILLATOR, start=paper.START, threshold=paper.THRESHOLD):
    """The least mu of the grid with lambda_1 above the threshold, for each p of the tuple: (len(p),).

    nan where no mu of the grid reaches the threshold: "not found" is an answer, and the figure leaves it out.
    """
    mu = mu_grid(step, last)[1:]  # mu = 0 has no forcing
    family = replace(osc, p=np.array(p)[:, None], mu=mu)
    exponents = lyapunov_spectrum(family, start, paper.PERIODS, 0, k=1, method="rk4").exponents[0]
    chaotic = exponents > threshold
    return np.where(chaotic.any(axis=1), mu[chaotic.argmax(axis=1)], np.nan)


class Motion(NamedTuple):
    """t (n,); path (2, n): x and v; points (2, periods): stroboscopic, at t = 2 pi k / omega, k = 1, 2, ..."""

    t: np.ndarray
    path: np.ndarray
    points: np.ndarray

    def part(self, first, last, period):
        """Path and points with first <= t <= last."""
        strobe = period * np.arange(1, self.points.shape[1] + 1)
        inside, struck = (self.t >= first) & (self.t <= last), (strobe >= first) & (strobe <= last)
        return self.path[:, inside], self.points[:, struck]


@remembered
def motion(mu, osc=paper.OSCILLATOR, end=paper.END, every=5, start=paper.START):
    """The motion of Fig. 5 and 6 at the forcing mu, from the start to t = end; every fifth step is kept.

    Raises ValueError unless `every` divides the steps of a period and `end` holds a whole period at least.
    """
    osc = replace(osc, mu=mu)
    if paper.STEPS_PER_PERIOD % checks.count("every", every):
        raise ValueError(f"every = {every}: must divide {paper.STEPS_PER_PERIOD}, the steps of a period")
    if checks.positive("end", end) < osc.period:
        raise ValueError(f"end = {end}: must be at least a period of the forcing, {osc.period:g}")
    kept = paper.STEPS_PER_PERIOD // every
    t = np.arange(int(end / osc.period * kept) + 1) * osc.period / kept
    path = trajectory(osc, start, t, method="rk4", steps_per_period=paper.STEPS_PER_PERIOD)
    # Taken from the path itself: a second run, landing at other times, would round otherwise and part from it in chaos.
    return Motion(t, path, path[:, kept::kept])


def critical_ratio(p, omega, osc=paper.OSCILLATOR):
    """mu_c / alpha of Eq. 13 for Fig. 3a: (len(p), len(omega))."""
    return critical_amplitude(replace(osc, alpha=1.0, p=np.asarray(p)[:, None], omega=np.asarray(omega)))
