"""What a reader sees of the code is physics: imports, glue, tables and repacking are a tenth of it at most.

`python tests/test_prose.py` lists the lines that count as plumbing, chapter by chapter.
"""

import ast
import re
from pathlib import Path
from typing import NamedTuple

import jupytext
import pytest
import yaml

BOOK = Path(__file__).parents[1]
TOC = yaml.safe_load((BOOK / "_toc.yml").read_text(encoding="utf-8"))
CHAPTERS = [TOC["root"], *(page["file"] for part in TOC["parts"] for page in part["chapters"])]
HIDDEN = {"remove-input", "remove-cell", "hide-input", "hide-cell"}
MOST = 0.10  # plumbing, of the visible lines of the book
GLUE = {"values", "glue", "table", "tables.table"}  # what hands a value to the prose
# Calls that only change how values are held: a statement that calls nothing else repacks.
REPACKING = {
    "dict", "zip", "list", "tuple", "set", "enumerate", "float", "int", "str", "sorted", "len", "round", "range", "map",
    "np.array", "np.concatenate", "np.stack", "np.append", "np.reshape", "np.transpose",
}  # fmt: skip
METHODS = {"items", "values", "keys", "join", "format", "append", "extend", "ravel", "reshape", "setdefault", "tolist"}


class Count(NamedTuple):
    """visible: lines that are not empty in cells shown; plumbing: those of them that compute nothing."""

    visible: int
    plumbing: int


def shown(chapter):
    """Sources of the visible cells."""
    notebook = jupytext.reads((BOOK / f"{chapter}.md").read_text(encoding="utf-8"), "md:myst")
    cells = (cell for cell in notebook.cells if cell.cell_type == "code")
    return [cell.source for cell in cells if not HIDDEN & set(cell.metadata.get("tags", []))]


def calls(statement):
    """The names, as written, of what a statement calls."""
    for node in ast.walk(statement):
        if isinstance(node, ast.Call):
            yield ast.unparse(node.func)


def is_plumbing(statement):
    """Whether a top-level statement of a cell imports, glues, tabulates, or only repacks what is there.

    A loop is plumbing if all of its statements are; so is a list, dictionary or comprehension that calls nothing but
    what repacks. Arithmetic, symbols, assertions and figures are not.
    """
    if isinstance(statement, ast.Import | ast.ImportFrom):
        return True
    names = list(calls(statement))
    if any(name in GLUE for name in names):
        return True
    if isinstance(statement, ast.For):
        return all(is_plumbing(one) for one in statement.body)
    value = getattr(statement, "value", None)
    if not isinstance(statement, ast.Assign | ast.AugAssign | ast.Expr) or value is None:
        return False
    if any(name not in REPACKING and name.rpartition(".")[2] not in METHODS for name in names):
        return False
    packs = (ast.Dict, ast.DictComp, ast.ListComp, ast.SetComp, ast.GeneratorExp)
    repacked = any(name in REPACKING - {"float", "int", "np.array", "len", "round"} for name in names)
    repacked |= any(name.endswith((".append", ".extend")) for name in names)
    return repacked or any(isinstance(node, packs) for node in ast.walk(value))


def lines_of(source, statement):
    """Its lines that are not empty."""
    lines = source.splitlines()[statement.lineno - 1 : statement.end_lineno]
    return [line for line in lines if line.strip()]


def plumbing(source):
    """Lines of a cell that are plumbing."""
    statements = ast.parse(source).body
    return [line for one in statements if is_plumbing(one) for line in lines_of(source, one)]


def count(chapter):
    sources = shown(chapter)
    visible = sum(bool(line.strip()) for source in sources for line in source.splitlines())
    return Count(visible, sum(len(plumbing(source)) for source in sources))


@pytest.mark.parametrize(
    ("source", "lines"),
    [
        ("import numpy as np", 1),
        ("values(a=1,\n    b=2)", 2),
        ('rows = [[f"{a:g}"] for a in mu]', 1),
        ("at = dict(zip(mu, zip(folds, crises)))", 1),
        ("joined = [np.concatenate(parts, axis=-1) for parts in zip(*curves)]", 1),
        ("for p in exponents:\n    rows.append([p, where[p]])", 2),
        ('glue("a", float(x), display=False)\ny = critical_amplitude(osc)', 1),
        ("mu_c = critical_amplitude(osc)", 0),
        ("curves = {p: study.branches(p) for p in (0.1, 1.0)}", 0),
        ("ratio = onset / line", 0),
        ("Y = v**p", 0),
        ("exponents = np.array([0.1, 1.0])", 0),
        ("assert a == b", 0),
        ("figures.fig3a(omega, p, ratio)", 0),
    ],
)
def test_plumbing_is_told_from_physics(source, lines):
    assert len(plumbing(source)) == lines


def test_at_most_a_tenth_of_the_visible_lines_is_plumbing():
    counts = {chapter: count(chapter) for chapter in CHAPTERS}
    visible, pipes = (sum(one[k] for one in counts.values()) for k in (0, 1))
    worst = sorted(counts.items(), key=lambda item: -item[1].plumbing)[:8]
    assert pipes <= MOST * visible, f"{pipes} of {visible} lines; most in {[(name, *one) for name, one in worst]}"


# Typed text that the typesetter does not see: it works on glued values and tables only.
TYPED = {
    "a number with e": re.compile(r"(?<![\w.`/])\d(?:\.\d+)?e[+-]?\d+\b"),
    "a type of NumPy's": re.compile(r"np\.(?:float|int)\d"),
    "a hyphen for a minus": re.compile(r"(?:(?<=\s)|(?<=\())-\d"),
    "an error of zero": re.compile(r"(?:±|\\pm)\s*0\.0+(?!\d)"),
}


def typed(chapter):
    """The prose of a chapter without cells, code, mathematics, roles and links."""
    text = (BOOK / f"{chapter}.md").read_text(encoding="utf-8").split("\n---\n", 1)[-1]
    for pattern in (r"^(`{3,})\{?.*?^\1$", r"\$\$.*?\$\$(?: \([\w-]+\))?"):
        text = re.sub(pattern, "", text, flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"\{[\w:]+\}`[^`]*`|`[^`]*`|\$[^$]*\$|\]\([^)]*\)", " ", text)


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_numbers_typed_in_prose_are_typeset(chapter):
    text = typed(chapter)
    found = [
        (what, text[max(0, match.start() - 30) : match.end() + 10].replace("\n", " "))
        for what, pattern in TYPED.items()
        for match in pattern.finditer(text)
    ]
    assert found == []


if __name__ == "__main__":
    for name in CHAPTERS:
        print(name, *count(name))
        for cell in shown(name):
            print(*(f"    {line}" for line in plumbing(cell)), sep="\n") if plumbing(cell) else None
