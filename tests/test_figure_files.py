"""Figures as files: the data in a figure's table are those it draws, and the book offers each under a stable name."""

import csv
import os
import subprocess
import sys
from pathlib import Path

import nbformat
import numpy as np
import pytest

from book.figures.style import PageFigure, styled

BOOK = Path(__file__).parents[1]
sys.path.append(str(BOOK / "book" / "sphinx"))

import figure_files  # noqa: E402 - its folder is put on the path above


def drawn(draw, rows=1, columns=1):
    """The table of a figure: its remarks, and dict (panel, series) -> (x, y, value) columns of text."""

    @styled
    def figure():
        fig = PageFigure()
        draw(fig.subplots(rows, columns, sharey=True))
        return fig

    lines = figure().table().splitlines()
    table = {}
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        table.setdefault((row["panel"], row["series"]), []).append((row["x"], row["y"], row["value"]))
    return [line for line in lines if line.startswith("#")], table


def test_a_curve_is_written_point_by_point_under_its_label_and_a_gap_stays_empty():
    _, table = drawn(lambda axes: axes.plot([0.5, 1, 2], [3, np.nan, 1 / 3], label='the "curve", in words'))
    assert table == {("1", "the 'curve', in words"): [("0.5", "3", ""), ("1", "", ""), ("2", "0.3333333333", "")]}


def test_a_line_over_the_whole_panel_has_the_panels_own_ends():
    def draw(axes):
        axes.set(xlim=(2, 4), ylim=(-1, 1))
        axes.axhline(0.1, label="threshold")
        axes.axvline(3)

    _, table = drawn(draw)
    assert table["1", "threshold"] == [("2", "0.1", ""), ("4", "0.1", "")]
    assert table["1", "series 2"] == [("3", "-1", ""), ("3", "1", "")]


def test_panels_are_numbered_and_a_shared_axis_keeps_its_label():
    def draw(panels):
        for axes, label in zip(panels, ("a", "b"), strict=True):
            axes.plot([1], [2], label=label)
            axes.set(title=f"case {label}", xlabel="time")
        panels[0].set_ylabel("height")

    remarks, table = drawn(draw, columns=2)
    assert remarks == ["# panel 1 (case a): x = time, y = height", "# panel 2 (case b): x = time, y = height"]
    assert list(table) == [("1", "a"), ("2", "b")]


@pytest.mark.parametrize("origin", ["lower", "upper"])
def test_a_map_is_written_cell_by_cell_at_the_centres(origin):
    value = np.array([[1, 2, 3], [4, 5, 6]])
    _, table = drawn(lambda axes: axes.imshow(value, extent=(0, 3, 0, 2), origin=origin))
    low, high = ("4", "1") if origin == "upper" else ("1", "4")
    (cells,) = table.values()
    assert ("0.5", "0.5", low) in cells and ("0.5", "1.5", high) in cells and len(cells) == 6


def test_the_cells_of_a_mesh_are_written_as_those_of_a_picture_are():
    _, table = drawn(lambda axes: axes.pcolormesh([0, 1, 2, 3], [0, 1, 2], [[1, 2, 3], [4, 5, 6]]))
    (cells,) = table.values()
    assert cells[0] == ("0.5", "0.5", "1") and cells[-1] == ("2.5", "1.5", "6") and len(cells) == 6


def test_a_contour_carries_its_level():
    x = np.linspace(0, 1, 5)
    _, table = drawn(lambda axes: axes.contour(x, x, np.add.outer(0 * x, x), levels=[0.25, 0.6]))
    assert {(x, level) for points in table.values() for x, _, level in points} == {("0.25", "0.25"), ("0.6", "0.6")}


def test_scattered_dots_carry_their_values_and_bars_of_error_the_label_of_their_curve():
    def draw(axes):
        axes.scatter([1, 2], [3, 4], c=[5, 6], label="dots")
        axes.errorbar([1, 2], [3, 4], yerr=[0.5, 1], label="measured")

    _, table = drawn(draw)
    assert table["1", "dots"] == [("1", "3", "5"), ("2", "4", "6")]
    bars = [("1", "2.5", ""), ("1", "3.5", ""), ("2", "3", ""), ("2", "5", "")]
    assert table["1", "measured"] == [("1", "3", ""), ("2", "4", ""), *bars]


def test_bars_are_written_by_their_ends_and_their_names():
    def draw(axes):
        axes.barh([1, 2], [3, 4], left=1, height=0.5, label="bars")
        axes.set_yticks([1, 2], ["hare", "tortoise"])

    remarks, table = drawn(draw)
    assert table["1", "bars"] == [("4", "1", ""), ("5", "2", "")]
    assert remarks[-1] == "# panel 1, y: 1 = hare, 2 = tortoise"


@pytest.mark.parametrize(
    ("label", "stem"),
    [("fig-4a", "fig4a"), ("fig-2", "fig2"), ("fig-splitting", "fig-splitting"), ("fig-2x2", "fig-2x2")],
)
def test_a_figure_of_the_paper_is_called_by_its_number_and_others_by_their_label(label, stem):
    assert figure_files.stem(label) == stem


PAGE = """---
file_format: mystnb
kernelspec: {name: python3, display_name: Python 3, language: python}
---
# Book

```{code-cell} python
---
mystnb:
  figure: {name: fig-4a, caption: A line that rises.}
  image: {alt: a straight line from the lower left to the upper right}
---
from book.figures.paper import fig1a
fig1a([0.0, 1.0], [0.0, 2.0])
```
"""
CONF = f"""
import sys
sys.path.append({str(BOOK / "book" / "sphinx")!r})
extensions = ["myst_nb", "downloads", "figure_files"]
html_theme = "basic"
exclude_patterns = ["_build"]
nb_execution_mode = "cache"
nb_execution_cache_path = "_build/cache"
"""


def test_a_figure_is_offered_under_its_number_with_its_data_the_same_bytes_from_the_cache(tmp_path):
    (tmp_path / "part").mkdir()
    (tmp_path / "conf.py").write_text(CONF, encoding="utf-8")
    (tmp_path / "index.md").write_text("# Front\n\n```{toctree}\npart/page\n```\n", encoding="utf-8")
    (tmp_path / "part" / "page.md").write_text(PAGE, encoding="utf-8")
    environment = os.environ | {"IPYTHONDIR": str(tmp_path / "ipython"), "PYTHONPATH": str(BOOK)}
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "-E", "-b", "html", ".", "_build/html"]
    figures = tmp_path / "_build" / "html" / "figures"
    seen = []
    for _ in range(2):
        subprocess.run(command, cwd=tmp_path, env=environment, check=True)
        seen.append({path.name: path.read_bytes() for path in figures.iterdir()})
        (figures / "fig9.svg").write_text("left by an earlier book", encoding="utf-8")
    assert seen[0] == seen[1]
    assert set(seen[0]) == {"fig4a.svg", "fig4a.png", "fig4a.csv"}
    assert seen[0]["fig4a.csv"].decode().splitlines()[-1] == '1,"series 2",1,2,'
    assert seen[0]["fig4a.png"].startswith(b"\x89PNG")
    page = (tmp_path / "_build" / "html" / "part" / "page.html").read_text(encoding="utf-8")
    for name in seen[0]:
        assert f'href="../figures/{name}"' in page
    notebook = nbformat.read(tmp_path / "_build" / "jupyter_execute" / "part" / "page.ipynb", as_version=4)
    assert figure_files.outputs(notebook)["fig-4a"]["svg"] == seen[0]["fig4a.svg"]


def test_a_large_map_takes_a_line_for_each_of_its_rows():
    fig = PageFigure()
    values = np.arange(80 * 100).reshape(80, 100) % 7
    fig.subplots().imshow(values, origin="lower", extent=(0, 100, 0, 80))
    rows = list(csv.DictReader(line for line in fig.table().splitlines() if not line.startswith("#")))
    assert len(rows) == 80
    assert (rows[1]["x"], rows[1]["y"]) == ("0.5 to 99.5, 100 equally spaced", "1.5")
    assert [int(number) for number in rows[1]["value"].split()] == values[1].tolist()
