"""The book's own figures, beyond the paper's: arrays in, a matplotlib Figure out. Nothing is computed here."""

from itertools import cycle

import numpy as np

from ..figures import BLACK, BLUE, GREEN, GREY, ORANGE, P_COLOUR, PURPLE, VERMILION, fig3b, line_of, panel
from ..page_figure import PageFigure, styled

METHODS = {  # the integrators' colours, markers and dashes in the work-precision figure
    "Runge-Kutta 4, fixed step": (BLACK, "o", ":"),
    "SciPy DOP853": (BLUE, "s", "--"),
    "SciPy LSODA": (GREEN, "^", "-."),
    "SciPy Radau": (PURPLE, "v", (0, (5, 1, 1, 1))),
    "friction time": (VERMILION, "D", "-"),
}


@styled
def scan_map(alpha, omega, criteria, chosen):
    """Which (alpha, omega) agree with the text, one small map for each criterion: dict of boolean arrays (a, w)."""
    fig = PageFigure(figsize=(6.8, 5.2))
    panels = fig.subplots(2, -(-len(criteria) // 2), sharex=True, sharey=True)
    for axes, (name, agrees) in zip(panels.flat, criteria.items(), strict=False):
        i, j = np.nonzero(agrees)
        axes.plot(omega[j], alpha[i], "s", color=BLUE, markersize=4)
        axes.plot(*chosen[::-1], "o", color=VERMILION, fillstyle="none", markersize=12, markeredgewidth=1.8)
        axes.set_title(f"{name}\n{agrees.sum()} of {agrees.size}", fontsize=9.5)
        axes.set(xlim=(omega[0] - 0.05, omega[-1] + 0.05), ylim=(alpha[0] - 0.02, alpha[-1] + 0.02))
    for axes in panels.flat[len(criteria) :]:
        axes.set_axis_off()
    fig.supxlabel(r"forcing frequency $\omega$ (dimensionless)", fontsize=11)
    fig.supylabel(r"damping coefficient $\alpha$ (dimensionless)", fontsize=11)
    return fig


@styled
def headline(p, mu_c, p_tangency, tangency, p_onset, onset):
    """Fig. 3b with the computed homoclinic tangencies on the line."""
    fig = fig3b(p, mu_c, p_onset, onset)
    axes = fig.axes[0]
    axes.plot(
        p_tangency, tangency, "x", color=BLUE, markersize=7, markeredgewidth=2, label="homoclinic tangency, computed"
    )
    axes.legend()
    return fig


@styled
def work_precision(tables):
    """Error against force evaluations, one panel for each p: dict p -> dict method -> (evaluations, error)."""
    fig = PageFigure(figsize=(6.8, 3.9))
    panels = fig.subplots(1, len(tables), sharey=True, squeeze=False)[0]
    for axes, (p, table) in zip(panels, tables.items(), strict=True):
        for method, (evaluations, error) in table.items():
            colour, marker, dash = METHODS[method]
            axes.loglog(evaluations, error, color=colour, marker=marker, linestyle=dash, markersize=4, label=method)
        axes.set(title=f"$p = {p:g}$", xlabel="force evaluations")
    panels[0].set_ylabel("error of $(x, v)$ (dimensionless)")
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return fig


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
    axes.plot(mu_paper, paper_exponents, color=GREY, linewidth=1.2, label="the paper's start and algorithm")
    dots = np.broadcast_to(mu, exponents.shape)
    axes.plot(
        dots.ravel(),
        exponents.ravel(),
        ".",
        color=P_COLOUR[0.1],
        alpha=0.45,
        markersize=5,
        label="friction time, each start",
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
        axes.semilogx(p, column, marker=marker, color=colour, label=rf"$\mu = {value:g}$")
    axes.set_xticks(p, [f"{value:g}" for value in p])
    axes.minorticks_off()
    axes.legend()
    return fig


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
