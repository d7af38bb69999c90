"""The solutions of the exercises: every cell runs, with its assertions, and no list of exercises is without them."""

import ast
import re
from pathlib import Path

import jupytext
import pytest

CHAPTERS = Path(__file__).parents[1] / "chapters"
SOLUTIONS = CHAPTERS / "solutions"
PAGES = sorted(path.stem for path in SOLUTIONS.glob("*.md"))
WITH_EXERCISES = sorted(
    path.stem
    for path in CHAPTERS.glob("*.md")
    if re.search(r"^#+ Exercises$", path.read_text(encoding="utf-8"), re.MULTILINE)
)


def cells(page):
    notebook = jupytext.read(SOLUTIONS / f"{page}.md")
    return [cell.source for cell in notebook.cells if cell.cell_type == "code"]


def exercises(chapter):
    """The numbers of a chapter's exercises."""
    text = (CHAPTERS / f"{chapter}.md").read_text(encoding="utf-8")
    listed = re.split(r"^#+ Exercises$", text, flags=re.MULTILINE)[1]
    return re.findall(r"^(\d+)\. ", re.split(r"^#", listed, flags=re.MULTILINE)[0], flags=re.MULTILINE)


@pytest.mark.parametrize("page", PAGES)
def test_the_cells_of_a_solution_run_and_their_assertions_hold(page, monkeypatch):
    """What a cell shows is mathematics; other values are glued into sentences and tables, where they are typeset."""
    monkeypatch.chdir(CHAPTERS)  # where the book runs them
    namespace = {"__name__": "solution"}
    for source in cells(page):
        tree = ast.parse(source)
        last = [tree.body.pop().value] if isinstance(tree.body[-1], ast.Expr) else []
        exec(compile(tree, f"solutions/{page}", "exec"), namespace)
        for expression in last:
            shown = eval(compile(ast.Expression(expression), f"solutions/{page}", "eval"), namespace)
            assert shown is None or hasattr(shown, "_repr_latex_"), f"{shown!r} is not typeset: glue it into a sentence"


@pytest.mark.parametrize("page", PAGES)
def test_a_solution_asserts_something(page):
    assert any(re.search(r"^assert ", source, re.MULTILINE) for source in cells(page))


@pytest.mark.parametrize("chapter", WITH_EXERCISES)
def test_every_exercise_of_a_chapter_has_a_solution_and_a_grade_and_the_chapter_leads_there(chapter):
    assert chapter in PAGES
    text = (CHAPTERS / f"{chapter}.md").read_text(encoding="utf-8")
    assert f"](solutions/{chapter}.md)" in text
    solved = re.findall(r"^## (\d+)\. ", (SOLUTIONS / f"{chapter}.md").read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert exercises(chapter) == solved != []
    assert len(re.findall(r"^\d+\. \((?:\\\*){1,3}\) ", text, flags=re.MULTILINE)) == len(solved)


def test_every_page_of_solutions_belongs_to_a_chapter():
    assert set(PAGES) <= set(WITH_EXERCISES)
