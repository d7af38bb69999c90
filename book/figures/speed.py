"""Figures of the page on speed: arrays in, a matplotlib Figure out. Nothing is measured or computed here."""

import numpy as np

from .style import BLACK, GREY, ORANGE, P_COLOUR, SKY, PageFigure, panel, styled

KERNELS = {"rk4": (BLACK, "o", "-", "Runge-Kutta"), "friction": (ORANGE, "D", "--", "friction time")}
COST_TICKS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)


@styled
def ratios(names, medians):
    """Times over the kernel's as bars on a logarithmic axis: medians, dict p -> (n,), nan where there is no answer."""
    fig, axes = panel("time for a trajectory and period, the kernel's = 1", "", figsize=(6.8, 4.6))
    height = 0.8 / len(medians)
    for row, (p, values) in enumerate(medians.items()):
        values = np.asarray(values, dtype=float)
        places = np.arange(len(names)) + (row - (len(medians) - 1) / 2) * height
        given = np.isfinite(values)
        axes.barh(
            places[given],
            values[given] - 1,
            0.9 * height,
            left=1,
            color=P_COLOUR[p],
            hatch="//" if row else None,
            edgecolor="white",
            linewidth=0,
            label=f"$p = {p:g}$",
        )
        for place, value in zip(places, values, strict=True):
            if np.isfinite(value):
                axes.text(
                    max(value, 1) * 1.12,
                    place,
                    f"{value:.2g}" if value < 10 else f"{value:.0f}",
                    va="center",
                    fontsize=9,
                )
            else:
                axes.text(1.12, place, "no answer", va="center", fontsize=9, color=GREY)
    axes.axvline(1, color=BLACK, linewidth=1.2)
    axes.set(xscale="log", axisbelow=True)
    axes.set_yticks(np.arange(len(names)), names)
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.set_xlim(right=10 * max(np.nanmax(values) for values in medians.values()))
    fig.legend(loc="outside upper right", ncols=len(medians))
    return fig


@styled
def cost_growth(series):
    """How cost grows, one panel a series: dict (xlabel, scale of x) -> dict kernel -> (values, costs).

    The scale is "log" or "linear"."""
    fig = PageFigure(figsize=(6.8, 5.0))
    panels = fig.subplots(2, -(-len(series) // 2))
    for axes, ((xlabel, scale), curves) in zip(panels.flat, series.items(), strict=True):
        for kernel, (values, costs) in curves.items():
            colour, marker, dash, label = KERNELS[kernel]
            # Single exponents are exceptions: no line leads from one to the next.
            axes.plot(
                values, costs, color=colour, marker=marker, linestyle=dash if scale == "log" else "none", label=label
            )
        axes.axhline(1, color=SKY, linewidth=1.0, zorder=0)
        axes.set(xlabel=xlabel, xscale=scale, yscale="log")
        low, high = axes.get_ylim()
        ticks = [tick for tick in COST_TICKS if low < tick < high]
        axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.tick_params(axis="y", which="minor", left=False, labelleft=False)
    fig.supylabel("cost, relative", fontsize=11)
    fig.legend(*panels.flat[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return fig
