"""Figures of the resonances, in a well and round both: arrays in, a Figure out; branches as in `bifurcations`."""

from .bifurcations import OMEGA, draw_branch, draw_marks, legend_above
from .style import PageFigure, line_of, styled


@styled
def responses(panels, omega_range, amplitude_last=0.75):
    """In-well amplitude against omega, a panel for each mu: dict mu -> dict p -> (branches, marks)."""
    fig = PageFigure(figsize=(7.4, 4.0))
    for axes, (mu, cases) in zip(fig.subplots(1, len(panels), sharey=True), panels.items(), strict=True):
        _response(axes, cases)
        axes.set_title(rf"$\mu = {mu:g}$", fontsize=10)
        axes.set(xlabel=OMEGA, xlim=omega_range, ylim=(0, amplitude_last))
        axes.xaxis.label.set_size(9.5)
    fig.axes[0].set_ylabel("half the range of $x$ (dimensionless)")
    legend_above(fig, fig.axes[0])
    return fig


@styled
def large_orbit(mu, cases, thresholds, omega_range):
    """Large orbits: amplitude against omega, dict p -> (branches, marks), and the least mu, p -> (omega, mu, ...)."""
    fig = PageFigure(figsize=(7.4, 4.0))
    left, right = fig.subplots(1, 2)
    _response(left, cases)
    left.set_title(rf"$\mu = {mu:g}$", fontsize=10)
    left.set(xlabel=OMEGA, ylabel="half the range of $x$ (dimensionless)", xlim=omega_range)
    for p, (omega, least, *_) in thresholds.items():
        right.plot(omega, least, **line_of(p) | {"linestyle": "-"})  # as on the left: dashes are unstable orbits
    right.set(xlabel=OMEGA, ylabel=r"least $\mu$ (dimensionless)", xlim=omega_range, ylim=(0, 0.4))
    for axes in (left, right):
        axes.xaxis.label.set_size(9.5)
    legend_above(fig, right)
    return fig


def _response(axes, cases):
    for p, (branches, marks) in cases.items():
        look = line_of(p)
        for _, omega, value, stable in branches:
            draw_branch(axes, omega, value, stable, color=look["color"], label=look["label"])
        draw_marks(axes, marks)
