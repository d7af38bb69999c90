"""Findings on the paper's contradiction: transients, the size of lambda_1, and the order of the thresholds."""

from dataclasses import replace

import numpy as np

from duffing import paper
from duffing.flow import integrate
from duffing.melnikov import critical_amplitude

from ..remember import remembered
from ..studies import comparison as comparison_study
from ..studies import reproduction, small_p
from ..studies import transients as transient_study
from ..studies.survival import exponential, law_test
from .exponents import lasting_chaos, onset_ratios
from .verdicts import CONFIRMED, RESOLVED, Finding, decide, finds

FINDINGS = {}
BOTH = (paper.P_SMALL, paper.P_LINEAR)  # Fig. 4a and 4b
MU_LONG = 0.264  # a little below the window of p = 0.1, where transients are long enough to be counted


@remembered
def window_ends():
    """Folds of the small orbits and crises at p = 0.1 and p = 1: ((2,), (2,)) forcings."""
    return transient_study.folds(BOTH)[0], transient_study.crises(BOTH)


@finds(FINDINGS, "transients")
def _transients(osc=paper.OSCILLATOR):
    mu_c = critical_amplitude(osc)
    onset = onset_ratios(osc)[1][0]
    mu = np.linspace(0.05, onset - 0.001, 200)
    t = osc.period * np.arange(0, 200 * 20 + 1) / 20
    x = integrate(replace(osc, mu=mu), paper.START, t, method="rk4").states[0]
    jumps = np.diff(np.sign(x), axis=0) != 0
    # jumps after ten periods, none in the end
    transient = jumps[20 * 10 :].any(axis=0) & ~jumps[-20 * 20 :].any(axis=0)
    long = MU_LONG if osc == paper.OSCILLATOR else paper.MU_REGULAR
    time, settled, _ = transient_study.sample(long, osc=osc)
    fit = exponential(time, settled, transient_study.SINCE)
    _, chance = law_test(time, settled, transient_study.SINCE, until=1000)
    text = (
        f"From the paper's start {transient[mu > mu_c].mean():.0%} of the forcings between $μ_c$ and the onset still jump between the wells after "
        f"ten periods and no more in the last twenty of two hundred; below $μ_c$ {transient[mu < mu_c].mean():.0%} do. Lifetimes {'follow' if chance > 0.01 else 'do not follow'} the "
        f"exponential law: at μ = {long} its mean is {fit.mean:.0f} ± {fit.error:.0f} periods (Kolmogorov and Smirnov's test: probability {chance:.2f})."
    )
    return decide(transient[mu > mu_c].any() and not transient[mu < mu_c].any(), text)


@finds(FINDINGS, "larger-lambda")
def _larger():
    curves = [reproduction.exponent_curve(p) for p in BOTH]
    top = [float(exponent[mu >= 0.1].max()) for mu, exponent in curves]  # no false positives
    lasts = [lasting_chaos(p)[1] for p in BOTH]
    exponents, errors = comparison_study.equal_forcing()
    k = comparison_study.P.index(paper.P_LINEAR)
    small, linear, small_error, linear_error = exponents[0], exponents[k], errors[0], errors[k]
    least = "the smallest" if comparison_study.lead(exponents, errors) > 2 else "not clearly the smallest"
    strong = [comparison_study.chaotic_starts((comparison_study.MU_STRONG,), p) for p in BOTH]
    text = (
        f"By the paper's algorithm the largest λ₁ over μ is {top[0]:.3f} at p = 0.1 and {top[1]:.3f} at p = 1: alike within the scatter of single runs. Averaged "
        f"over the chaotic part of many runs at the same forcing, μ = {comparison_study.MU_EQUAL}, it is {small:.3f} ± {small_error:.3f} and {linear:.3f} ± {linear_error:.3f}; "
        f"of {exponents.size} values of p from 0.1 to 2 it is {least} at p = 0.1. Under strong forcing, beyond the paper's figures, it may be otherwise: at μ = {comparison_study.MU_STRONG} "
        f"{strong[0].share[0]:.0%} of the starts are chaotic at p = 0.1 and {strong[1].share[0]:.0%} at p = 1, the largest exponents {strong[0].largest[0]:.3f} and {strong[1].largest[0]:.3f}. What differs is how long chaos lasts: after a thousand periods {lasts[0].sum()} of {lasts[0].size} and {lasts[1].sum()} of {lasts[1].size} of the chaotic μ are still chaotic."
    )
    scatter = small_p.chaos().spread
    text += f" The difference of the two largest exponents is {top[0] - top[1]:.3f}, the scatter of a single run {scatter:.3f}."
    return decide(top[0] > top[1], text, limited=top[0] - top[1] < 3 * scatter)


@finds(FINDINGS, "contradiction")
def _contradiction(osc=paper.OSCILLATOR):
    p, onset, _ = onset_ratios(osc)
    small, linear = onset[0], onset[p == paper.P_LINEAR][0]
    if osc != paper.OSCILLATOR:  # its fold and its crisis are not looked for: chaos may begin otherwise
        return Finding(RESOLVED if small > linear else CONFIRMED, f"The onsets are {small:.3f} and {linear:.3f}.")
    rank = np.corrcoef(np.argsort(np.argsort(-onset)), np.arange(onset.size))[0, 1]
    folds, crises = window_ends()
    ordered = small > linear and folds[0] > folds[1] and crises[0] > crises[1]
    text = (
        f"The size of λ₁ is not a threshold. The numerical onsets themselves, {small:.3f} at p = 0.1 and {linear:.3f} at p = 1, "
        f"{'have' if small > linear else 'do not have'} Melnikov's order (rank correlation of onset with falling p over Fig. 3b: {rank:.2f}), and so "
        f"{'have' if ordered else 'have not'} the bifurcations behind them: the small orbits end at {folds[0]:.4f} and {folds[1]:.4f}, chaos is destroyed at {crises[0]:.3f} and {crises[1]:.3f}. "
        f"At p = 0.1 the first {'comes' if folds[0] < crises[0] else 'does not come'} before the second{' and leaves a window in which chaos attracts' if folds[0] < crises[0] else ''}; "
        f"at p = 1 it {'does, too' if folds[1] < crises[1] else 'comes after it'}."
    )
    return Finding(RESOLVED if ordered else CONFIRMED, text)
