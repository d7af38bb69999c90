"""Figures of branches of periodic orbits and their bifurcations: arrays in, a Figure out.

A branch comes as (name, parameter (n,), value (n,) or (k, n), stable (n,) bool), a mark as (kind, parameter, value).
"""

import numpy as np

from .style import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, PageFigure, line_of, panel, styled

ORBIT_COLOUR = {"in a well": BLUE, "round both wells": VERMILION, "saddle orbit": GREY, "period 3": GREEN}
# The letters of the cast, for the legends.
LETTERS = {"in a well": "S, R", "round both wells": "L, D", "saddle orbit": "H", "period 3": "P3"}
LOCUS_LOOK = {
    "in a well, fold": (BLUE, "-"),
    "in a well, flip": (SKY, "--"),
    "round both wells, fold": (VERMILION, "-"),
    "period 3, fold": (GREEN, "-"),
    "period 3, flip": (GREEN, "--"),
}
MARKER = {"fold": "o", "flip": "^"}
MU, OMEGA = r"forcing amplitude $\mu$ (dimensionless)", r"forcing frequency $\omega$ (dimensionless)"


def draw_branch(axes, parameter, value, stable, **look):
    """One branch: stable parts thick, unstable parts thin and dashed."""
    # Unstable pieces reach to their stable neighbours, so that no gap is left between the two.
    weak = ~stable | np.append(~stable[1:], False) | np.append(False, ~stable[:-1])
    for held, style in ((stable, {"linewidth": 2.0}), (weak, {"linewidth": 0.9, "linestyle": (0, (4, 2))})):
        for row in np.atleast_2d(value):
            axes.plot(np.where(held, parameter, np.nan), np.where(held, row, np.nan), **(look | style))


def draw_marks(axes, marks):
    """Folds as open circles, flips as open triangles."""
    for kind, parameter, value in marks:
        look = {"color": BLACK, "fillstyle": "none", "markersize": 4, "zorder": 5}
        axes.plot(parameter, value, MARKER[kind], linestyle="none", label=kind, **look)


def colour_of(name):
    """The colour of the orbit, also for the doubled and the asymmetric ones that leave it."""
    if name.endswith(("doubled", "asymmetric")):
        return PURPLE if name.startswith("in a well") else ORANGE
    return ORBIT_COLOUR[name]


def label_of(name):
    """The name of a branch or of its bifurcation with the letters of the cast in front."""
    return f"{LETTERS[name.partition(', ')[0]]}: {name}"


@styled
def branch_panels(cases, last):
    """Amplitude against mu, a panel for each p: dict p -> (branches, marks, mu_c)."""
    fig = PageFigure(figsize=(7.2, 6.4))
    panels = fig.subplots(2, -(-len(cases) // 2), sharex=True, sharey=True)
    for axes, (p, (branches, marks, mu_c)) in zip(panels.flat, cases.items(), strict=False):
        axes.axvline(mu_c, color=BLACK, linestyle=":", linewidth=1.0, label=r"$\mu_c$, Eq. 13")
        for name, mu, value, stable in branches:
            draw_branch(axes, mu, value, stable, color=colour_of(name), label=label_of(name))
        draw_marks(axes, marks)
        axes.set_title(f"$p = {p:g}$", fontsize=10)
        axes.set(xlim=(0, last), ylim=(0, None))
    legend_above(fig, panels.flat[0])
    fig.supxlabel(MU, fontsize=11)
    fig.supylabel("half the range of $x$ (dimensionless)", fontsize=11)
    return fig


@styled
def overlay(cases):
    """Stroboscopic x against mu, a panel for each p: dict p -> (brute, branches), brute a dict name -> (mu, x) (n,)."""
    columns = 1 if len(cases) <= 2 else 2
    rows = -(-len(cases) // columns)
    fig = PageFigure(figsize=(7.2, (3.6 if columns == 1 else 3.2) * rows))
    panels = fig.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    labels = {"many starts": "eight initial conditions"}
    looks = {"many starts": (GREY, "o", 1.8), "forward sweep": (BLACK, ">", 3.5), "backward sweep": (BLACK, "<", 3.5)}
    for axes, (p, (brute, branches)) in zip(panels, cases.items(), strict=True):
        for name, mu, value, stable in branches:
            draw_branch(axes, mu, value, stable, color=colour_of(name), label=label_of(name))
        for name, (mu, x) in brute.items():
            colour, marker, size = looks[name]
            look = {"marker": marker, "color": colour, "markersize": size, "markeredgewidth": 0, "zorder": 3}
            axes.plot(mu, x, linestyle="none", label=labels.get(name, name), rasterized=True, **look)
        axes.set(ylim=(-1.7, 1.7))
        axes.set_title(f"$p = {p:g}$", fontsize=10)
    for axes in panels[::columns]:
        axes.set_ylabel("$x$ at phase 0 (dimensionless)")
    low, high = (f([f(mu) for mu, _ in brute.values()]) for f in (np.min, np.max))
    for axes in panels[-columns:]:
        axes.set(xlabel=MU, xlim=(low, high))
    legend_above(fig, panels[0], markerscale=2)
    return fig


@styled
def loci(curves, p, mu_c, p_touch, tangency, mu_last=0.3):
    """Bifurcations in the (p, mu) plane: curves (name, p, mu, ...), Eq. 13 as a black line, tangencies as crosses."""
    fig = PageFigure(figsize=(6.8, 4.8))
    axes = fig.subplots()
    for name, where, mu, *_ in curves:
        colour, dash = LOCUS_LOOK[name]
        axes.plot(where, mu, color=colour, linestyle=dash, label=label_of(name))
    axes.plot(p, mu_c, color=BLACK, linewidth=1.6, label=r"$\mu_c$, Eq. 13")
    axes.plot(p_touch, tangency, "x", color=BLACK, markeredgewidth=1.6, label="homoclinic tangency")
    axes.set(xlabel="damping exponent $p$", ylabel=MU, xlim=(0, p[-1]), ylim=(0, mu_last))
    legend_above(fig, axes)
    return fig


def legend_above(fig, axes, **look):
    """Above the panels, each label once, by the first thing drawn under it: of a branch, the thick line."""
    labels = {}
    for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
        labels.setdefault(label, handle)
    fig.legend(labels.values(), labels.keys(), loc="outside upper center", ncols=3, **look)


@styled
def in_well_chaos(curves):
    """lambda_1 of the motion in a well above the accumulation of its doublings: dict p -> (distance, exponent), the
    distance in mu from the accumulation; nan once the motion is captured."""
    name = r"distance $\mu - \mu_A$ from the accumulation, in $10^{-4}$"
    fig, axes = panel(name, r"$\lambda_1$ (per unit time)", figsize=(6.4, 3.6))
    axes.axhline(0, color=GREY, linewidth=0.8)
    for (p, (distance, exponent)), marker in zip(curves.items(), ("o", "s", "^", "D", "v"), strict=False):
        look = line_of(p) | {"linestyle": "-", "linewidth": 0.8}
        axes.plot(1e4 * distance, exponent, marker=marker, markersize=3, **look)
    axes.legend()
    return fig


@styled
def accumulations(over_p, over_alpha, over_omega):
    """The accumulation of the doublings in a well as a multiple of mu_c: against p, alpha and omega.

    over_p : (p, ratio); over_alpha, over_omega : dict p -> (values, ratio)
    """
    fig = PageFigure(figsize=(6.8, 3.3))
    panels = fig.subplots(1, 3, sharey=True)
    panels[0].plot(*over_p, "o-", color=BLACK, markersize=3.5)
    for axes, curves in zip(panels[1:], (over_alpha, over_omega), strict=True):
        for (p, (value, ratio)), marker in zip(curves.items(), "os", strict=False):
            axes.plot(value, ratio, marker=marker, markersize=3.5, **line_of(p))
    names = (r"$p$ ($\alpha = 0.1$, $\omega = 1$)", r"$\alpha$ ($\omega = 1$)", r"$\omega$ ($\alpha = 0.1$)")
    for axes, name in zip(panels, names, strict=True):
        axes.axhline(1, color=GREY, linewidth=0.9)
        axes.set_xlabel(name)
    panels[0].set_ylabel(r"$\mu_A / \mu_c$")
    panels[1].legend()
    return fig
