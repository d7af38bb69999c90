"""Basins of attraction and the dimension of their boundary, drawn: arrays in, a Figure out. Nothing is computed.

Left is blue, right is orange, round both wells green, chaos purple; what is not resolved is yellow, which no basin is.
"""

import numpy as np

from .style import BLACK, BLUE, GREEN, GREY, ORANGE, P_COLOUR, PURPLE, SKY, VERMILION, PageFigure, panel, styled

YELLOW, TEAL = "#F0E442", "#44AA99"
KIND_COLOURS = (SKY, BLUE, ORANGE, VERMILION, GREEN, TEAL, PURPLE, YELLOW)  # as duffing.basins.KINDS
FATE_COLOURS = (SKY, ORANGE, GREEN, PURPLE)  # as duffing.fates.NAMES
MARKERS = ("o", "s", "^", "D", "v")


@styled
def basin_pictures(cases, names, columns=2):
    """Basins side by side. names (k,) : of the kinds, whose colours are KIND_COLOURS.

    cases : of each panel (title, x (nx,), v (nv,), kinds (nv, nx), points, curves): the attractors' stroboscopic points
        (a list of (2, n)) as white dots, and curves (a list of (2, n)) in black; each panel has its own frame
    """
    rows = -(-len(cases) // columns)
    fig = PageFigure(figsize=(3.0 * columns + 0.6, 2.6 * rows + 0.9))
    panels = fig.subplots(rows, columns, squeeze=False)
    seen = set()
    for axes, (title, x, v, kinds, points, curves) in zip(panels.flat, cases, strict=False):
        _image(axes, x, v, kinds, KIND_COLOURS)
        seen |= set(np.unique(kinds).tolist())
        for curve in curves:
            axes.plot(*curve, color=BLACK, linewidth=0.7)
        for orbit in points:
            axes.plot(*orbit, "o", color="white", markeredgecolor=BLACK, markersize=4.5, markeredgewidth=0.9)
        axes.set(xlim=(x[0], x[-1]), ylim=(v[0], v[-1]))
        axes.set_title(title, fontsize=10)
        axes.grid(False)
    for axes in panels.flat[len(cases) :]:
        axes.set_axis_off()
    fig.supxlabel("initial displacement $x$ (dimensionless)", fontsize=10.5)
    fig.supylabel("initial velocity $v$ (dimensionless)", fontsize=10.5)
    handles = _squares(panels[0, 0], {names[kind]: KIND_COLOURS[kind] for kind in sorted(seen)})
    if any(curves for *_, curves in cases):
        handles += panels[0, 0].plot([], [], color=BLACK, linewidth=0.9, label="$W^S$")
    fig.legend(handles=handles, loc="outside upper center", ncols=4, fontsize=9)
    return fig


@styled
def fate_section(mu, x, fates, names, marked):
    """Fates (len(x), len(mu)) of starts at v = 0 against the forcing; marked : forcings drawn as dashed lines."""
    fig, axes = panel(
        r"forcing amplitude $\mu$ (dimensionless)", "initial displacement $x$, at $v = 0$", figsize=(6.8, 3.8)
    )
    _image(axes, mu, x, fates, FATE_COLOURS)
    for value in marked:
        axes.axvline(value, color=BLACK, linestyle="--", linewidth=1.0)
    axes.grid(False)
    handles = _squares(axes, {names[k]: FATE_COLOURS[k] for k in np.unique(fates)})
    fig.legend(handles=handles, loc="outside upper center", ncols=4)
    return fig


@styled
def uncertain_part(curves):
    """The part of the line that is uncertain against the distance: list of (label, eps (n,), part (n,)), log-log."""
    fig, axes = panel(r"distance $\epsilon$ (in lengths of the line)", r"uncertain fraction $f(\epsilon)$")
    colours = (BLACK, BLUE, GREEN, ORANGE, VERMILION, PURPLE)
    for (label, eps, part), colour, marker in zip(curves, colours, (*MARKERS, "P"), strict=False):
        axes.loglog(eps, part, color=colour, marker=marker, markersize=4, label=label)
    axes.legend(loc="lower right")
    return fig


@styled
def boundary_dimension(lines, random, contact, near=(0.985, 1.025)):
    """D against mu/mu_c, near one and as a whole: lines and random are dicts p -> (ratio (n,), D (n,), error (n,)),
    drawn as lines with filled and as open markers; contact : dict p -> a ratio, a vertical line each."""
    fig = PageFigure(figsize=(7.4, 4.4))
    panels = fig.subplots(1, 2, sharey=True)
    for axes, part in zip(panels, (near, (0.45, None)), strict=True):
        axes.axhline(1, color=GREY, linewidth=0.8)
        for p, ratio in contact.items():
            axes.axvline(ratio, color=P_COLOUR.get(p, GREY), linestyle="--", linewidth=1.0)
        for (p, (ratio, value, error)), marker in zip(lines.items(), MARKERS, strict=False):
            look = {"color": P_COLOUR.get(p, GREY), "marker": marker, "markersize": 4, "capsize": 2, "linewidth": 1.2}
            axes.errorbar(ratio, value, error, label=f"$p = {p:g}$, on a line", **look)
        for p, (ratio, value, error) in random.items():
            look = {"color": P_COLOUR.get(p, GREY), "marker": "o", "markersize": 9, "fillstyle": "none"}
            axes.errorbar(ratio, value, error, label=f"$p = {p:g}$, random points", linestyle="none", **look)
        axes.set(xlim=part, ylim=(0.9, 2.0))
    panels[0].set_ylabel("dimension $D$ of the boundary")
    fig.supxlabel(r"forcing amplitude over the critical one, $\mu/\mu_c$", fontsize=11)
    fig.legend(*panels[1].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return fig


def _image(axes, x, y, codes, colours):
    """Codes (len(y), len(x)) as colours, a rectangle round each grid point; a raster in any format."""
    dx, dy = (x[1] - x[0]) / 2, (y[1] - y[0]) / 2
    palette = np.array([[int(colour[i : i + 2], 16) for i in (1, 3, 5)] for colour in colours], dtype=np.uint8)
    extent = (x[0] - dx, x[-1] + dx, y[0] - dy, y[-1] + dy)
    axes.imshow(palette[codes], interpolation="nearest", origin="lower", aspect="auto", extent=extent)


def _squares(axes, colours):
    """Handles of a legend: dict name -> colour."""
    return [axes.plot([], [], "s", color=colour, markersize=8, label=name)[0] for name, colour in colours.items()]
