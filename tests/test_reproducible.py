"""The comparison of two runs of the book: what it must find."""

import os
import sys
from pathlib import Path
from unittest import mock

import nbformat.v4 as v4
import pytest

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "tools"))

import reproducible  # noqa: E402 - its folder is put on the path above


def notebook(number="0.1", picture="<svg/>", printed="one\n", glued="1.5", name="w"):
    shown = v4.new_output("display_data", {"text/plain": number, "image/svg+xml": picture})
    value = v4.new_output("display_data", {"text/plain": glued}, metadata={"scrapbook": {"name": name}})
    cell = v4.new_code_cell("x", outputs=[shown, v4.new_output("stream", text=printed), value])
    return v4.new_notebook(cells=[v4.new_markdown_cell("prose"), cell])


def compare(first, second, **options):
    return list(reproducible.differences(*(reproducible.outputs("chapters/x", n) for n in (first, second)), **options))


def test_two_equal_runs_do_not_differ():
    assert compare(notebook(), notebook()) == []
    assert len(reproducible.outputs("chapters/x", notebook())) == 6


@pytest.mark.parametrize(
    ("changed", "place"),
    [
        ({"number": "0.10000000000000001"}, "chapters/x, cell 1, output 0, text/plain: '0.1' and"),
        ({"picture": "<svg />"}, "chapters/x, cell 1, output 0, image/svg+xml"),
        ({"printed": "two\n"}, "chapters/x, cell 1, output 1, text"),
        ({"glued": "1.6"}, "chapters/x, glued w, text/plain"),
    ],
)
def test_one_changed_output_is_found_and_named(changed, place):
    (line,) = compare(notebook(), notebook(**changed))
    assert line.startswith(place)


def test_an_output_of_one_run_only_is_found():
    short = notebook()
    short.cells[1].outputs.pop()
    assert [line.endswith("in one run only") for line in compare(notebook(), short)] == [True, True]


def test_what_tells_of_the_clock_is_left_out_by_its_name_alone():
    runs = notebook(glued="1", name="seconds"), notebook(glued="2", name="seconds")
    assert len(compare(*runs)) == 1
    assert compare(*runs, left_out=("seconds",)) == []
    assert len(compare(*runs, left_out=("second", "chapters"))) == 1
    assert compare(*runs, left_out=("chapters/x",)) == []


def test_every_chapter_with_cells_is_compared():
    found = reproducible.chapters()
    assert "chapters/melnikov" in found and "chapters/references" not in found
    assert set(reproducible.LEFT_OUT) <= {*found}


def test_a_kernel_is_told_how_many_processors_it_has(tmp_path, monkeypatch):
    (tmp_path / "chapters").mkdir()
    front = "---\njupytext: {text_representation: {extension: .md, format_name: myst}}\n"
    front += "kernelspec: {name: python3, display_name: Python 3, language: python}\n---\n"
    cell = "from vectorized import processors\nprocessors.available()"
    (tmp_path / "chapters" / "x.md").write_text(f"{front}\n```{{code-cell}} ipython3\n{cell}\n```\n", encoding="utf-8")
    for package in ("duffing", "vectorized"):
        (tmp_path / package).symlink_to(ROOT / package)
    monkeypatch.setattr(reproducible, "ROOT", tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    with mock.patch.dict(os.environ):  # put back after the test, which changes it
        for threads in (1, 3):
            (shown,) = reproducible.run("chapters/x", threads, tmp_path).cells[-1].outputs
            assert shown["data"]["text/plain"] == str(threads)


def test_a_run_is_compared_with_the_hashes_of_an_earlier_one(tmp_path, monkeypatch):
    monkeypatch.setattr(reproducible, "KEPT", tmp_path / "_build" / "outputs.json")
    monkeypatch.setattr(reproducible, "run", lambda *_: notebook())
    with pytest.raises(SystemExit, match="run with --save first"):
        reproducible.main(["--against", "chapters/x"])
    reproducible.main(["--save", "chapters/x"])
    reproducible.main(["--against", "chapters/x"])
    monkeypatch.setattr(reproducible, "run", lambda *_: notebook(glued="1.6"))
    reproducible.main(["chapters/x"])
    with pytest.raises(SystemExit, match=r"1 of 6 outputs"):
        reproducible.main(["--against", "chapters/x"])
