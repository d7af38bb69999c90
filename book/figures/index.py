"""The headline: Eq. 13 between the computed tangencies and the onsets of chaos: arrays in, a figure out."""

from .paper import fig3b
from .style import BLUE, styled


@styled
def headline(p, mu_c, p_tangency, tangency, p_onset, onset):
    """Fig. 3b with the computed homoclinic tangencies on the line."""
    fig = fig3b(p, mu_c, p_onset, onset)
    axes = fig.axes[0]
    axes.plot(
        p_tangency, tangency, "x", color=BLUE, markersize=7, markeredgewidth=2, label="homoclinic tangency, computed"
    )
    axes.legend()
    return fig
