"""The figures of the chapter on the plane: arrays in, a matplotlib Figure out. Nothing is computed here."""

import numpy as np

from .style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, PageFigure, line_of, styled

FORCING = r"forcing amplitude $\mu$ (dimensionless)"
NAMES = {
    "alpha": r"damping coefficient $\alpha$ (dimensionless)",
    "omega": r"forcing frequency $\omega$ (dimensionless)",
}
LOOKS = {
    "fold": (BLUE, "--", "fold: the small orbits end"),
    "inside": (GREEN, "-.", "doublings in a well accumulate"),
    "crisis": (VERMILION, "-", "crisis: chaos reaches the large orbit's basin"),
    "critical": (BLACK, ":", r"critical amplitude $\mu_c$"),
}


@styled
def regions(panels, adopted):
    """The share of initial conditions in lasting chaos over planes of a parameter and mu, with the borders.

    panels : list of (title, field, grid, across, values, borders): grid (values (n,), mu (m,)) of the shares across
        (m, n); values (k,) of the lines, borders dict name -> mu (k,), names of LOOKS
    adopted : dict field -> value, a thin line
    """
    fig = PageFigure(figsize=(6.8, 6.8))
    rows = -(-len(panels) // 2)
    every = np.atleast_2d(fig.subplots(rows, 2, sharey=True, squeeze=False))
    for axes, (title, field, (x, mu), across, values, borders) in zip(every.flat, panels, strict=True):
        image = axes.pcolormesh(x, mu, across, vmin=0, vmax=1, cmap="Greys", shading="nearest", rasterized=True)
        for name, curve in borders.items():
            colour, dash, label = LOOKS[name]
            axes.plot(values, curve, color=colour, linestyle=dash, linewidth=1.6, label=label)
        axes.axvline(adopted[field], color=ORANGE, linewidth=0.9)
        axes.set(title=title, xlabel=NAMES[field], xlim=(min(x), max(x)), ylim=(min(mu), max(mu)))
        axes.xaxis.label.set_size(9.5)
        axes.grid(False)
    for axes in every[:, 0]:
        axes.set_ylabel(FORCING)
    fig.colorbar(image, ax=every.ravel().tolist(), shrink=0.5, label="fraction of initial conditions in lasting chaos")
    fig.legend(*every.flat[0].get_legend_handles_labels(), loc="outside upper center", ncols=2, fontsize=9)
    return fig


@styled
def apexes(over_alpha, over_p, pairs):
    """The frequency at which fold and crisis change places: against alpha for several p, and against p.

    over_alpha : dict p -> (alpha, omega); over_p : (p, omega); pairs : tuple of (alpha, omega), drawn as dots
    """
    fig = PageFigure(figsize=(6.8, 3.6))
    left, right = fig.subplots(1, 2)
    for (p, (alpha, omega)), marker in zip(over_alpha.items(), "os", strict=False):
        left.plot(alpha, omega, marker=marker, markersize=3.5, **line_of(p))
    first, *others = pairs
    left.plot(*np.transpose(others), "D", color=GREY, markersize=4.5, linestyle="none", label="other pairs")
    left.plot(*first, "*", color=ORANGE, markersize=11, markeredgecolor=BLACK, linestyle="none", label="adopted pair")
    left.set(xlabel=NAMES["alpha"], ylabel=NAMES["omega"])
    left.legend(fontsize=8.5)
    right.plot(*over_p, "o-", color=BLACK, markersize=3.5)
    right.axhline(first[1], color=ORANGE, linewidth=0.9)
    right.set(xlabel="damping exponent $p$", ylabel=r"$\omega$ at the apex, $\alpha = 0.1$")
    for axes in (left, right):
        axes.xaxis.label.set_size(9.5)
        axes.yaxis.label.set_size(9.5)
    return fig


@styled
def pairs(found):
    """Shares of initial conditions in chaos against mu, a panel for each pair of alpha and omega.

    found : dict (alpha, omega) -> dict p -> (mu, across, inside, critical): shares between the wells and inside one
    """
    fig = PageFigure(figsize=(6.8, 1.2 * len(found) + 0.9))
    panels = fig.subplots(len(found), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, ((alpha, omega), parts) in zip(panels, found.items(), strict=True):
        for row, (p, (mu, across, inside, critical)) in enumerate(reversed(parts.items())):
            colour, base = line_of(p)["color"], 1.4 * row
            axes.fill_between(mu, base, base + across, step="mid", color=colour, linewidth=0, label=f"$p = {p:g}$")
            seen = inside > 0
            axes.plot(mu[seen], base + inside[seen], "^", color=colour, markersize=5, fillstyle="none")
            axes.plot([critical, critical], [base, base + 1], color=colour, linestyle=":", linewidth=1.8)
        axes.set_title(rf"$\alpha = {alpha:g}$, $\omega = {omega:g}$", fontsize=9.5, pad=3)
        axes.set(ylim=(-0.06, 2.5), yticks=(0, 1, 1.4, 2.4), yticklabels=("0", "1", "0", "1"))
        axes.tick_params(axis="y", labelsize=8)
        axes.set_axisbelow(True)
    panels[-1].set_xlabel(FORCING)
    fig.supylabel("fraction of initial conditions", fontsize=9.5)
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return fig
