"""The paper's figures: arrays in, a matplotlib Figure out. Nothing is computed here.

One function a figure, named as in the paper.
"""

import numpy as np

from .style import (
    BLACK,
    BLUE,
    GREY,
    SKY,
    STABLE,
    STEADY,
    TRANSIENT,
    UNSTABLE,
    VERMILION,
    PageFigure,
    beyond,
    line_of,
    panel,
    styled,
)


@styled
def fig1a(x, potential):
    """The double-well potential V(x), Eq. 2."""
    fig, axes = panel("displacement $x$ (dimensionless)", "potential $V$ (dimensionless)")
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.plot(x, potential, color=BLACK)
    axes.set_xlim(x[0], x[-1])
    return fig


@styled
def fig1b(v, p, damping):
    """dpt(v)/alpha, Eq. 3, one curve for each exponent: damping (len(p), len(v))."""
    fig, axes = panel("velocity $v$ (dimensionless)", r"damping dpt$(v)/\alpha$ (dimensionless)")
    for exponent, curve in zip(p, damping, strict=True):
        axes.plot(v, curve, **line_of(exponent))
    axes.set_xlim(v[0], v[-1])
    axes.legend()
    return fig


def draw_manifolds(axes, loops, stable, unstable):
    """Homoclinic loops (a list of (x, v)) and over them the curves of W^S and W^U."""
    for x, v in loops:
        axes.plot(x, v, color=GREY, linewidth=3.5, alpha=0.5, label="homoclinic orbit, Eq. 8")
    for curves, colour, dash, label in ((stable, STABLE, "--", "$W^S$"), (unstable, UNSTABLE, "-", "$W^U$")):
        for x, v in curves:
            axes.plot(x, v, color=colour, linestyle=dash, linewidth=1.1, label=label)


@styled
def stroboscopic(t, path, points):
    """A path (2, n) in the plane and in time t (n,), with a dot once a forcing period: points (2, periods + 1)."""
    fig = PageFigure(figsize=(8.0, 3.4))
    plane, time = fig.subplots(1, 2)
    plane.plot(*path, color=SKY, linewidth=0.9, label="path")
    plane.plot(*points, "o", color=BLACK, markersize=4, label="once a period")
    for number, (x, v) in enumerate(points.T[:4]):
        plane.annotate(f"{number}", (x, v), xytext=(5, 5), textcoords="offset points", fontsize=9)
    plane.set(xlabel="displacement $x$ (dimensionless)", ylabel="velocity $v$ (dimensionless)")
    time.plot(t, path[0], color=SKY, linewidth=0.9)
    time.plot(np.linspace(t[0], t[-1], points.shape[1]), points[0], "o", color=BLACK, markersize=4)
    time.set(xlabel="time $t$ (dimensionless)", ylabel="displacement $x$ (dimensionless)")
    fig.legend(loc="outside upper center", ncols=2)
    return fig


@styled
def fig2(loops, cases, xlim=None, ylim=None):
    """Homoclinic loops under the manifolds of each case, a panel each: (title, stable curves, unstable curves, point).

    The point, a primary homoclinic one, is ringed; it may be None or missing.
    xlim, ylim : None for limits round the loops
    """
    fig = PageFigure(figsize=(3.4 + 1.3 * len(cases) + 0.8, 3.9))
    panels = fig.subplots(1, len(cases), sharey=True, squeeze=False)[0]
    width, height = (beyond([loop[i] for loop in loops], share) for i, share in ((0, 1.23), (1, 1.48)))
    xlim, ylim = xlim or (-width, width), ylim or (-height, height)
    for axes, (title, stable, unstable, *point) in zip(panels, cases, strict=True):
        draw_manifolds(axes, loops, stable, unstable)
        for x, v in (one for one in point if one is not None):
            look = {"markersize": 11, "markerfacecolor": "none", "markeredgewidth": 1.6, "linestyle": "none"}
            axes.plot(x, v, "o", color=BLACK, label="primary homoclinic point", **look)
        axes.set(xlabel="displacement $x$ (dimensionless)", xlim=xlim, ylim=ylim)
        axes.xaxis.label.set_size(9.5)
        axes.set_title(title, fontsize=10)
    panels[0].set_ylabel("velocity $v$ (dimensionless)")
    labels = {text: handle for axes in panels for handle, text in zip(*axes.get_legend_handles_labels(), strict=True)}
    fig.legend(labels.values(), labels.keys(), loc="outside upper center", ncols=len(labels))
    return fig


@styled
def fig3a(omega, p, ratio):
    """mu_c/alpha versus omega, Eq. 13, one curve for each exponent: ratio (len(p), len(omega))."""
    fig, axes = panel(r"forcing frequency $\omega$ (dimensionless)", r"$\mu_c/\alpha$ (dimensionless)")
    for exponent, curve in zip(p, ratio, strict=True):
        axes.plot(omega, curve, **line_of(exponent))
    axes.set(xlim=(omega[0], omega[-1]), ylim=(0, None))
    axes.legend()
    return fig


@styled
def fig3b(p, mu_c, p_onset, onset):
    """mu_c versus p, Eq. 13, with the numerical onsets lambda_1 > 0.1 as circles; none found, none drawn."""
    fig, axes = panel("damping exponent $p$", r"forcing amplitude $\mu$ (dimensionless)")
    axes.plot(p, mu_c, color=BLACK, label=r"critical amplitude $\mu_c$, Eq. 13")
    found = np.isfinite(onset)
    axes.plot(p_onset[found], onset[found], "o", color=VERMILION, fillstyle="none", label=r"onset of $\lambda_1 > 0.1$")
    axes.set(xlim=(0, p[-1]), ylim=(0, None))
    axes.legend()
    return fig


@styled
def fig4(mu, exponent, p, threshold, limits=None, window=None):
    """lambda_1 versus mu with the threshold line (Fig. 4a: p = 0.1, Fig. 4b: p = 1).

    limits : of the exponent's axis, None for the curve's own
    window : (first, last mu, least, greatest exponent) of an inset, None for none
    """
    fig, axes = panel(r"forcing amplitude $\mu$ (dimensionless)", r"$\lambda_1$ (per unit time)", figsize=(6.8, 4.4))
    _exponents(axes, mu, exponent, p, threshold)
    axes.set(xlim=(mu[0], mu[-1]), ylim=limits)
    if window is not None:
        inset = axes.inset_axes((0.49, 0.1, 0.48, 0.44))
        _exponents(inset, mu, exponent, p, threshold, ".-", markersize=3.5)
        inset.set(xlim=window[:2], ylim=window[2:])
        inset.tick_params(labelsize=9)
        axes.indicate_inset_zoom(inset, edgecolor=BLACK)
    fig.legend(*axes.get_legend_handles_labels(), loc="outside upper right", ncols=2)
    return fig


def _exponents(axes, mu, exponent, p, threshold, style="-", **look):
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.axhline(threshold, color=GREY, linestyle="--", linewidth=1.0, label=rf"threshold $\lambda_1 = {threshold:g}$")
    axes.plot(mu, exponent, style, color=line_of(p)["color"], linewidth=1.1, label=f"$p = {p:g}$", **look)


@styled
def fig5(transient, steady, transient_points, steady_points, settled=1200.0):
    """Phase portrait: paths (x, v) as lines, stroboscopic points as dots, before and after the settling time.

    transient and transient_points may be None (Fig. 5a shows the late motion alone).
    """
    fig, axes = panel("displacement $x$ (dimensionless)", "velocity $v$ (dimensionless)", figsize=(6.8, 4.6))
    shown = [(transient, transient_points, TRANSIENT, "before"), (steady, steady_points, STEADY, "after")]
    for layer, (path, points, colour, when) in enumerate(shown):
        if path is None:
            continue
        width = 0.5 if layer == 0 else 0.9
        axes.plot(*path, color=colour, linewidth=width, zorder=2 + 2 * layer, label=f"path {when} $t = {settled:g}$")
        axes.plot(
            *points,
            "o",
            color=BLACK if layer else BLUE,
            markersize=3.2,
            zorder=3 + 2 * layer,
            label=f"stroboscopic points {when}",
        )
    fig.legend(loc="outside upper center", ncols=2)
    return fig


@styled
def fig6(t, x, settled):
    """Time history in the colours of Fig. 5, which change at the time `settled`."""
    fig, axes = panel("time $t$ (dimensionless)", "displacement $x$ (dimensionless)", figsize=(6.8, 3.0))
    for part, colour, label in ((t <= settled, TRANSIENT, "before"), (t >= settled, STEADY, "after")):
        axes.plot(t[part], x[part], color=colour, linewidth=0.6, label=f"{label} $t = {settled:g}$")
    axes.axvline(settled, color=GREY, linestyle="--", linewidth=0.8)
    axes.set_xlim(t[0], t[-1])
    fig.legend(loc="outside upper center", ncols=2)
    return fig
