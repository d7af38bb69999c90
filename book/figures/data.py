"""What a figure shows, read from its artists: the rows of the table beside each picture."""

from itertools import pairwise

import numpy as np
from matplotlib.container import BarContainer
from matplotlib.patches import Rectangle
from matplotlib.ticker import FixedLocator

MANY = 5000  # a map of more cells takes a line for each of its rows


def lines(start, x, y, value):
    """A series as lines of the table: one for each point, but one for each row of a large map."""
    if x.size <= MANY or not np.any(np.isfinite(value)):
        return [start + "," + ",".join(numbers) for numbers in zip(*map(written, (x, y, value)), strict=True)]
    ends = [0, *(np.flatnonzero(np.diff(y)) + 1), x.size]
    rows = []
    for a, b in pairwise(ends):
        across = f"{x[a]:.10g} to {x[b - 1]:.10g}, {b - a} equally spaced"
        rows.append(f'{start},"{across}",{y[a]:.10g},"{" ".join(written(value[a:b]))}"')
    return rows


def written(column):
    """Numbers as text, to ten digits; what is masked or not finite stays empty, as a gap in the drawing does."""
    values = np.ma.filled(np.ma.asarray(column, dtype=float), np.nan)
    return [f"{value:.10g}" if np.isfinite(value) else "" for value in values]


def names_of_places(axes, panel):
    """Remarks on an axis whose places bear names in place of numbers: which name stands where."""
    for axis in (axes.xaxis, axes.yaxis):
        if isinstance(axis.get_major_locator(), FixedLocator):
            places = axis.get_majorticklocs()
            shown = zip(places, axis.get_major_formatter().format_ticks(places), strict=True)
            named = [f"{place:g} = {name}" for place, name in shown if name not in ("", f"{place:g}")]
            if named:
                yield f"# panel {panel}, {axis.axis_name}: " + ", ".join(named)


def label_along(sharing, axis):
    """The label that an axis shows, or another that shares its scale."""
    labels = (getattr(axes, f"{axis}axis").get_label_text() for axes in sharing)
    return next(filter(None, labels), "")


def series(axes):
    """(label, x, y, value) of every curve, row of dots, bar, map and family of contours in the axes."""
    # Bars of error are several artists under one label.
    names = {part: group.get_label() for group in axes.containers for part in flat(group)}
    for line in axes.lines:
        x, y = (np.asarray(column, dtype=float) for column in line.get_data(orig=False))
        # A straight line over the whole panel is kept in the panel's own units along itself.
        if line.get_transform() == axes.get_yaxis_transform(which="grid"):
            x = np.array(axes.get_xlim())
        elif line.get_transform() == axes.get_xaxis_transform(which="grid"):
            y = np.array(axes.get_ylim())
        yield str(names.get(line, line.get_label())), x, y, np.full(x.size, np.nan)
    for group in axes.containers:
        if isinstance(group, BarContainer):  # the end of each bar, at its middle
            ends, middles = (np.array([point(bar) for bar in group]) for point in (end, Rectangle.get_center))
            x, y = (ends[:, 0], middles[:, 1]) if group.orientation == "horizontal" else (middles[:, 0], ends[:, 1])
            yield str(group.get_label()), x, y, np.full(len(ends), np.nan)
    for drawn in axes.collections:
        yield from of_collection(drawn, str(names.get(drawn, drawn.get_label())))
    for picture in axes.images:
        value = picture.get_array()
        left, right, bottom, top = picture.get_extent()
        value = value if value.ndim == 2 else value @ np.ones(value.shape[2])
        rows, columns = value.shape
        first, last = (top, bottom) if picture.origin == "upper" else (bottom, top)
        x = left + (np.arange(columns) + 0.5) * (right - left) / columns
        y = first + (np.arange(rows) + 0.5) * (last - first) / rows
        x, y = np.meshgrid(x, y)
        yield picture.get_label(), x.ravel(), y.ravel(), value.ravel()


def end(bar):
    """The corner of a bar that is farthest from its foot."""
    return bar.get_corners()[2]


def flat(group):
    """The artists in a container, however nested."""
    return [part for item in group for part in (flat(item) if isinstance(item, tuple) else [item]) if part is not None]


def of_collection(drawn, label):
    """The series of one collection: cells of a map at their centres, contours level by level, bands, or dots."""
    if hasattr(drawn, "get_coordinates"):  # pcolormesh
        corners = drawn.get_coordinates()
        value = np.ma.ravel(drawn.get_array())
        if value.size == (corners.shape[0] - 1) * (corners.shape[1] - 1):
            corners = (corners[1:, 1:] + corners[1:, :-1] + corners[:-1, 1:] + corners[:-1, :-1]) / 4
        yield label, corners[..., 0].ravel(), corners[..., 1].ravel(), value
        return
    paths = drawn.get_paths()
    levels = getattr(drawn, "levels", [])
    if len(levels) or len(drawn.get_offsets()) <= 1:
        for number, path in enumerate(paths):
            x, y = path.vertices.T
            level = levels[number] if number < len(levels) else np.nan
            yield label, x, y, np.full(x.size, level)
        return
    x, y = np.ma.asarray(drawn.get_offsets()).T
    value = drawn.get_array()
    yield label, x, y, np.full(x.size, np.nan) if value is None or value.size != x.size else value
