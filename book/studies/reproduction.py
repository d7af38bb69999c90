"""The arrays behind the paper's figures, computed by the paper's own algorithm with the parameters of `paper`.

Every function takes an oscillator, the paper's unless another is given. Results are kept for the process, since several
chapters and the ledger look at the same curves.
"""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import checks, paper
from duffing.flow import integrate, trajectory
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


class Scan(NamedTuple):
    """lambda_1 by the paper's algorithm over candidates: alpha (a,), omega (w,), mu (m,), exponents (a, w, m);
    amplitude (a, w): half the range of x over the last ten periods at MU_REGULAR; wells (a, w): number of wells visited
    in that time."""

    alpha: np.ndarray
    omega: np.ndarray
    mu: np.ndarray
    exponents: np.ndarray
    amplitude: np.ndarray
    wells: np.ndarray


@remembered
def parameter_scan(p=paper.P_SMALL, alphas=(0.04, 0.40, 0.02), omegas=(0.5, 1.8, 0.1), osc=paper.OSCILLATOR):
    """What the text tells of Fig. 4a to 6, computed for each candidate (alpha, omega): first, last, step of each."""
    for name, (_, _, step) in (("alphas", alphas), ("omegas", omegas)):
        checks.positive(f"step of {name}", step)
    alpha, omega = (np.round(np.arange(a, b + c / 2, c), 6) for a, b, c in (alphas, omegas))
    mu = np.round(np.arange(0.20, 0.2701, 0.01), 3)
    family = replace(osc, p=p, alpha=alpha[:, None, None], omega=omega[:, None], mu=mu)
    exponents = lyapunov_spectrum(family, paper.START, paper.PERIODS, 0, k=1, method="rk4").exponents[0]
    regular = replace(osc, p=p, alpha=alpha[:, None], omega=omega, mu=paper.MU_REGULAR)
    late = np.concatenate([[0.0], paper.PERIODS - 10 + np.arange(101) / 10])  # periods: the start, then ten times each
    t = late[:, None] * 2 * np.pi / regular.columns()[3]
    x = integrate(regular, paper.START, t, method="rk4").states[0, 1:].reshape(-1, *regular.shape)
    wells = (x > 0).any(axis=0).astype(int) + (x < 0).any(axis=0)
    return Scan(alpha, omega, mu, exponents, np.ptp(x, axis=0) / 2, wells)


def survivors(scan):
    """Which (alpha, omega) agree with the text on each count: dict of boolean arrays (a, w), the last one all together.

    The quoted exponent is to be met within 0.03, about three times the scatter of a run of the paper's length.
    """
    chaotic = scan.exponents > paper.THRESHOLD
    regular = scan.exponents[..., np.argmin(np.abs(scan.mu - paper.MU_REGULAR))]
    criteria = {
        "chaos at 0.27": chaotic[..., -1],
        "no chaos from 0.20 to 0.26": ~chaotic[..., :-1].any(axis=-1),
        "exponent 0.175 at 0.27": np.abs(scan.exponents[..., -1] - paper.LAMBDA_CHAOTIC) < 0.03,
        "convergent at 0.25": regular < 0,
        "one well at 0.25": scan.wells == 1,
    }
    return {**criteria, "all five": np.logical_and.reduce(list(criteria.values()))}
