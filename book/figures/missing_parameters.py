"""Which (alpha, omega) the paper's statements leave: arrays in, a figure out."""

import numpy as np

from .style import BLUE, VERMILION, PageFigure, styled


@styled
def scan_map(alpha, omega, criteria, chosen):
    """Which (alpha, omega) agree with the text, one small map for each criterion: dict of boolean arrays (a, w)."""
    fig = PageFigure(figsize=(6.8, 5.2))
    panels = fig.subplots(2, -(-len(criteria) // 2), sharex=True, sharey=True)
    for axes, (name, agrees) in zip(panels.flat, criteria.items(), strict=False):
        i, j = np.nonzero(agrees)
        axes.plot(omega[j], alpha[i], "s", color=BLUE, markersize=4)
        axes.plot(*chosen[::-1], "o", color=VERMILION, fillstyle="none", markersize=12, markeredgewidth=1.8)
        axes.set_title(f"{name}\n{agrees.sum()} of {agrees.size}", fontsize=9.5)
        axes.set(xlim=(omega[0] - 0.05, omega[-1] + 0.05), ylim=(alpha[0] - 0.02, alpha[-1] + 0.02))
    for axes in panels.flat[len(criteria) :]:
        axes.set_axis_off()
    fig.supxlabel(r"forcing frequency $\omega$ (dimensionless)", fontsize=11)
    fig.supylabel(r"damping coefficient $\alpha$ (dimensionless)", fontsize=11)
    return fig
