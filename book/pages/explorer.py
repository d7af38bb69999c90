"""What the explorer page shows for each p and mu, computed once when the book is built: a dictionary ready for JSON."""

from dataclasses import replace

import numpy as np

from duffing import paper
from duffing.errors import ConvergenceError, NoSaddleOrbitError
from duffing.flow import integrate
from duffing.lyapunov import lyapunov_spectrum
from duffing.manifolds.tangency import homoclinic_tangency, splitting
from duffing.melnikov import critical_amplitude

from ..remember import remembered
from ..studies.accuracy import CURVES, integrator

# Forcings that tell the story, besides fractions of the threshold: the paper's two, the window, the large orbit.
AMPLITUDES = (
    0.02,
    0.05,
    0.08,
    0.1,
    0.13,
    0.16,
    0.19,
    0.21,
    0.23,
    0.25,
    0.26,
    0.265,
    0.27,
    0.275,
    0.285,
    0.3,
    0.35,
    0.4,
)
FRACTIONS = (0.6, 0.9, 1.0, 1.1)
PHASES, SETTLED, KEPT, POINTS = 32, 200, 6, 120
PER_PERIOD, PER_PERIOD_HISTORY, HISTORY = 40, 10, 48
SCALE = 1000  # positions travel as whole thousandths


@remembered
def stories(p=(0.1, 0.5, 1.0, 2.0), amplitudes=AMPLITUDES, osc=paper.OSCILLATOR):
    """One entry for each p: dict of "p", "mu_c", "tangency" (None where it has no answer), "curve" (mu, lambda_1) and
    "cases", a list over the forcings with

    mu, exponent : the forcing and lambda_1 there
    path : x and v in thousandths over the last periods (one round of a periodic orbit, up to KEPT of another)
    points : stroboscopic points in thousandths, POINTS of them or one round
    period : forcing periods in a round, 0 where none up to KEPT is seen
    history : x in thousandths over the first HISTORY periods
    splitting : x_u - x_s in millionths over the phases of a period, None where friction catches the mass on the hump
    """
    return [_story(replace(osc, p=exponent), np.array(amplitudes)) for exponent in p]


def _story(osc, amplitudes):
    mu_c = float(critical_amplitude(osc))
    tangency = _or_none(homoclinic_tangency, osc)
    mu = np.unique(np.concatenate([amplitudes, np.round(np.array(FRACTIONS) * (tangency or mu_c), 5)]))
    grid = np.round(np.arange(0.005, amplitudes.max() + 0.0025, 0.005), 6)
    both = np.concatenate([mu, grid])
    method = integrator(osc.p, CURVES)
    exponent = lyapunov_spectrum(replace(osc, mu=both), paper.START, SETTLED, 40, k=1, **method).exponents[0]
    order = np.argsort(both)
    history, path, points = _motion(replace(osc, mu=mu), method)
    cases = []
    for i, forcing in enumerate(mu):
        period = _round(points[:, :, i])
        kept = period or KEPT
        cases.append(
            {
                "mu": float(forcing),
                "exponent": round(float(exponent[i]), 4),
                "period": period,
                "path": _whole(path[:, -kept * PER_PERIOD - 1 :, i], SCALE),
                "points": _whole(points[:, -(period or POINTS) :, i], SCALE),
                "history": _whole(history[:, i], SCALE),
                "splitting": None if tangency is None else _split(replace(osc, mu=float(forcing))),
            }
        )
    curve = [[float(m) for m in both[order]], [round(float(e), 4) for e in exponent[order]]]
    return {"p": float(osc.p), "mu_c": mu_c, "tangency": tangency, "curve": curve, "cases": cases}


def _motion(family, method):
    """x over the first periods (n, N), the late path (2, n, N) and the stroboscopic points (2, POINTS, N)."""
    first = np.arange(HISTORY * PER_PERIOD_HISTORY + 1) / PER_PERIOD_HISTORY
    strobe = np.arange(HISTORY + 1, SETTLED + POINTS - KEPT + 1)
    last = strobe[-1] + np.arange(1, KEPT * PER_PERIOD + 1) / PER_PERIOD
    t = np.concatenate([first, strobe, last]) * family.period
    states = integrate(family, paper.START, t, **method).states
    late = states[:, -last.size - 1 :]
    points = np.concatenate([states[:, first.size : first.size + strobe.size], late[:, PER_PERIOD::PER_PERIOD]], axis=1)
    return states[0, : first.size], late, points[:, -POINTS:]


def _round(points):
    """Forcing periods after which the stroboscopic points (2, n) repeat, 0 if none up to KEPT is seen."""
    for period in range(1, KEPT + 1):
        if np.abs(points[:, period:] - points[:, :-period])[:, -2 * KEPT :].max() < 1 / SCALE:
            return period
    return 0


def _split(osc):
    phase = 2 * np.pi * np.arange(PHASES + 1) / PHASES
    values = _or_none(splitting, osc, phase)
    return None if values is None else _whole(values, 1e6)


def _or_none(function, *args):
    """The function's value, or None where the package says that there is none: the page says so in words."""
    try:
        value = function(*args)
    except (ConvergenceError, NoSaddleOrbitError):
        return None
    return float(value) if np.ndim(value) == 0 else value


def _whole(values, scale):
    return np.rint(np.asarray(values) * scale).astype(int).tolist()
