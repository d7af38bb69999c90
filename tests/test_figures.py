"""Regression of the book's figures on two levels: the data behind each, and the picture drawn from reference data.

A picture is compared without its text, with its axes in fixed places and the cells of its maps on whole pixels: what is
left does not depend on the version of FreeType or Matplotlib (tried: 3.8 to 3.11, whose pictures differ by less
than 0.01), and still shows every line, marker and colour. `make baselines` writes both anew.
"""

import ast
import io
from functools import reduce
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from unittest import mock

import cases
import matplotlib.image
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.ticker import NullFormatter

from book.figures import paper as figures
from book.figures.style import STYLE

BASELINE = Path(__file__).with_name("baseline")
# Each file of tests/cases holds a dict CASES, name -> Case: a new file takes part by being there.
FILES = [
    import_module(f"cases.{name}")
    for name in sorted(chapter.name for chapter in iter_modules(cases.__path__))
    if name != "case"
]
CASES = {name: case for file in FILES for name, case in file.CASES.items()}


def reference(name):
    with np.load(BASELINE / f"{name}.npz") as stored:  # regression baselines are the one kind of stored result here
        return {key: stored[key] for key in stored.files}


def draw(name):
    """The figure of a case from its reference data, without gaps in contours: they are as wide as the labels."""
    with mock.patch.object(Axes, "clabel"):
        return CASES[name].draw(reference(name))


def cells(image):
    """Colours (rows, columns, 3) of the cells of a map, the first row on top, in 0 to 255.

    Versions differ in which pixels a cell fills: the map is taken out of its figure, and squares in the colours of some
    of the cells, at their middles, take its place.
    """
    colours = image.to_rgba(image.get_array())[..., :3]
    rows, columns, _ = colours.shape
    left, right, bottom, top = image.get_extent()
    first, last = (top, bottom) if image.origin == "upper" else (bottom, top)
    x = left + (np.arange(columns) + 0.5) / columns * (right - left)
    y = first + (np.arange(rows) + 0.5) / rows * (last - first)
    some = np.ix_(np.arange(0, rows, -(-rows // 12)), np.arange(0, columns, -(-columns // 12)))
    x, y = np.meshgrid(x, y)
    limits = image.axes.get_xlim(), image.axes.get_ylim()
    image.axes.scatter(x[some], y[some], 9, colours[some].reshape(-1, 3), marker="s", zorder=image.get_zorder())
    image.axes.set(xlim=limits[0], ylim=limits[1])
    image.remove()
    colours = colours if image.origin == "upper" else colours[::-1]
    return np.round(255 * colours)


def below(picture, map_colours):
    """The picture and under it the cells of a map, each four pixels by four."""
    block = np.kron(map_colours, np.ones((4, 4, 1)))
    width = max(picture.shape[1], block.shape[1])
    parts = (
        np.pad(part, ((0, 0), (0, width - part.shape[1]), (0, 0)), constant_values=255) for part in (picture, block)
    )
    return np.concatenate(list(parts))


def picture(fig):
    """The figure's pixels (height, width, 3) in 0 to 255, without text, axes at fixed places, cells on whole pixels."""
    with matplotlib.style.context(STYLE):  # some settings count when a figure is saved only
        return _picture(fig)


def _picture(fig):
    fig.set_layout_engine("none")
    maps = [cells(image) for axes in fig.axes for image in list(axes.images)]
    for legend in fig.findobj(Legend):
        legend.remove()
    for number, axes in enumerate(fig.axes):
        width = 0.9 / len(fig.axes)
        axes.set_position([0.05 + number * width, 0.05, 0.9 * width, 0.9])
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(NullFormatter())
    for text in fig.findobj(Text):
        text.set_visible(False)
    buffer = io.BytesIO()
    fig.savefig(buffer, format="png", dpi=60, facecolor="white", transparent=False)
    buffer.seek(0)
    return reduce(below, maps, 255 * matplotlib.image.imread(buffer)[..., :3])


@pytest.fixture
def regenerate(request):
    return request.config.getoption("--regenerate")


@pytest.mark.parametrize("name", CASES)
def test_data_behind_the_figure_are_the_reference_data(name, regenerate):
    case = CASES[name]
    data = case.compute()
    if regenerate:
        np.savez_compressed(BASELINE / f"{name}.npz", **data)
    expected = reference(name)
    assert data.keys() == expected.keys()
    case.compare(data, expected)


@pytest.mark.parametrize("name", CASES)
def test_picture_drawn_from_the_reference_data_is_the_reference_picture(name, regenerate):
    pixels = picture(draw(name))
    path = BASELINE / f"{name}.png"
    if regenerate:
        matplotlib.image.imsave(path, pixels / 255)
    expected = 255 * matplotlib.image.imread(path)[..., :3]
    assert pixels.shape == expected.shape
    # 0.00 over several versions of Matplotlib; another colour of one thin line gives more than 2.
    assert np.sqrt(np.mean((pixels - expected) ** 2)) < 0.5


def test_every_figure_of_the_paper_has_its_case():
    assert set(CASES) >= {f"fig{n}" for n in ("1a", "1b", "2", "3a", "3b", "4a", "4b", "5a", "5b", "6a", "6b")}


def figure_functions():
    """Names of the functions that draw a figure, those that @styled marks, in the modules of figures."""
    for path in sorted(Path(figures.__file__).parent.glob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef) and any(ast.unparse(mark) == "styled" for mark in node.decorator_list):
                yield f"{path.stem}.{node.name}"


@pytest.mark.parametrize("function", list(figure_functions()))
def test_every_figure_function_is_drawn_by_a_case(function):
    case = Path(cases.__path__[0], function.partition(".")[0]).with_suffix(".py")
    calls = [node for node in ast.walk(ast.parse(case.read_text(encoding="utf-8"))) if isinstance(node, ast.Call)]
    drawn = {ast.unparse(call.func).replace("figures.", f"{case.stem}.") for call in calls}
    assert function in drawn


def test_no_two_cases_bear_one_name():
    assert len(CASES) == sum(len(file.CASES) for file in FILES)


# Pictures are compared without text: the words, and which curve each word belongs to, are compared here.
PATHS = {
    "path before $t = 1200$": figures.TRANSIENT,
    "stroboscopic points before": figures.BLUE,
    "path after $t = 1200$": figures.STEADY,
    "stroboscopic points after": figures.BLACK,
}
PARTS = {"before $t = 15$": figures.TRANSIENT, "after $t = 15$": figures.STEADY}
X, V, T = "displacement $x$ (dimensionless)", "velocity $v$ (dimensionless)", "time $t$ (dimensionless)"
TEXTS = {
    "fig5a": (X, V, {label: colour for label, colour in PATHS.items() if "after" in label}),
    "fig5b": (X, V, PATHS),
    "fig6a": (T, X, PARTS),
    "fig6b": (T, X, PARTS),
}


@pytest.mark.parametrize("name", TEXTS)
def test_the_words_of_a_figure_of_the_motion_stand_at_their_curves(name):
    fig = CASES[name].draw(reference(name))
    (axes,) = fig.axes
    (legend,) = fig.legends
    colours = {text.get_text(): line.get_color() for text, line in zip(legend.texts, legend.get_lines(), strict=True)}
    assert (axes.get_xlabel(), axes.get_ylabel(), colours) == TEXTS[name]


def test_a_figure_shows_itself_as_the_same_svg_and_png_each_time():
    first, second = (CASES["fig1b"].draw(reference("fig1b")) for _ in range(2))
    data, _ = first._repr_mimebundle_()
    assert data["image/svg+xml"].startswith("<?xml") and data["image/png"].startswith(b"\x89PNG")
    assert data["image/svg+xml"] == second._repr_mimebundle_()[0]["image/svg+xml"]


def test_figures_do_not_touch_the_callers_settings():
    before = dict(matplotlib.rcParams)
    CASES["fig1a"].draw(reference("fig1a"))
    assert dict(matplotlib.rcParams) == before
