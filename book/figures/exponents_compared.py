"""Figures of the largest Lyapunov exponent compared between exponents p: arrays in, a Figure out."""

import numpy as np

from .bifurcations import MU
from .style import PageFigure, line_of, panel, styled

MARKERS = ("o", "s", "^", "D")


@styled
def exponents_compared(curves):
    """lambda_1 of the wandering motion against mu, mu / mu_c and the energy taken, a panel each.

    curves : dict p -> (mu, ratio, energy, spread, exponent, error, lasts): spread the error of the energy, lasts a
        boolean array: filled markers
    """
    fig = PageFigure(figsize=(6.8, 3.7))
    panels = fig.subplots(1, 3, sharey=True)
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
    for axes, name in zip(panels, (r"$\mu$", r"$\mu/\mu_c$", "energy taken per period"), strict=True):
        axes.set_xlabel(name)
    panels[0].set_ylabel(r"$\lambda_1$ (per unit time)")
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return fig


@styled
def strong_forcing(shares):
    """Share of chaotic starts against mu up to strong forcing: dict p -> (mu, share)."""
    fig, axes = panel(MU, "fraction of initial conditions", figsize=(6.8, 3.6))
    for (p, (mu, share)), marker in zip(shares.items(), MARKERS, strict=False):
        axes.plot(mu, share, marker=marker, markersize=3.5, linewidth=1.2, **{**line_of(p), "linestyle": "-"})
    axes.set_ylim(-0.03, 1.03)
    fig.legend(loc="outside upper center", ncols=4)
    return fig
