"""Findings on Fig. 5 and 6 and on the conclusions: the paper's motions run again, and its outlook."""

from dataclasses import replace

import numpy as np

from duffing import paper
from duffing.flow import integrate

from ..studies import reproduction
from .exponents import exact_exponents
from .verdicts import NOT_CHECKABLE, Finding, decide, finds

FINDINGS = {}


@finds(FINDINGS, "just-after")
def _just_after():
    onset = reproduction.onsets((paper.P_SMALL,))[0]
    text = f"The onset is μ = {onset:.3f}, so μ = 0.27 is {paper.MU_CHAOTIC - onset:.3f} above it."
    return decide(0 <= paper.MU_CHAOTIC - onset < 0.01, text)


def _late(mu):
    motion = reproduction.motion(mu)
    return motion, *motion.part(paper.SETTLED, paper.END, paper.OSCILLATOR.period)


@finds(FINDINGS, "fig-5a")
def _chaotic_motion():
    _, path, points = _late(paper.MU_CHAOTIC)
    gap = min(np.min(np.hypot(*(points[:, k:] - points[:, :-k]))) for k in range(1, points.shape[1]))
    periodic = np.max(np.hypot(*np.diff(_late(paper.MU_REGULAR)[2], axis=1)))
    wells = path[0].min() < 0 < path[0].max()
    text = (
        f"No two of the {points.shape[1]} late stroboscopic points are nearer than {gap:.1e} (at μ = 0.25 they agree to {periodic:.0e}), "
        f"both wells are visited{'' if wells else ' (no)'}, and λ₁ > 0 is confirmed in friction time."
    )
    return decide(gap > 1e3 * periodic and wells and exact_exponents((paper.MU_CHAOTIC,))[0] > 0, text)


def _last_jump(motion):
    jumps = motion.t[1:][np.diff(np.sign(motion.path[0])) != 0]
    return (jumps.size, float(jumps[-1])) if jumps.size else (0, 0.0)


@finds(FINDINGS, "fig-5b-transient")
def _transient():
    jumps, last = _last_jump(reproduction.motion(paper.MU_REGULAR))
    text = f"x changes sign {jumps} times, the last at t = {last:.0f}; from other starts and with other steps the number differs."
    return decide(jumps >= 2 and last < paper.SETTLED, text)


@finds(FINDINGS, "fig-5b-steady")
def _steady():
    _, path, points = _late(paper.MU_REGULAR)
    swing, spread = np.ptp(path[0]) / 2, np.max(np.ptp(points, axis=1))
    one_well = path[0].min() * path[0].max() > 0
    text = f"One well, period 1 (stroboscopic points agree to {spread:.0e}), half the range of x {swing:.2f}."
    return decide(one_well and spread < 1e-3 and swing < 0.5, text)


@finds(FINDINGS, "t-1200")
def _settled():
    _, last = _last_jump(reproduction.motion(paper.MU_REGULAR))
    starts = 256
    x = np.linspace(-1.2, 1.2, starts)
    osc = replace(paper.OSCILLATOR, mu=np.full(starts, paper.MU_REGULAR))
    t = osc.period * np.concatenate([[0.0], np.arange(1, 101) / 20 + np.floor(paper.SETTLED / osc.period) - 5])
    late = integrate(osc, np.stack([x, 0.3 * np.sin(7 * x)]), t, method="rk4").states[0, 1:]
    settled = np.mean((late.min(axis=0) > 0) | (late.max(axis=0) < 0))
    text = f"From the paper's start the last jump is at t = {last:.0f}. Of {starts} other starts {settled:.0%} are in one well by t = 1200."
    return decide(last < paper.SETTLED, text, limited=settled < 1)


@finds(FINDINGS, "resonance")
def _resonance(osc=paper.OSCILLATOR):
    p, mu = np.array([paper.P_SMALL, paper.P_LINEAR]), np.array([0.1, 0.2, 0.5, 1.0, 2.0])
    omega = np.linspace(0.4, 2.4, 41)
    osc = replace(osc, p=p[:, None, None], omega=omega[:, None], mu=mu)
    strobe = np.concatenate([[0.0], 200 + np.arange(41) / 40])  # periods
    t = strobe[:, None] * 2 * np.pi / osc.columns()[3]
    x = integrate(osc, (1.0, 0.0), t, method="rk4").states[0, 1:].reshape(41, *osc.shape)
    peak = (np.ptp(x, axis=0) / 2).max(axis=1)
    rises = peak[0] > peak[1]
    found = "; ".join(f"μ = {m:g}: {a:.2f} and {b:.2f}" for m, a, b in zip(mu, *peak, strict=True))
    text = (
        f"The largest half range of x over ω from the start (1, 0), at p = 0.1 and p = 1 (α = {osc.alpha:g}): {found}. Where the "
        "motion stays slow, |v| < 1, a smaller exponent brakes harder and the response falls; where it is fast it rises. The paper gives no numbers."
    )
    return decide(rises.any(), text, limited=not rises.all())


@finds(FINDINGS, "dampers")
def _dampers():
    return Finding(NOT_CHECKABLE, "An outlook: no model, parameter or number is given that a computation could meet.")
