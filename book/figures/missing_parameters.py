"""Which (alpha, omega) the text leaves, and the paper's Figs. 3b to 6 for the likeliest: arrays in, a figure out."""

import numpy as np
from matplotlib.ticker import MaxNLocator

from .style import BLACK, BLUE, GREY, STEADY, TRANSIENT, VERMILION, PageFigure, line_of, styled

OMEGA, ALPHA = r"forcing frequency $\omega$ (dimensionless)", r"damping coefficient $\alpha$ (dimensionless)"
LEAST = -6.0  # decades of likelihood below the best that are told apart


@styled
def likelihood_maps(alpha, omega, exponent, panels, likely):
    """The plane of candidates. exponent (a, w): lambda_1 at mu = 0.27; panels: dict title -> log10 of the likelihood
    (a, w), relative to the best, nan where there is none; likely: dict letter -> (alpha, omega), ringed."""
    fig = PageFigure(figsize=(6.8, 2.5 + 2.3 * len(panels)))
    axes = fig.subplots(1 + len(panels), 1, sharex=True, sharey=True)
    half = [(axis[-1] - axis[0]) / (axis.size - 1) / 2 for axis in (omega, alpha)]
    extent = (omega[0] - half[0], omega[-1] + half[0], alpha[0] - half[1], alpha[-1] + half[1])
    shown = {"origin": "lower", "extent": extent, "aspect": "auto", "interpolation": "nearest"}
    image = axes[0].imshow(exponent, cmap="PuOr_r", vmin=-0.2, vmax=0.2, **shown)
    axes[0].set_title(r"larger $\lambda_1$ of two runs at $\mu = 0.27$, $p = 0.1$", fontsize=10)
    fig.colorbar(image, ax=axes[0], extend="both", label=r"$\lambda_1$ (nats per unit time)")
    for panel, (title, logs) in zip(axes[1:], panels.items(), strict=True):
        image = panel.imshow(np.maximum(logs, LEAST), cmap="viridis_r", vmin=LEAST, vmax=0, **shown)
        panel.set_title(title, fontsize=10)
        fig.colorbar(image, ax=panel, extend="min", label=r"$\log_{10}$ of likelihood")
    for panel in axes:
        panel.grid(False)
        for letter, (a, w) in likely.items():
            panel.plot(w, a, "o", color=VERMILION, fillstyle="none", markersize=11, markeredgewidth=1.6)
            panel.annotate(letter, (w, a), (8, 7), textcoords="offset points", color=BLACK, fontsize=12)
    fig.supxlabel(OMEGA, fontsize=11)
    fig.supylabel(ALPHA, fontsize=11)
    return fig


@styled
def ensembles(pairs, chaotic, regular, printed):
    """lambda_1 of nearby starts for each pair: pairs (labels); chaotic and regular (n, pairs), at 0.27 and 0.25, in
    nats; printed: dict unit -> (value at 0.27, value at 0.25), in nats."""
    fig = PageFigure(figsize=(6.8, 1.6 + 0.55 * len(pairs)))
    panels = fig.subplots(1, 2, sharey=True)
    titles = (r"$\mu = 0.25$", r"$\mu = 0.27$")
    for axes, values, title, column in zip(panels, (regular, chaotic), titles, (1, 0), strict=True):
        spread = 0.6 * (np.arange(len(values)) / max(len(values) - 1, 1) - 0.5)
        for row in range(len(pairs)):
            axes.plot(values[:, row], row + spread, ".", color=BLUE, markersize=3, alpha=0.7)
        for (unit, numbers), dash in zip(printed.items(), ("-", "--"), strict=True):
            axes.axvline(numbers[column], color=VERMILION, linestyle=dash, label=f"printed, in {unit}")
        axes.set_title(title, fontsize=10)
        axes.set_xlabel(r"$\lambda_1$ (nats per unit time)")
    panels[0].set_yticks(range(len(pairs)), pairs)
    panels[0].set_ylim(len(pairs) - 0.5, -0.5)
    handles, labels = panels[0].get_legend_handles_labels()
    fig.legend(handles, labels, loc="outside upper center", ncols=2)
    return fig


def _columns(pairs, rows, height):
    fig = PageFigure(figsize=(2.5 * len(pairs), height * rows + 0.8))
    axes = fig.subplots(rows, len(pairs), squeeze=False, sharex="row", sharey="row")
    for top, name in zip(axes[0], pairs, strict=True):
        top.set_title(name, fontsize=10)
    for panel in axes.flat:
        panel.xaxis.set_major_locator(MaxNLocator(4, steps=(1, 2, 5, 10), prune="both"))
    return fig, axes


@styled
def onsets_beside(pairs, p, lines, p_onset, onsets):
    """Fig. 3b for each pair: lines (pairs, len(p)), mu_c; onsets: dict unit -> (pairs, len(p_onset))."""
    fig, (row,) = _columns(pairs, 1, 3.0)
    marks = zip(onsets, (("o", VERMILION), ("x", BLUE)), strict=True)
    looks = {unit: look for unit, look in marks}
    for k, axes in enumerate(row):
        axes.plot(p, lines[k], color=BLACK, label=r"$\mu_c$, Eq. 13")
        for unit, (mark, colour) in looks.items():
            axes.plot(
                p_onset,
                onsets[unit][k],
                mark,
                color=colour,
                fillstyle="none",
                label=rf"onset of $\lambda_1 > 0.1$ {unit}",
            )
        axes.set(xlabel="damping exponent $p$", xlim=(0, 1.05 * p[-1]), ylim=(0, None))
    row[0].set_ylabel(r"forcing amplitude $\mu$ (dimensionless)")
    fig.legend(*row[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return fig


@styled
def exponents_beside(pairs, mu, exponents, thresholds):
    """Fig. 4a and b for each pair: exponents: dict p -> (pairs, len(mu)), in nats; thresholds: dict unit -> nats."""
    fig, axes = _columns(pairs, len(exponents), 2.3)
    for row, (p, curves) in zip(axes, exponents.items(), strict=True):
        for panel, curve in zip(row, curves, strict=True):
            panel.axhline(0, color=GREY, linewidth=0.8)
            for (unit, level), dash in zip(thresholds.items(), ("--", ":"), strict=True):
                panel.axhline(level, color=GREY, linestyle=dash, linewidth=1.0, label=f"threshold, 0.1 {unit}")
            panel.plot(mu, curve, color=line_of(p)["color"], linewidth=1.0, label=f"$p = {p:g}$")
            panel.set(xlim=(mu[0], mu[-1]), ylim=(-0.25, 0.3))
        row[0].set_ylabel(r"$\lambda_1$ (nats per unit time)")
    for panel in axes[-1]:
        panel.set_xlabel(r"forcing amplitude $\mu$")
    named = {label: line for row in axes for line, label in zip(*row[0].get_legend_handles_labels(), strict=True)}
    fig.legend(named.values(), named.keys(), loc="outside upper center", ncols=2)
    return fig


@styled
def portraits_beside(pairs, motions):
    """Fig. 5a and b for each pair: motions: dict title -> for each pair (early, late), each (path, points) or None."""
    fig, axes = _columns(pairs, len(motions), 2.6)
    for row, (title, each) in zip(axes, motions.items(), strict=True):
        for panel, parts in zip(row, each, strict=True):
            for part, colour, dot in zip(parts, (TRANSIENT, STEADY), (BLUE, BLACK), strict=True):
                if part is not None:
                    (path, points) = part
                    panel.plot(*path, color=colour, linewidth=0.5)
                    panel.plot(*points, "o", color=dot, markersize=2.2)
        row[0].set_ylabel(f"{title}\nvelocity $v$")
    for panel in axes[-1]:
        panel.set_xlabel("displacement $x$")
    return fig


@styled
def histories_beside(pairs, histories, settled):
    """Fig. 6a and b for each pair: histories: dict title -> for each pair (omega t, x)."""
    fig, axes = _columns(pairs, len(histories), 1.7)
    for row, (title, each) in zip(axes, histories.items(), strict=True):
        for panel, (t, x) in zip(row, each, strict=True):
            for part, colour in ((t <= settled, TRANSIENT), (t >= settled, STEADY)):
                panel.plot(t[part], x[part], color=colour, linewidth=0.4)
            panel.axvline(settled, color=GREY, linestyle="--", linewidth=0.8)
            panel.set_xlim(t[0], t[-1])
        row[0].set_ylabel(f"{title}\n$x$")
    for panel in axes[-1]:
        panel.set_xlabel(r"$\omega t$")
    return fig
