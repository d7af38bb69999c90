"""The paper's Figs. 3b to 6 for any pair alpha, omega: what the page on the likeliest pairs shows side by side."""

from dataclasses import replace

import numpy as np

from duffing import critical_amplitude, paper

from . import reproduction
from .inference import UNITS

P = (0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0)  # the circles of Fig. 3b
THRESHOLDS = {unit: paper.THRESHOLD / scale for unit, scale in UNITS.items()}  # in nats


def oscillator(pair):
    """The paper's oscillator with the alpha and omega of the pair."""
    return replace(paper.OSCILLATOR, alpha=pair.alpha, omega=pair.omega)


def label(pair):
    """The pair's letter and values, for a figure or a table."""
    return rf"{pair.letter}: $\alpha = {pair.alpha:g}$, $\omega = {pair.omega:g}$"


def onsets(pairs, step=0.005, last=0.4):
    """Fig. 3b: dict unit -> the least mu with lambda_1 above the threshold, (pairs, len(P)), nan where none is."""
    curve = {"step": step, "last": last}
    mu = reproduction.mu_grid(**curve)[1:]  # mu = 0 has no forcing
    rows = [[reproduction.exponent_curve(p, osc=oscillator(pair), **curve)[1] for p in P] for pair in pairs]
    exponent = np.array(rows)[..., 1:]
    found = {unit: exponent > level for unit, level in THRESHOLDS.items()}
    return {unit: np.where(each.any(axis=-1), mu[each.argmax(axis=-1)], np.nan) for unit, each in found.items()}


def onset_ratios(pairs, p=paper.P_SMALL):
    """Onset of lambda_1 above the threshold (in nats) over mu_c at one exponent: (pairs,)."""
    found = onsets(pairs)["nats"][:, P.index(p)]
    return found / lines(pairs, np.array([p]))[:, 0]


def lines(pairs, p):
    """mu_c of Eq. 13: (pairs, len(p))."""
    return np.array([critical_amplitude(replace(oscillator(pair), p=p)) for pair in pairs])


def exponents(pairs, step=0.002, last=0.4):
    """Fig. 4: mu (k,), and dict p -> lambda_1 (pairs, k), in nats per unit time."""
    mu = reproduction.mu_grid(step, last)
    return mu, {
        p: np.array([reproduction.exponent_curve(p, step=step, last=last, osc=oscillator(pair))[1] for pair in pairs])
        for p in (paper.P_SMALL, paper.P_LINEAR)
    }


def portrait(pair, mu, early):
    """Fig. 5: (before, after) omega t = 1200, each path and stroboscopic points; the first is None unless early."""
    osc = oscillator(pair)
    found = reproduction.motion(mu, osc=osc, end=paper.END / osc.omega)
    settled, end = paper.SETTLED / osc.omega, paper.END / osc.omega
    return found.part(0.0, settled, osc.period) if early else None, found.part(settled, end, osc.period)


def history(pair, mu):
    """Fig. 6: omega t and x."""
    osc = oscillator(pair)
    found = reproduction.motion(mu, osc=osc, end=paper.END / osc.omega)
    return osc.omega * found.t, found.path[0]
