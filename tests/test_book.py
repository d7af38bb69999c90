"""The book: what its chapters promise, and the local Sphinx extensions that it is built with."""

import ast
import hashlib
import os
import re
import subprocess
import sys
import textwrap
from collections import Counter
from pathlib import Path

import jupytext
import pytest
import yaml

BOOK = Path(__file__).parents[1]
CONFIG = yaml.safe_load((BOOK / "_config.yml").read_text(encoding="utf-8"))
TOC = yaml.safe_load((BOOK / "_toc.yml").read_text(encoding="utf-8"))
CHAPTERS = [TOC["root"], *(chapter["file"] for part in TOC["parts"] for chapter in part["chapters"])]
CITATION = re.compile(r"`tests/(test_\w+\.py)::(test_\w+)`")
sys.path.append(str(BOOK / "book" / "sphinx"))

import cache_key  # noqa: E402 - its folder is put on the path above
import fingerprint  # noqa: E402 - as above
import offline_mathjax  # noqa: E402 - as above
import paper_numbers  # noqa: E402 - as above

each_chapter = pytest.mark.parametrize("chapter", CHAPTERS)


def text_of(chapter):
    return (BOOK / f"{chapter}.md").read_text(encoding="utf-8")


def cells(chapter):
    """(source, metadata) of every code cell."""
    notebook = jupytext.reads(text_of(chapter), "md:myst")
    return [(cell.source, cell.metadata) for cell in notebook.cells if cell.cell_type == "code"]


def sections(chapter):
    """The prose of a chapter, code cells left out, cut at its headings."""
    prose = re.sub(r"^```\{code-cell\}.*?^```$", "", text_of(chapter), flags=re.DOTALL | re.MULTILINE)
    return re.split(r"^#+ ", prose, flags=re.MULTILINE)


def is_figure(source):
    """The cell ends with a call of a function of `figures`, each of which is named after its figure."""
    last = ast.parse(source).body[-1]
    call = last.value if isinstance(last, ast.Expr) else None
    return isinstance(call, ast.Call) and re.match(r"figures\.|fig", ast.unparse(call.func)) is not None


@each_chapter
def test_a_chapter_of_the_table_of_contents_is_a_notebook_that_jupytext_need_not_rewrite(chapter):
    text = text_of(chapter)
    if "{code-cell}" not in text:
        return
    front_matter = text.split("\n---\n")[0]
    assert "jupytext:" in front_matter and "kernelspec:" in front_matter
    assert front_matter == jupytext.writes(jupytext.reads(text, "md:myst"), "md:myst").split("\n---\n")[0]


def test_every_chapter_stands_in_the_table_of_contents():
    assert {f"chapters/{path.stem}" for path in (BOOK / "chapters").glob("*.md")} == set(CHAPTERS)


@each_chapter
def test_a_cell_defines_nothing_and_is_short(chapter):
    for source, _ in cells(chapter):
        kinds = {type(node) for node in ast.walk(ast.parse(source))}
        assert not kinds & {ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef}, source
        assert len(source.splitlines()) <= 12, source


@each_chapter
def test_a_figure_has_a_name_a_caption_and_an_alternative_text(chapter):
    for source, metadata in cells(chapter):
        shown = metadata.get("mystnb", {})
        if is_figure(source) or "figure" in shown or "image" in shown:
            assert shown["figure"]["name"].startswith("fig-"), source
            assert len(shown["figure"]["caption"]) > 20, source
            assert len(shown["image"]["alt"]) > 20, source


@each_chapter
def test_a_cited_test_exists(chapter):
    for file, name in re.findall(r"(tests/\w+\.py)(?:::(\w+))?", text_of(chapter)):
        tree = ast.parse((BOOK / file).read_text(encoding="utf-8"))
        assert name in {"", *(node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))}, file


@pytest.mark.parametrize("number", range(1, CONFIG["sphinx"]["config"]["paper_equations"] + 1))
def test_an_equation_of_the_paper_stands_once_and_is_followed_by_the_test_that_checks_it(number):
    label = re.compile(rf"^(?::label: eq-{number}|\$\$ \(eq-{number}\))$", flags=re.MULTILINE)
    found = [section for chapter in CHAPTERS for section in sections(chapter) if label.search(section)]
    assert len(found) == 1
    _, *after = label.split(found[0])
    assert len(after) == 1
    assert CITATION.search(after[0])


def test_every_figure_of_the_paper_stands_once():
    names = [cell.get("mystnb", {}).get("figure", {}).get("name") for page in CHAPTERS for _, cell in cells(page)]
    used = Counter(name.removeprefix("fig-") for name in names if name and re.match(r"fig-\d", name))
    assert not list(paper_numbers.complaints("figure", used, CONFIG["sphinx"]["config"]["paper_figures"]))


@pytest.mark.parametrize(
    ("used", "complaint"),
    [
        ({"1": 1, "2": 1}, None),
        ({"1": 1, "2": 1, "E1": 1}, None),
        ({"1": 1}, "figure 2 of the paper is missing"),
        ({"1": 1, "2": 2}, "figure 2 of the paper is numbered 2 times"),
        ({"1": 1, "2": 1, "3": 1}, "figure 3 does not exist in the paper"),
    ],
)
def test_a_number_missing_used_twice_or_unknown_to_the_paper_is_named(used, complaint):
    assert list(paper_numbers.complaints("figure", used, ["1", "2"])) == ([complaint] if complaint else [])


def test_a_figure_stands_for_its_panels_but_not_beside_them():
    assert not list(paper_numbers.complaints("figure", {"3": 1}, ["3a", "3b"]))
    assert not list(paper_numbers.complaints("figure", {"3a": 1, "3b": 1}, ["3a", "3b"]))
    assert list(paper_numbers.complaints("figure", {"3a": 1}, ["3a", "3b"])) == ["figure 3b of the paper is missing"]
    assert list(paper_numbers.complaints("figure", {"3": 1, "3a": 1}, ["3a", "3b"])) == [
        "figure 3 and its panel 3a are both numbered"
    ]


def sphinx_build(source, pages, config):
    """Build a small book of reStructuredText pages; returns its HTML (page -> text), exit code and complaints."""
    source.mkdir(exist_ok=True)
    head = f"import sys\nsys.path.append({str(BOOK / 'book' / 'sphinx')!r})\nnumfig = True\nnumfig_secnum_depth = 0\n"
    (source / "conf.py").write_text(head + textwrap.dedent(config), encoding="utf-8")
    for name, text in pages.items():
        (source / f"{name}.rst").write_text(textwrap.dedent(text), encoding="utf-8")
    command = [sys.executable, "-m", "sphinx", "-b", "html", "-W", "-n", "--keep-going", source, source / "html"]
    run = subprocess.run(command, capture_output=True, text=True, encoding="utf-8")
    return (
        {path.stem: path.read_text(encoding="utf-8") for path in (source / "html").glob("*.html")},
        run.returncode,
        run.stderr,
    )


INDEX = """
    Book
    ====
    .. toctree::

       second

    .. math:: a
       :label: eq-own

    .. math:: b
       :label: eq-2

    See :eq:`eq-1`, :eq:`eq-own`, :numref:`fig-1b`.
"""
SECOND = """
    Second
    ======
    .. math:: c
       :label: eq-1

    .. figure:: {image}
       :name: fig-1b
       :alt: a picture

       Right panel.

    .. figure:: {image}
       :name: fig-1a
       :alt: a picture

       Left panel. See :eq:`eq-2`, :numref:`Fig. {{number}} <fig-1a>`.
"""
NUMBERED = """
    extensions = ["paper_numbers"]
    html_theme = "basic"
    numfig_format = {"figure": "Fig. %s"}
    paper_equations = 2
    paper_figures = ["1a", "1b"]
"""


@pytest.fixture
def picture(tmp_path):
    (tmp_path / "book").mkdir()
    (tmp_path / "book" / "dot.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1"/>', encoding="utf-8"
    )
    return "dot.svg"


def plain(html):
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", html))


def test_equations_and_figures_carry_the_numbers_in_their_labels_on_every_page(tmp_path, picture):
    html, code, complaints = sphinx_build(
        tmp_path / "book", {"index": INDEX, "second": SECOND.format(image=picture)}, NUMBERED
    )
    assert (code, complaints) == (0, "")
    assert "See (1), (E1), Fig. 1b." in plain(html["index"])
    assert "Fig. 1a Left panel. See (2), Fig. 1a." in plain(html["second"])
    assert "Fig. 1b Right panel." in plain(html["second"])


def test_a_gap_or_a_duplicate_in_the_numbers_fails_the_build(tmp_path, picture):
    twice = SECOND.format(image=picture).replace("eq-1", "eq-2").replace("fig-1a", "fig-7")
    _, code, complaints = sphinx_build(
        tmp_path / "book", {"index": INDEX.replace("eq-1", "eq-2"), "second": twice}, NUMBERED
    )
    assert code != 0
    for complaint in (
        "equation 1 of the paper is missing",
        "equation 2 of the paper is numbered 2 times",
        "figure 1a of the paper is missing",
        "figure 7 does not exist in the paper",
    ):
        assert complaint in complaints


REBUILDS = """
import re
from pathlib import Path
from sphinx.cmd.build import main

page = Path("index.md")
edits = [
    lambda: None,
    lambda: page.write_text(page.read_text().replace("Prose", "Other prose").replace("a curve", "two curves")),
    lambda: Path("second.md").write_text(Path("second.md").read_text().replace("import time", "import time  # now")),
    lambda: Path("duffing/model.py").write_text("x = 2"),
]
for edit in edits:
    edit()
    code = main(["-q", "-b", "html", ".", "_build/html"])
    html, notebook = Path("_build/html/index.html").read_text(), Path("_build/jupyter_execute/index.ipynb").read_text()
    second = Path("_build/html/second.html").read_text()
    ran = [re.search(r"ran at (\\d+)", text)[1] for text in (html, notebook, second)]
    print(code, *ran, "two curves" in html)
"""
PAGE = """---
file_format: mystnb
kernelspec: {name: python3, display_name: Python 3, language: python}
---
# Book

Prose.

```{code-cell} python
---
mystnb: {figure: {caption: a curve}}
---
import time
from IPython.display import Markdown
Markdown(f"ran at {time.time_ns()}")
```
"""
CACHED = """
extensions = ["myst_nb", "cache_key", "downloads"]
html_theme = "basic"
exclude_patterns = ["_build"]
nb_execution_mode = "cache"
cache_depends_on = ["duffing/**/*.py"]
"""


def test_an_edit_of_the_package_runs_all_chapters_of_a_cell_its_own_and_of_prose_none(tmp_path):
    (tmp_path / "duffing").mkdir()
    (tmp_path / "duffing" / "model.py").write_text("x = 1", encoding="utf-8")
    (tmp_path / "conf.py").write_text(
        f"import sys\nsys.path.append({str(BOOK / 'book' / 'sphinx')!r})\n{CACHED}", encoding="utf-8"
    )
    (tmp_path / "index.md").write_text(PAGE.replace("Prose.", "```{toctree}\nsecond\n```\n\nProse."), encoding="utf-8")
    (tmp_path / "second.md").write_text(PAGE, encoding="utf-8")
    environment = os.environ | {"IPYTHONDIR": str(tmp_path / "ipython")}
    command = [sys.executable, "-c", REBUILDS]
    run = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, encoding="utf-8")
    builds = [line.split() for line in run.stdout.splitlines()]
    assert [code for code, *_ in builds] == ["0"] * 4, run.stderr
    first, prose, cell, package = (ran for _, ran, _, _, _ in builds)
    assert first == prose == cell != package
    first, prose, cell, package = (ran for _, _, _, ran, _ in builds)
    assert first == prose and len({prose, cell, package}) == 3
    assert [caption for *_, caption in builds] == ["False", "True", "True", "True"]
    for _, page, download, _, _ in builds:
        assert page == download, "the notebook for download shows another run than the page"


def test_what_ran_while_the_package_was_edited_is_not_stored(tmp_path):
    (tmp_path / "duffing").mkdir()
    (tmp_path / "duffing" / "model.py").write_text("x = 1", encoding="utf-8")
    (tmp_path / "conf.py").write_text(
        f"import sys\nsys.path.append({str(BOOK / 'book' / 'sphinx')!r})\n{CACHED}", encoding="utf-8"
    )
    edit = 'from pathlib import Path\nPath("duffing/model.py").write_text("x = 2")\n'
    (tmp_path / "index.md").write_text(PAGE.replace("import time\n", edit + "import time\n"), encoding="utf-8")
    command = [sys.executable, "-m", "sphinx", "-q", "-b", "html", ".", "_build/html"]
    environment = os.environ | {"IPYTHONDIR": str(tmp_path / "ipython")}
    run = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, encoding="utf-8")
    assert run.returncode != 0
    assert "changed while a chapter ran: build again" in run.stderr
    assert not list(tmp_path.glob("_build/cache/*/executed/**/*.ipynb"))


def test_the_key_of_the_execution_cache_changes_with_the_package_and_the_environment_alone(tmp_path):
    depends_on = CONFIG["sphinx"]["config"]["cache_depends_on"]
    package = tmp_path / "duffing"
    package.mkdir()
    seen = [cache_key.key(tmp_path, depends_on)]
    for change in (
        lambda: (package / "a.py").write_text("x = 1\n", encoding="utf-8"),
        lambda: (package / "a.py").write_text("x = 2\n", encoding="utf-8"),
        lambda: (package / "a.py").rename(package / "b.py"),
        lambda: (package / "paper.mplstyle").write_text("lines.linewidth: 2\n", encoding="utf-8"),
        lambda: (tmp_path / "environment.txt").write_text("numpy==2.0\n", encoding="utf-8"),
    ):
        change()
        seen.append(cache_key.key(tmp_path, depends_on))
    assert len(set(seen)) == len(seen)
    (tmp_path / "chapters").mkdir()
    (tmp_path / "chapters" / "model.md").write_text("prose\n", encoding="utf-8")
    (package / "__pycache__").mkdir()
    (package / "__pycache__" / "b.pyc").write_text("compiled", encoding="utf-8")
    assert cache_key.key(tmp_path, depends_on) == seen[-1]


def test_the_key_of_the_execution_cache_changes_with_every_package_that_computes(tmp_path, monkeypatch):
    real = fingerprint.versions()
    assert {"Python", "numpy", "scipy", "numba", "sympy", "mpmath", "matplotlib", "tqdm"} == set(real)
    before = cache_key.key(tmp_path, [])
    for name in real:
        monkeypatch.setattr(fingerprint, "versions", lambda name=name: real | {name: "0.0"})
        assert cache_key.key(tmp_path, []) != before


def test_the_key_of_the_execution_cache_covers_every_file_of_the_package():
    covered = {path for pattern in CONFIG["sphinx"]["config"]["cache_depends_on"] for path in BOOK.glob(pattern)}
    for name in ("duffing", "vectorized"):
        files = {path for path in (BOOK / name).rglob("*") if path.is_file() and "__pycache__" not in path.parts}
        assert files and files <= covered


def test_equations_are_typeset_by_mathjax_as_published():
    # SHA-256 of es5/tex-svg-full.js in the npm package mathjax 3.2.2.
    published = "a4354ff94fd868aea0cc6eaaa79a57fda0588646fc46ee3700a349ee0a11cbe6"
    assert hashlib.sha256(offline_mathjax.script().read_bytes()).hexdigest() == published
