"""A Matplotlib figure that shows itself once in a notebook, as SVG with a PNG beside it, in the book's one style."""

import io
from functools import wraps
from pathlib import Path

import matplotlib.style
from matplotlib.figure import Figure

STYLE = ["default", Path(__file__).with_name("paper.mplstyle")]


def styled(draw):
    """Draw with the book's style, whatever the caller's matplotlib settings are."""

    @wraps(draw)
    def inside(*args, **kwargs):
        with matplotlib.style.context(STYLE):
            return draw(*args, **kwargs)

    return inside


class PageFigure(Figure):
    """Made without pyplot: no back end is needed, nothing is shown twice and nothing stays open."""

    def image(self, format):
        """The picture's bytes in a format such as "svg" or "png"; the same bytes for the same figure."""
        buffer = io.BytesIO()
        with matplotlib.style.context(STYLE):  # some settings count when saving only, the SVG's fixed ids among them
            self.savefig(buffer, format=format, dpi=200, metadata={"Date": None} if format == "svg" else None)
        return buffer.getvalue()

    def _repr_mimebundle_(self, include=None, exclude=None):
        # JupyterLab puts a light ground under transparent pictures that ask for one; the book has a style sheet.
        light = {"needs_background": "light"}
        data = {"image/svg+xml": self.image("svg").decode(), "image/png": self.image("png")}
        return data, dict.fromkeys(data, light)
