"""The style of all figures, and a Matplotlib figure that shows itself once in a notebook: SVG, PNG, its data beside it.

Colours are Okabe and Ito's, told apart by every colour vision; each value of p keeps its colour throughout the book,
and lines that meet differ in dash as well.
"""

import io
from functools import wraps
from pathlib import Path

import matplotlib.style
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator

from .data import label_along, lines, names_of_places, series

BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILION, PURPLE, GREY = "#0072B2", "#D55E00", "#CC79A7", "#767676"
P_COLOUR = {0.1: VERMILION, 0.3: PURPLE, 0.5: ORANGE, 0.75: "#882255", 1.0: BLUE, 1.5: SKY, 2.0: GREEN, 3.0: BLACK}
P_DASH = {
    0.1: "-",
    0.3: (0, (5, 1, 1, 1)),
    0.5: (0, (6, 2)),
    0.75: "--",
    1.0: "-",
    1.5: (0, (1, 1)),
    2.0: "-.",
    3.0: ":",
}
TRANSIENT, STEADY = SKY, VERMILION
STABLE, UNSTABLE = BLUE, VERMILION
STYLE = ["default", Path(__file__).with_name("paper.mplstyle")]


def styled(draw):
    """Draw with the book's style, whatever the caller's matplotlib settings are."""

    @wraps(draw)
    def inside(*args, **kwargs):
        with matplotlib.style.context(STYLE):
            fig = draw(*args, **kwargs)
            for axes in fig.axes:
                decades(axes.xaxis)
                decades(axes.yaxis)
            return fig

    return inside


def decades(axis):
    """Ticks of a logarithmic axis at powers of ten, at most eight: Matplotlib's own choice depends on its version."""
    if axis.get_scale() != "log" or not isinstance(axis.get_major_locator(), LogLocator):
        return
    low, high = np.log10(axis.get_view_interval())
    every = max(1, int(np.ceil((high - low) / 8)))
    axis.set_major_locator(LogLocator(10.0**every, numticks=99))
    axis.set_minor_locator(LogLocator(10.0, subs=range(2, 10), numticks=99) if every == 1 else NullLocator())


class PageFigure(Figure):
    """Made without pyplot: no back end is needed, nothing is shown twice and nothing stays open."""

    def image(self, format):
        """The picture's bytes in a format such as "svg" or "png"; the same bytes for the same figure."""
        buffer = io.BytesIO()
        with matplotlib.style.context(STYLE):  # some settings count when saving only, the SVG's fixed ids among them
            self.savefig(buffer, format=format, dpi=200, metadata={"Date": None} if format == "svg" else None)
        return buffer.getvalue()

    def table(self):
        """What is drawn, as text in CSV: panel, series, x, y, value; the axes' labels in lines that begin with #.

        Read from the artists themselves, so that the file and the picture cannot disagree. A series is named by its
        label; the value is that of a map's cell or a contour's level, empty for curves and dots. A map of more than
        `data.MANY` cells takes a line for each of its rows, whose values follow one another apart by blanks.
        """
        heads, rows = [], []
        for panel, axes in enumerate(self.axes, 1):
            if axes.get_label() == "<colorbar>":
                heads.append(f"# value: {axes.get_ylabel() or axes.get_xlabel()}")
                continue
            x = label_along(axes.get_shared_x_axes().get_siblings(axes), "x") or self.get_supxlabel()
            y = label_along(axes.get_shared_y_axes().get_siblings(axes), "y") or self.get_supylabel()
            title = axes.get_title().replace("\n", ", ")
            heads.append(f"# panel {panel}{title and f' ({title})'}: x = {x}, y = {y}")
            heads += names_of_places(axes, panel)
            for number, (label, *columns) in enumerate(series(axes), 1):
                # An inner label of Matplotlib's (_child3) says nothing.
                name = f"series {number}" if label.startswith("_") else label.replace('"', "'").replace("\n", " ")
                rows += lines(f'{panel},"{name}"', *columns)
        return "\n".join([*heads, "panel,series,x,y,value", *rows]) + "\n"

    def _repr_mimebundle_(self, include=None, exclude=None):
        # JupyterLab puts a light ground under transparent pictures that ask for one; the book has a style sheet.
        light = {"needs_background": "light"}
        data = {
            "image/svg+xml": self.image("svg").decode(),
            "image/png": self.image("png"),
            "text/csv": self.table(),
        }
        return data, dict.fromkeys(data, light)


def panel(xlabel, ylabel, **figure):
    """A figure with one set of labelled axes, outside pyplot so that a notebook shows it once and none leaks."""
    fig = PageFigure(**figure)
    axes = fig.subplots()
    axes.set(xlabel=xlabel, ylabel=ylabel)
    return fig, axes


def line_of(p):
    """Colour, dash and label of the exponent p.

    An exponent that the book does not use gets a look of its own: 7 and 3 divide no step such as 0.05, 0.1 or 0.25, so
    that equally spaced exponents differ in colour or in dash over 21 of them; no such dash is in P_DASH.
    """
    hundredths = round(100 * float(p))
    colour = list(P_COLOUR.values())[hundredths % 7]
    dash = (0, (7, 1, *(hundredths % 3 + 1) * (1, 1)))
    return {"color": P_COLOUR.get(p, colour), "linestyle": P_DASH.get(p, dash), "label": f"$p = {p:g}$"}


def beyond(curves, share):
    """A limit of an axis a share beyond the greatest of the curves' absolute values, at a round number."""
    greatest = share * max(np.max(np.abs(curve)) for curve in curves)
    unit = 0.05 * 10.0 ** np.floor(np.log10(greatest))
    return round(float(np.ceil(greatest / unit) * unit), 12)
