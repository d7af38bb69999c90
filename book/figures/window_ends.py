"""Figures of the two ends of the window of chaos, a fold and a crisis: arrays in, a Figure out."""

import numpy as np

from .bifurcations import MU
from .style import BLUE, GREY, VERMILION, PageFigure, line_of, panel, styled


@styled
def passage(distance, periods, anchor, below):
    """Both sides of the fold on logarithmic axes: times to leave its place above it, lifetimes of chaos below it.

    distance, periods (n,) : above the fold, with the power -1/2 through `anchor`
    below : (distance, lifetime, error), (m,) each
    """
    fig, axes = panel(r"distance $|\mu - \mu_F|$ from the fold", "forcing periods", figsize=(6.0, 3.8))
    axes.loglog(distance, periods, "o", color=VERMILION, label="above: to leave the place of the fold")
    reach = np.array([min(distance), max(distance)])
    axes.loglog(reach, anchor[1] * (reach / anchor[0]) ** -0.5, color=GREY, linewidth=1.0, label="power $-1/2$")
    look = {"fmt": "o", "color": BLUE, "fillstyle": "none", "markersize": 5, "capsize": 2}
    axes.errorbar(*below, **look, label="below: mean lifetime of chaos")
    axes.legend(fontsize=9)
    return fig


@styled
def distances_to_basin_boundary(distances):
    """Distance of chaos from the border of the large orbit's basin against mu: dict p -> (mu, distance)."""
    fig, axes = panel(MU, "distance from the border (dimensionless)", figsize=(6.8, 3.9))
    axes.axhline(0, color=GREY, linewidth=0.8)
    for (p, (mu, distance)), marker in zip(distances.items(), "os", strict=False):
        axes.plot(mu, distance, marker=marker, markersize=4, **line_of(p))
    axes.legend()
    return fig


@styled
def order_of_events(p, critical, folds, crises):
    """The fold of the small orbits and the crisis against p, lasting chaos shaded; below beside mu_c."""
    fig = PageFigure(figsize=(6.8, 5.4))
    near, whole = fig.subplots(2, 1, sharex=True)
    whole.plot(p, critical, color=GREY, linewidth=2.0, label=r"critical amplitude $\mu_c$, Eq. 13")
    for axes in (near, whole):
        axes.plot(p, folds, "o--", color=BLUE, markersize=4, label="fold of S")
        axes.plot(p, crises, "s-", color=VERMILION, markersize=4, label="crisis: chaos reaches the basin of L")
        lasts = {"where": crises > folds, "interpolate": True}
        axes.fill_between(p, folds, crises, color=VERMILION, alpha=0.2, linewidth=0, **lasts)
    whole.set(xlabel="damping exponent $p$", xlim=(0, None), ylim=(0, None))
    fig.supylabel(MU, fontsize=11)
    fig.legend(*whole.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return fig
