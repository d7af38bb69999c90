"""Exponents at small p: resolved in time, over many initial conditions, towards dry friction; nothing is computed."""

from itertools import cycle

import numpy as np

from .style import BLACK, GREEN, GREY, P_COLOUR, PURPLE, panel, styled


@styled
def resolved_exponents(mu, coarse, mu_exact, exact, threshold, ylim=None):
    """lambda_1 against mu: the paper's step (thin) and friction time (thick); ylim None shows all of both."""
    fig, axes = panel(r"forcing amplitude $\mu$ (dimensionless)", r"$\lambda_1$ (per unit time)", figsize=(6.8, 4.2))
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.axhline(threshold, color=GREY, linestyle="--", linewidth=1.0)
    axes.plot(mu, coarse, color=GREY, linewidth=0.8, label="the paper's algorithm")
    axes.plot(mu_exact, exact, color=P_COLOUR[0.1], linewidth=1.6, label="friction time")
    axes.set(xlim=(mu_exact[0], mu_exact[-1]), ylim=ylim)
    axes.legend(loc="lower right")
    return fig


@styled
def many_starts(mu, exponents, mu_paper, paper_exponents):
    """lambda_1 of many starts at each mu as dots: exponents (starts, len(mu)); the paper's start and step as a line."""
    fig, axes = panel(r"forcing amplitude $\mu$ (dimensionless)", r"$\lambda_1$ (per unit time)", figsize=(6.8, 4.2))
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.plot(mu_paper, paper_exponents, color=GREY, linewidth=1.2, label="the paper's initial condition and algorithm")
    dots = np.broadcast_to(mu, exponents.shape)
    axes.plot(
        dots.ravel(),
        exponents.ravel(),
        ".",
        color=P_COLOUR[0.1],
        alpha=0.45,
        markersize=5,
        label="friction time, each initial condition",
    )
    axes.set_xlim(mu[0], mu[-1])
    fig.legend(loc="outside upper right", ncols=2)
    return fig


@styled
def dry_limit(p, exponents, mu):
    """lambda_1 against p (logarithmic) for several forcings: exponents (len(p), len(mu))."""
    fig, axes = panel("damping exponent $p$", r"$\lambda_1$ (per unit time)")
    axes.axhline(0, color=GREY, linewidth=0.8)
    looks = zip(cycle((BLACK, GREY, GREEN, PURPLE)), cycle(("o", "s", "D", "^", "v")), strict=False)  # 20 in all
    for value, column, (colour, marker) in zip(mu, exponents.T, looks, strict=False):
        joined = "-" if np.ptp(np.sign(column)) == 0 else "none"  # no line from regular to chaotic motion
        axes.semilogx(p, column, linestyle=joined, marker=marker, color=colour, label=rf"$\mu = {value:g}$")
    axes.set_xticks(p, [f"{value:g}" for value in p])
    axes.minorticks_off()
    axes.legend()
    return fig
