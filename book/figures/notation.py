"""The cast of orbits: branches with their letters. Arrays in, a figure out."""

from .bifurcations import MU, colour_of, draw_branch, draw_marks
from .style import BLACK, PURPLE, PageFigure, styled


@styled
def cast(cases, last=0.4):
    """Amplitude against mu, a panel for each p: dict p -> (branches, marks, letters, crisis).

    branches and marks as in `figures.bifurcations`; letters : (letter, mu, value); crisis : the forcing amplitude
    """
    fig = PageFigure(figsize=(8.0, 4.2))
    for axes, (p, (branches, marks, letters, crisis)) in zip(
        fig.subplots(1, len(cases), sharey=True), cases.items(), strict=True
    ):
        axes.axvline(crisis, color=PURPLE, linestyle="-.", linewidth=1.2, label="boundary crisis")
        for name, mu, value, stable in branches:
            draw_branch(axes, mu, value, stable, color=colour_of(name))
        draw_marks(axes, marks)
        for letter, mu, value in letters:
            look = {"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": BLACK, "linewidth": 0.6}
            axes.text(mu, value, letter, fontsize=9, ha="center", va="center", zorder=6, bbox=look)
        axes.set_title(f"$p = {p:g}$", fontsize=10)
        axes.set(xlabel=MU, xlim=(0, last), ylim=(0, None))
        axes.xaxis.label.set_size(9.5)
    fig.axes[0].set_ylabel("half the range of $x$ (dimensionless)")
    labels = dict(zip(*fig.axes[0].get_legend_handles_labels()[::-1], strict=True))
    fig.legend(labels.values(), labels.keys(), loc="outside upper center", ncols=3)
    return fig
