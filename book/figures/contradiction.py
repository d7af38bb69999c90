"""The figures of the chapter on the contradiction: arrays in, a matplotlib Figure out. Nothing is computed here."""

import numpy as np

from .style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, PageFigure, line_of, panel, styled

MARKERS = ("o", "s", "^", "D")
FORCING = r"forcing amplitude $\mu$ (dimensionless)"


@styled
def survival_curves(curves, sample):
    """Shares of survivors against time on a logarithmic axis, and the fitted laws.

    curves : dict label -> (n, share, since, mean), the law drawn from `since` on with the mean lifetime `mean`
    sample : periods after which the motion of Fig. 5b had settled, drawn as a line
    """
    fig, axes = panel("time $n$ (forcing periods)", "share of starts still wandering", figsize=(6.8, 4.2))
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
        axes.set(title=f"$p = {p:g}$", xlabel=FORCING, yscale="log")
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
        looks = ((BLUE, "o", "by the small orbits"), (ORANGE, "s", "by the large orbit"))
        for (rate, error), (colour, marker, label) in zip(both, looks, strict=True):
            seen = rate > 0
            axes.errorbar(
                mu[seen], rate[seen], error[seen], fmt=marker, color=colour, markersize=4, capsize=2, label=label
            )
        _ends(axes, folds[p], crises[p])
        axes.set(title=f"$p = {p:g}$", xlabel=FORCING, yscale="log")
        axes.xaxis.label.set_size(9.5)
    panels[0].set_ylabel("captures per period")
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return fig


def _ends(axes, fold, crisis):
    """The fold and the crisis as lines, the window between them shaded where chaos lasts."""
    if fold < crisis:
        axes.axvspan(fold, crisis, color=GREY, alpha=0.2, linewidth=0)
    axes.axvline(fold, color=BLACK, linestyle="--", linewidth=1.0, label="fold of the small orbits")
    axes.axvline(crisis, color=BLACK, linestyle=":", linewidth=1.4, label="crisis")


@styled
def edge_distances(distances):
    """Distance of chaos from the border of the large orbit's basin against mu: dict p -> (mu, distance)."""
    fig, axes = panel(FORCING, "distance from the border (dimensionless)", figsize=(6.8, 3.9))
    axes.axhline(0, color=GREY, linewidth=0.8)
    for (p, (mu, distance)), marker in zip(distances.items(), MARKERS, strict=False):
        axes.plot(mu, distance, marker=marker, markersize=4, **line_of(p))
    axes.legend()
    return fig


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
def order_of_events(p, critical, folds, crises):
    """The critical amplitude, the fold of the small orbits and the crisis against p; lasting chaos shaded."""
    fig, axes = panel("damping exponent $p$", FORCING, figsize=(6.8, 4.2))
    axes.plot(p, critical, color=GREY, linewidth=2.0, label=r"critical amplitude $\mu_c$, Eq. 13")
    axes.plot(p, folds, "o--", color=BLUE, markersize=4, label="fold of the small orbits")
    axes.plot(p, crises, "s-", color=VERMILION, markersize=4, label="crisis: chaos reaches the large orbit's basin")
    axes.fill_between(p, folds, crises, where=crises > folds, color=VERMILION, alpha=0.2, interpolate=True, linewidth=0)
    inset = axes.inset_axes((0.42, 0.36, 0.55, 0.3))
    inset.axhline(0, color=GREY, linewidth=0.8)
    inset.plot(p, crises - folds, "D-", color=BLACK, markersize=3)
    inset.set_title("crisis less fold", fontsize=9)
    axes.set(xlim=(0, None), ylim=(0, None))
    axes.legend(loc="lower left", fontsize=9)
    return fig


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
    for axes, name in zip(panels, (r"forcing $\mu$", r"$\mu/\mu_c$", "energy taken per period"), strict=True):
        axes.set_xlabel(name)
    panels[0].set_ylabel(r"$\lambda_1$ (per unit time)")
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return fig


@styled
def strong_forcing(shares):
    """Share of chaotic starts against mu up to strong forcing: dict p -> (mu, share)."""
    fig, axes = panel(FORCING, "share of chaotic starts", figsize=(6.8, 3.6))
    for (p, (mu, share)), marker in zip(shares.items(), MARKERS, strict=False):
        axes.plot(mu, share, marker=marker, markersize=3.5, linewidth=1.2, **{**line_of(p), "linestyle": "-"})
    axes.set_ylim(-0.03, 1.03)
    fig.legend(loc="outside upper center", ncols=4)
    return fig
