"""Figures of the largest Lyapunov exponent compared between exponents p: arrays in, a Figure out."""

import numpy as np

from .bifurcations import MU
from .style import PageFigure, line_of, styled

MARKERS = ("o", "s", "^", "D")


@styled
def exponents_compared(curves):
    """lambda_1 of the wandering motion against mu, mu / mu_c and the energy taken, a panel each.

    curves : dict p -> (mu, ratio, energy, spread, exponent, error, lasts): spread the error of the energy, lasts a
        boolean array: filled markers
    """
    fig = PageFigure(figsize=(6.8, 7.6))
    panels = fig.subplots(3, 1, sharey=True)
    for (p, (*across, spread, exponent, error, lasts)), marker in zip(curves.items(), MARKERS, strict=False):
        look = line_of(p)
        for axes, x in zip(panels, across, strict=True):
            seen = np.isfinite(error)
            bars = {"fmt": "none", "ecolor": look["color"], "elinewidth": 0.8}
            sideways = spread[seen] if axes is panels[-1] else None
            axes.errorbar(x[seen], exponent[seen], error[seen], sideways, **bars)
            for part, fill in ((seen & lasts, "full"), (seen & ~lasts, "none")):
                label = look["label"] if fill == "none" else None
                axes.plot(
                    x[part], exponent[part], marker, color=look["color"], fillstyle=fill, markersize=4, label=label
                )
    names = (MU, r"forcing amplitude over the critical one, $\mu/\mu_c$", "energy taken per period (dimensionless)")
    for axes, name in zip(panels, names, strict=True):
        axes.set(xlabel=name, ylabel=r"$\lambda_1$ (per unit time)")
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return fig


@styled
def strong_forcing(shares):
    """Share of chaotic starts against mu up to strong forcing, a panel for each p: dict p -> (mu, share)."""
    fig = PageFigure(figsize=(6.8, 1.0 * len(shares) + 0.6))
    panels = fig.subplots(len(shares), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, (p, (mu, share)), marker in zip(panels, shares.items(), MARKERS, strict=False):
        look = line_of(p)
        axes.plot(mu, share, marker=marker, markersize=4, linewidth=1.2, clip_on=False, color=look["color"])
        axes.set(ylim=(0, 1), yticks=(0, 0.5, 1))
        axes.set_title(look["label"], fontsize=10, loc="left", pad=3)
    panels[-1].set_xlabel(MU)
    fig.supylabel("fraction of initial conditions", fontsize=11)
    return fig
