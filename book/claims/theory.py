"""Findings on the paper's Eq. 1 to 15: proofs by sympy on the formulas that the package evaluates, and their numbers."""

from dataclasses import replace

import mpmath
import numpy as np
import sympy as sp

from duffing import paper
from duffing.manifolds.tangency import homoclinic_tangency, splitting
from duffing.melnikov import (
    critical_amplitude,
    damping_integral,
    homoclinic_orbit,
    melnikov_function,
)
from duffing.oscillator import Duffing

from ..studies.melnikov import melnikov_quadrature
from .verdicts import decide, finds

FINDINGS = {}
ALPHA, P, MU, OMEGA, GAMMA = sp.symbols("alpha p mu omega gamma", positive=True)
DELTA = sp.Symbol("delta", negative=True)
X, V, T = sp.symbols("x v t", real=True)
SYMBOLIC = Duffing(ALPHA, P, MU, OMEGA, DELTA, GAMMA)


def _vanishes(*expressions):
    return all(sp.simplify(expression.rewrite(sp.exp)) == 0 for expression in expressions)


@finds(FINDINGS, "eq-1-5")
def _equation_of_motion():
    printed = ALPHA * V * sp.Abs(V) ** (P - 1) + DELTA * X + GAMMA * X**3 - MU * sp.cos(OMEGA * T)
    sides = [(SYMBOLIC.acceleration(X, V, T) + printed).subs(V, s * sp.Symbol("v", positive=True)) for s in (1, -1)]
    return decide(_vanishes(*sides), "Identical, for both signs of v (sympy).")


@finds(FINDINGS, "eq-2")
def _potential():
    static = replace(SYMBOLIC, mu=sp.Integer(0))
    return decide(_vanishes(static.force(X, T) + sp.diff(static.potential(X), X)), "Proved (sympy).")


@finds(FINDINGS, "dry-friction")
def _dry_friction():
    osc, speeds = Duffing(alpha=1.0, p=paper.P_SMALL), np.array([1e-1, 1e-3, 1e-6])
    force = osc.damping(speeds)
    limit = Duffing(alpha=1.0, p=1e-4).damping(speeds)
    at = ", ".join(f"{f:.2f} α at |v| = {s:g}" for s, f in zip(speeds, force, strict=True))
    text = f"The limit is α sign(v), but p = 0.1 is far from it at small speed ({at}), and dpt(0) = 0: it creeps, never sticks."
    return decide(np.all(np.abs(limit - 1) < 2e-3) and osc.damping(0.0) == 0, text, limited=True)


@finds(FINDINGS, "saddle")
def _saddle():
    slope, curvature = (sp.diff(SYMBOLIC.potential(X), X, n).subs(X, 0) for n in (1, 2))
    return decide(slope == 0 and curvature.is_negative, "V′(0) = 0, V″(0) = δ < 0.")


@finds(FINDINGS, "eq-4-7")
def _energy_integral():
    x, tau, kappa = sp.symbols("x tau kappa", positive=True)
    free = Duffing(delta=-(kappa**2), gamma=GAMMA)
    way_out = sp.solve(free.energy(x, V), V)[1]
    x_max = sp.solve(way_out, x)[0]
    path = x_max * sp.sech(tau)
    constant = sp.simplify(sp.diff(path, tau) / way_out.subs(x, path))
    text = "Derived (sympy). Eq. 6 prints the outgoing branch, Eq. 7 has both signs."
    return decide(sp.simplify(constant + 1 / kappa) == 0, text)


@finds(FINDINGS, "eq-8")
def _homoclinic_orbit():
    x, v = homoclinic_orbit(SYMBOLIC, T)
    holds = _vanishes(sp.diff(x, T) - v, sp.diff(v, T) + DELTA * x + GAMMA * x**3, SYMBOLIC.energy(x, v))
    return decide(holds, "Solves the equation of motion at zero energy, for symbolic δ < 0 < γ (sympy).")


@finds(FINDINGS, "eq-8-sides")
def _sides():
    plus, minus = (homoclinic_orbit(Duffing(), 0.0, side)[0] for side in (1, -1))
    text = f"The other way round: '+' passes x = {plus:+.3f} and '−' passes x = {minus:+.3f}."
    return decide(plus < 0 < minus, text)


@finds(FINDINGS, "eq-8-limits")
def _limits():
    kappa = sp.Symbol("kappa", positive=True)
    orbit = homoclinic_orbit(Duffing(delta=-(kappa**2), gamma=GAMMA), T)
    limits = [sp.limit(f.rewrite(sp.exp), T, end) for f in orbit for end in (sp.oo, -sp.oo)]
    return decide(limits == [0] * 4, "All four limits of (x*, v*) are zero (sympy).")


@finds(FINDINGS, "eq-9")
def _distance(osc=paper.OSCILLATOR):
    phase = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    relative = []
    for alpha in (osc.alpha, osc.alpha / 10):
        osc = replace(osc, alpha=alpha, p=paper.P_LINEAR)
        osc = replace(osc, mu=2 * critical_amplitude(osc))
        gradient = -osc.force(homoclinic_orbit(osc, 0.0)[0], 0.0) + osc.mu
        melnikov = melnikov_function(osc, phase / osc.omega)
        relative.append(np.max(np.abs(splitting(osc, phase) * gradient - melnikov)) / np.max(np.abs(melnikov)))
    text = (
        "To first order, and after division by the gradient of $H^0$. Measured at p = 1, μ = 2$μ_c$, relative to the largest M: "
        f"{relative[0]:.1%} off at α = {10 * osc.alpha:g}, {relative[1]:.2%} at α = {osc.alpha:g}."
    )
    return decide(relative[0] < 0.2 and relative[1] < relative[0] / 5, text, limited=True)


@finds(FINDINGS, "eq-10-11")
def _forms():
    perturbation = MU * sp.cos(OMEGA * T) - SYMBOLIC.damping(V)
    gradient = (sp.diff(SYMBOLIC.energy(X, V), X), sp.diff(SYMBOLIC.energy(X, V), V))
    holds = gradient == (DELTA * X + GAMMA * X**3, V)
    wedge = gradient[0] * 0 - gradient[1] * perturbation
    holds = holds and sp.expand(wedge + V * perturbation) == 0
    return decide(
        holds,
        "h is d$H^0$; h ∧ g is minus the power v(μ cos ωt − dpt), a choice of orientation that moves no zero.",
    )


@finds(FINDINGS, "eq-12")
def _condition():
    osc, t0 = Duffing(p=paper.P_SMALL), np.linspace(0, 2 * np.pi, 4000, endpoint=False)
    counts = []
    for ratio in (0.999, 1.001):
        m = melnikov_function(replace(osc, mu=ratio * critical_amplitude(osc)), t0)
        counts.append(int(np.sum(np.sign(m) != np.sign(np.roll(m, 1)))))
    text = f"Simple zeros per period: {counts[0]} at 0.999 $μ_c$, {counts[1]} at 1.001 $μ_c$; at $μ_c$ itself one double zero. First order, and for a hyperbolic saddle orbit with smooth manifolds: for p < 1/2 the tangency itself is computed, see its chapter."
    return decide(counts == [0, 2], text, limited=True)


@finds(FINDINGS, "fig-2")
def _perturbed_manifolds(osc=paper.OSCILLATOR):
    phase = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    osc = replace(osc, p=paper.P_LINEAR)
    mu_t = homoclinic_tangency(osc)
    top = [float(np.max(splitting(replace(osc, mu=ratio * mu_t), phase))) for ratio in (0.9, 1.1)]
    text = (
        f"Computed, not sketched (p = 1): the largest distance x_u − x_s is {top[0]:+.4f} at 0.9 of the tangency's forcing and {top[1]:+.4f} at 1.1: "
        "they miss one another below and cross above. The paper's figure names no parameters."
    )
    return decide(top[0] < 0 < top[1], text)


@finds(FINDINGS, "eq-13")
def _critical_amplitude():
    printed = (
        ALPHA
        * 2 ** (P / 2)
        / (sp.pi * OMEGA)
        * (-DELTA) ** (P + sp.Rational(1, 2))
        / GAMMA ** (P / 2)
        * sp.beta((P + 2) / 2, (P + 1) / 2)
        * sp.cosh(sp.pi * OMEGA / (2 * sp.sqrt(-DELTA)))
    )
    proved = sp.simplify(sp.powsimp(critical_amplitude(SYMBOLIC) / printed, force=True)) == 1
    with mpmath.workdps(65):
        osc = Duffing(*map(mpmath.mpf, ("0.1", "0.1", "0.27", "1", "-1", "1")))
        error = abs(melnikov_quadrature(osc, mpmath.mpf(1)) / melnikov_function(osc, mpmath.mpf(1)) - 1)
        digits = int(-mpmath.log10(error))
    return decide(
        proved and digits >= 40,
        f"Derived for every p > −1 (sympy); quadrature of Eq. 9 agrees to {digits} digits. As a statement on the manifolds it is first "
        "order: the first tangency's place is proved at p = 1, 2 and 3 (chapter on the proof), computed elsewhere.",
    )


@finds(FINDINGS, "eq-14-15")
def _special_functions():
    r, s = sp.symbols("r s", positive=True)
    beta = sp.simplify(sp.beta(r, s).rewrite(sp.gamma) - sp.gamma(r) * sp.gamma(s) / sp.gamma(r + s))
    return decide(beta == 0 and sp.gammasimp(sp.gamma(r + 1) - r * sp.gamma(r)) == 0, "Textbook identities (sympy).")


@finds(FINDINGS, "sufficient")
def _sufficient(osc=paper.OSCILLATOR):
    p = np.array([paper.P_SMALL, 0.5, 1.0, 2.0])
    family = replace(osc, p=p, alpha=osc.alpha * np.array([[1.0], [0.1]]))
    ratio, weaker = homoclinic_tangency(family) / critical_amplitude(family)
    found = ", ".join(f"{r:.4f} at p = {q:g}" for r, q in zip(ratio, p, strict=True))
    text = (
        "To first order in α and μ: the true tangency lies at "
        f"μ/$μ_c$ = {found} (α = {osc.alpha:g}, ω = {osc.omega:g}); at a tenth of α the differences from 1 are {np.max(np.abs((weaker - 1) / (ratio - 1))):.2g} of these or less. The conclusions call it “necessary” of the transition to chaos, which is another statement."
    )
    return decide(np.all(np.abs(weaker - 1) < np.abs(ratio - 1) / 5), text)


@finds(FINDINGS, "monotone")
def _monotone():
    p, omega = np.linspace(0.01, 3, 300)[:, None], np.linspace(0.1, 4, 40)
    falling = bool(np.all(np.diff(critical_amplitude(Duffing(p=p, omega=omega)), axis=0) < 0))
    turned = bool(np.any(np.diff(damping_integral(Duffing(p=p[:, 0], delta=-8.0))) > 0))
    text = (
        "$μ_c$ falls with p at every ω, because |v*| ≤ 1/√2 < 1 on the loop (δ = −1, γ = 1). In a well with −δ > √(2γ) "
        f"the order turns round from some exponent on ({'seen' if turned else 'not seen'} at δ = −8)."
    )
    return decide(falling, text, limited=True)
