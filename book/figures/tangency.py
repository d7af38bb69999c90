"""Splittings, tangencies and their correction: arrays in, a figure out."""

from itertools import cycle

import numpy as np
from matplotlib.ticker import FixedLocator, NullLocator

from .paper import draw_manifolds
from .style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, PageFigure, line_of, panel, styled

SHOWN = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4)  # ticks of a logarithmic axis of less than two decades


@styled
def collapse(phase, curves, theory):
    """Scaled splitting against the phase for several alpha (dict alpha -> array), and its difference from theory."""
    fig = PageFigure(figsize=(7.6, 3.8))
    whole, rest = fig.subplots(1, 2)
    whole.plot(phase, theory, color=BLACK, linewidth=2.4, label=r"$\mathrm{M}(t_0)/\alpha$")
    looks = zip(
        cycle((ORANGE, GREEN, BLUE, VERMILION)), cycle((":", "-.", "--", (0, (4, 2)), (0, (1, 3)))), strict=False
    )  # 20 in all
    for (alpha, curve), (colour, dash) in zip(curves.items(), looks, strict=False):
        whole.plot(phase, curve, color=colour, linestyle=dash, label=rf"$\alpha = {alpha:g}$")
        rest.plot(phase, curve - theory, color=colour, linestyle=dash)
    whole.set_ylabel(r"splitting $\times\,\partial H^0/\partial x\,/\,\alpha$")
    rest.set_ylabel(r"the same minus $\mathrm{M}(t_0)/\alpha$")
    for axes in (whole, rest):
        axes.axhline(0, color=GREY, linewidth=0.8)
        axes.set(xlabel=r"phase $\omega t_0$ of the crossing (radian)", xlim=(phase[0], phase[-1]))
    fig.legend(loc="outside upper center", ncols=len(curves) + 1)
    return fig


@styled
def lobes(loop, cases, touch):
    """Manifolds of the right loop below, at and above tangency, (title, [W^S], [W^U]) each, and the touch enlarged.

    touch : limits of x and of v about the contact, ((2,), (2,))
    """
    fig = PageFigure(figsize=(6.8, 6.4))
    panels = fig.subplots(2, 2).ravel()
    enlarged = (f"{cases[1][0]}, enlarged", *cases[1][1:])
    for axes, (title, stable, unstable) in zip(panels, [*cases, enlarged], strict=True):
        draw_manifolds(axes, [] if axes is panels[3] else [loop], stable, unstable)  # it would hide the contact
        axes.set_title(title, fontsize=10)
        axes.set(xlim=(-0.25, 1.6), ylim=(-0.95, 0.95), xlabel="displacement $x$", ylabel="velocity $v$")
    (left, right), (low, high) = touch
    panels[1].plot((left, right, right, left, left), (low, low, high, high, low), color=BLACK, linewidth=0.8)
    panels[3].set(xlim=touch[0], ylim=touch[1])
    handles, labels = panels[0].get_legend_handles_labels()
    fig.legend(handles, labels, loc="outside upper center", ncols=3)
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
    axes.yaxis.set_major_locator(FixedLocator([each for each in SHOWN if alpha[0] <= each <= alpha[-1]]))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_locator(NullLocator())
    axes.grid(False)
    fig.colorbar(filled, label=r"sticking amplitude$\,/\,\mu_c$")
    return fig


@styled
def parting(t, x, x_s, phase, splittings):
    """Two orbits that turn just below and just above x_s, x (len(t), 2), and the splitting (dict fraction -> array)."""
    fig = PageFigure(figsize=(7.6, 3.6))
    left, right = fig.subplots(1, 2)
    left.axhline(0, color=GREY, linewidth=0.8)
    for path, colour, dash, label in zip(
        x.T, (BLUE, VERMILION), ("-", "--"), ("turns below $x_s$", "turns above $x_s$"), strict=True
    ):
        left.plot(t, path, color=colour, linestyle=dash, label=label)
    left.plot(0, x_s, "o", color=BLACK, markersize=5)
    left.set(xlabel="time since the turn (dimensionless)", ylabel="displacement $x$", xlim=(0, t[-1]))
    left.legend(loc="lower left")
    right.axhline(0, color=GREY, linewidth=0.8)
    for (fraction, curve), colour, dash in zip(
        splittings.items(), (BLUE, BLACK, VERMILION), ("-.", "-", "--"), strict=True
    ):
        right.plot(phase, curve, color=colour, linestyle=dash, label=rf"$\mu = {fraction:g}\,\mu_t$")
    right.set(xlabel=r"phase of the crossing (radian)", ylabel="splitting $x_u - x_s$", xlim=(phase[0], phase[-1]))
    right.legend()
    return fig


@styled
def ratio_against_exponent(p, ratios, dry):
    """mu_t / mu_c against p for several alpha (dict alpha -> (len(p),)), and that of dry friction at p = 0 (dict)."""
    fig, axes = panel("damping exponent $p$", r"$\mu_t/\mu_c$", figsize=(6.8, 4.2))
    axes.axhline(1, color=GREY, linewidth=0.8)
    for (alpha, curve), colour, mark in zip(ratios.items(), (BLUE, ORANGE, GREEN), "xo^", strict=False):
        axes.plot(p, curve, mark + "-", color=colour, fillstyle="none", label=rf"$\alpha = {alpha:g}$")
        axes.plot(0, dry[alpha], "s", color=colour, clip_on=False, zorder=3)
    axes.plot([], [], "s", color=BLACK, label="dry friction, $p = 0$")
    axes.set_xlim(0, p[-1] + 0.05)
    axes.legend()
    return fig


@styled
def scaled_correction(alpha, corrections):
    """(1 - mu_t / mu_c) / alpha^(1+p) against alpha for small p: dict p -> (len(alpha),)."""
    fig, axes = panel(r"damping coefficient $\alpha$ (dimensionless)", r"$(1 - \mu_t/\mu_c)\,/\,\alpha^{1+p}$")
    looks = zip((BLACK, BLUE, ORANGE), "so^", strict=True)
    for (p, curve), (colour, mark) in zip(corrections.items(), looks, strict=False):
        axes.semilogx(
            alpha, -curve / alpha ** (1 + p), mark + "-", color=colour, fillstyle="none", label=f"$p = {p:g}$"
        )
    axes.set_ylim(0, None)
    axes.legend()
    return fig
