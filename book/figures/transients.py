"""Figures of how long chaos lasts and of what captures it: arrays in, a Figure out. Nothing is computed here."""

import numpy as np

from .bifurcations import MU
from .style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, PageFigure, line_of, panel, styled


@styled
def survival_curves(curves, sample):
    """Shares of survivors against time on a logarithmic axis, and the fitted laws.

    curves : dict label -> (n, share, since, mean), the law drawn from `since` on with the mean lifetime `mean`
    sample : periods after which the motion of Fig. 5b had settled, drawn as a line
    """
    fig, axes = panel("time $n$ (forcing periods)", "fraction still wandering", figsize=(6.8, 4.2))
    looks = zip((VERMILION, ORANGE, BLUE, GREEN), ("-", "--", "-.", ":"), strict=True)
    for (label, (n, share, since, mean)), (colour, dash) in zip(curves.items(), looks, strict=False):
        axes.step(n, share, where="post", color=colour, linestyle=dash, label=label)
        start = share[np.searchsorted(n, since, side="right") - 1]
        later = np.array([since, max(n[-1], since + 1)])
        axes.plot(later, start * np.exp(-(later - since) / mean), color=BLACK, linewidth=0.9)
    axes.axvline(sample, color=GREY, linestyle="--", linewidth=1.0)
    axes.set(yscale="log", xlim=(0, None), ylim=(1e-3, 1.2))
    axes.legend()
    return fig


@styled
def mean_lifetimes(escapes, folds, crises, bound):
    """Mean lifetime of chaos against mu, a panel for each p: dict p -> Escape-like (mu, mean, error).

    folds, crises : dict p -> forcing; between them, where the fold comes first, the window of lasting chaos is shaded.
    bound : dict p -> (mu, lifetime) where no capture was seen, drawn as triangles: lower bounds
    """
    fig = PageFigure(figsize=(6.8, 3.9))
    panels = np.atleast_1d(fig.subplots(1, len(escapes), sharey=True))
    for axes, (p, (mu, mean, error)) in zip(panels, escapes.items(), strict=True):
        colour = line_of(p)["color"]
        axes.errorbar(mu, mean, error, fmt="o", color=colour, markersize=4, capsize=2, label="mean lifetime")
        axes.plot(*bound[p], "^", color=colour, fillstyle="none", label="lower bound: no capture seen")
        _ends(axes, folds[p], crises[p])
        axes.set(title=f"$p = {p:g}$", xlabel=MU, yscale="log")
        axes.xaxis.label.set_size(9.5)
    panels[0].set_ylabel("mean lifetime (forcing periods)")
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return fig


@styled
def capture_rates(rates, folds, crises):
    """Rates of capture by small and large orbits against mu, a panel for each p: dict p -> (mu, small, large).

    small, large : (2, n) rate and error; a rate of zero is not drawn
    """
    fig = PageFigure(figsize=(6.8, 3.9))
    panels = np.atleast_1d(fig.subplots(1, len(rates), sharey=True))
    for axes, (p, (mu, *both)) in zip(panels, rates.items(), strict=True):
        looks = ((BLUE, "o", "by S"), (ORANGE, "s", "by L"))
        for (rate, error), (colour, marker, label) in zip(both, looks, strict=True):
            seen = rate > 0
            axes.errorbar(
                mu[seen], rate[seen], error[seen], fmt=marker, color=colour, markersize=4, capsize=2, label=label
            )
        _ends(axes, folds[p], crises[p])
        axes.set(title=f"$p = {p:g}$", xlabel=MU, yscale="log")
        axes.xaxis.label.set_size(9.5)
    panels[0].set_ylabel("captures per period")
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return fig


def _ends(axes, fold, crisis):
    """The fold and the crisis as lines, the window between them shaded where chaos lasts."""
    if fold < crisis:
        axes.axvspan(fold, crisis, color=GREY, alpha=0.2, linewidth=0)
    axes.axvline(fold, color=BLACK, linestyle="--", linewidth=1.0, label="fold of S")
    axes.axvline(crisis, color=BLACK, linestyle=":", linewidth=1.4, label="crisis")
