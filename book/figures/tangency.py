"""Splittings, tangencies and their correction: arrays in, a figure out."""

from itertools import cycle

import numpy as np

from .style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, line_of, panel, styled


@styled
def collapse(phase, curves, theory):
    """Scaled splitting against the phase for several alpha (dict alpha -> array) and Melnikov's function."""
    fig, axes = panel(
        r"phase $\omega t_0$ of the crossing (radian)", r"splitting $\times\,\partial H^0/\partial x\,/\,\alpha$"
    )
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.plot(phase, theory, color=BLACK, linewidth=2.4, label=r"$\mathrm{M}(t_0)/\alpha$")
    looks = zip(
        cycle((ORANGE, GREEN, BLUE, VERMILION)), cycle((":", "-.", "--", (0, (4, 2)), (0, (1, 3)))), strict=False
    )  # 20 in all
    for (alpha, curve), (colour, dash) in zip(curves.items(), looks, strict=False):
        axes.plot(phase, curve, color=colour, linestyle=dash, label=rf"$\alpha = {alpha:g}$")
    axes.set_xlim(phase[0], phase[-1])
    axes.legend()
    return fig


@styled
def tangency_correction(alpha, p, correction):
    """|mu_t / mu_c - 1| against alpha on logarithmic axes: correction (len(p), len(alpha))."""
    fig, axes = panel(r"damping coefficient $\alpha$ (dimensionless)", r"$|\mu_t/\mu_c - 1|$", figsize=(6.8, 4.4))
    for power, anchor in ((1, 0.06), (2, 0.25)):
        axes.loglog(alpha, anchor * alpha**power, color=GREY, linewidth=0.8)
    for exponent, row in zip(p, correction, strict=True):
        look = line_of(exponent)
        axes.loglog(alpha, np.abs(row), **look)
        for above, fill in ((row > 0, "full"), (row <= 0, "none")):
            axes.loglog(alpha[above], np.abs(row[above]), "o", color=look["color"], fillstyle=fill)
    axes.legend(ncols=2)
    return fig


@styled
def tangency_against_frequency(omega, p, ratio, omega_tangency, tangency):
    """Fig. 3a for some exponents with computed tangencies as crosses: tangency (len(p), len(omega_tangency))."""
    fig, axes = panel(r"forcing frequency $\omega$ (dimensionless)", r"$\mu/\alpha$ (dimensionless)")
    for exponent, curve, crosses in zip(p, ratio, tangency, strict=True):
        look = line_of(exponent)
        axes.plot(omega, curve, **(look | {"label": rf"$\mu_c/\alpha$, {look['label']}"}))
        axes.plot(
            omega_tangency, crosses, "x", color=look["color"], markeredgewidth=1.6, label=f"tangency, {look['label']}"
        )
    axes.set(xlim=(omega[0], omega[-1]), ylim=(0, None))
    axes.legend()
    return fig


@styled
def frontier(p, alpha, ratio, marked):
    """Contours of the sticking amplitude over mu_c in the plane of p and alpha: ratio (len(alpha), len(p))."""
    fig, axes = panel("damping exponent $p$", r"damping coefficient $\alpha$ (dimensionless)", figsize=(6.8, 4.2))
    levels = np.linspace(0, 1, 11)
    filled = axes.contourf(p, alpha, ratio, levels=levels, cmap="cividis", extend="max")
    lines = axes.contour(p, alpha, ratio, levels=levels[1:-1:2], colors="white", linewidths=0.8)
    axes.clabel(lines, fontsize=9)
    axes.plot(*marked, "o", color="white", markeredgecolor=BLACK, markersize=9)
    axes.set_yscale("log")
    axes.grid(False)
    fig.colorbar(filled, label=r"sticking amplitude$\,/\,\mu_c$")
    return fig
