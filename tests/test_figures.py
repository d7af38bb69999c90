"""Regression of the paper's figures on two levels: the data behind each, and the picture drawn from reference data.

A picture is compared without its text, with its axes in fixed places: what is left does not depend on the version of
Matplotlib or FreeType, and still shows every line, marker and colour. `make baselines` writes both anew.
"""

import io
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from figure_cases import CASES
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.ticker import NullFormatter

BASELINE = Path(__file__).with_name("baseline")


def reference(name):
    with np.load(BASELINE / f"{name}.npz") as stored:  # regression baselines are the one kind of stored result here
        return {key: stored[key] for key in stored.files}


def picture(fig):
    """The figure's pixels (height, width, 3) in 0 to 255, without text, axes at fixed places."""
    fig.set_layout_engine("none")
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
    return 255 * matplotlib.image.imread(buffer)[..., :3]


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
    pixels = picture(CASES[name].draw(reference(name)))
    path = BASELINE / f"{name}.png"
    if regenerate:
        matplotlib.image.imsave(path, pixels / 255)
    expected = 255 * matplotlib.image.imread(path)[..., :3]
    assert pixels.shape == expected.shape
    # 0.00 over several versions of Matplotlib; another colour of one thin line gives more than 2.
    assert np.sqrt(np.mean((pixels - expected) ** 2)) < 0.5


def test_every_figure_of_the_paper_has_its_case():
    assert set(CASES) == {f"fig{n}" for n in ("1a", "1b", "2", "3a", "3b", "4a", "4b", "5a", "5b", "6a", "6b")}


def test_a_figure_shows_itself_as_the_same_svg_and_png_each_time():
    first, second = (CASES["fig1b"].draw(reference("fig1b")) for _ in range(2))
    data, _ = first._repr_mimebundle_()
    assert data["image/svg+xml"].startswith("<?xml") and data["image/png"].startswith(b"\x89PNG")
    assert data["image/svg+xml"] == second._repr_mimebundle_()[0]["image/svg+xml"]


def test_figures_do_not_touch_the_callers_settings():
    before = dict(matplotlib.rcParams)
    CASES["fig1a"].draw(reference("fig1a"))
    assert dict(matplotlib.rcParams) == before
