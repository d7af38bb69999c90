"""A build that is killed at any moment leaves nothing that poisons the next: on a small book with the real settings."""

import os
import re
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest
import yaml

BOOK = Path(__file__).parents[1]
CELLS = """
    ---
    jupytext: {text_representation: {extension: .md, format_name: myst}}
    kernelspec: {display_name: Python 3, language: python, name: python3}
    ---
"""
PAGES = {
    "chapters/index.md": CELLS
    + """
    # Small

    $$ a = b $$ (eq-own)

    Eq. {eq}`eq-own` is checked by `tests/test_small.py::test_it`.

    ```{code-cell} ipython3
    import time
    from myst_nb import glue
    time.sleep(1)
    glue("number", 1.5, display=False)
    ```

    {glue:text}`number:.2f`
    """,
    "chapters/second.md": CELLS
    + """
    # Second

    ```{code-cell} ipython3
    import time
    time.sleep(1)
    print("second")
    ```

    {glue:text}`index.md::number:.3f` and {eq}`eq-own`.
    """,
    "chapters/about.md": "# About\n\n```{nb-exec-table}\n```\n",
    "chapters/tests.md": "# Tests\n\n```{test-page}\n```\n",
    "tests/test_small.py": "def test_it():\n    assert True\n",
    "duffing/model.py": "x = 1\n",
    "environment.txt": "",
    "chapters/references.bib": "",
    "_toc.yml": "{format: jb-book, root: chapters/index, chapters: "
    "[{file: chapters/second}, {file: chapters/about}, {file: chapters/tests}]}",
}


@pytest.fixture
def small(tmp_path):
    """Makes small books: small("name") is the folder of one."""

    def make(name):
        root = tmp_path / name
        for path, text in PAGES.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(textwrap.dedent(text).lstrip("\n"))
        config = yaml.safe_load((BOOK / "_config.yml").read_text())
        config["sphinx"]["config"] |= {"paper_equations": 0, "paper_figures": []}
        (root / "_config.yml").write_text(yaml.safe_dump(config))
        (root / "extensions").symlink_to(BOOK / "book" / "sphinx")
        (root / "chapters" / "_static").symlink_to(BOOK / "chapters" / "_static")
        return root

    return make


def start(root):
    command = [sys.executable, "-u", "book/sphinx/build.py", "1"]
    with (root / "output").open("w") as output:
        return subprocess.Popen(command, cwd=root, stdout=output, stderr=subprocess.STDOUT, start_new_session=True)


def kill_when(root, happened):
    """Start a build and kill it, with all it started, as soon as happened(its output so far)."""
    process = start(root)
    while not happened((root / "output").read_text()):
        assert process.poll() is None, (root / "output").read_text()
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def built(root):
    """Build to the end; returns dict name -> content of all that is published, without times."""
    code = start(root).wait()
    assert code == 0, (root / "output").read_text()
    files = {}
    for path in (root / "_build" / "html").rglob("*"):
        if path.suffix in (".html", ".ipynb", ".md", ".txt", ".svg", ".png", ".inv"):
            text = path.read_bytes().decode(errors="replace")
            text = re.sub(r"\.css\?v=\w+", ".css", text)  # known from the second build on
            text = re.sub(r"\d+\.\d+ s on \d{4}-\d\d-\d\d", "TIME", text)
            text = re.sub(r"<p>(\d+\.\d+|\d{4}-\d\d-\d\d \d\d:\d\d)</p>", "<p>TIME</p>", text)
            files[path.relative_to(root / "_build").as_posix()] = text
    # The words of the search index, without those that are times.
    words = re.findall(r"[\w-]+", (root / "_build" / "html" / "searchindex.js").read_text())
    return files | {"search": sorted(word for word in set(words) if not re.match(r"\d", word))}


def test_after_a_build_was_killed_early_while_executing_and_while_writing_the_next_is_that_of_a_clean_folder(small):
    root, clean = small("killed"), built(small("clean"))
    pages = root / "_build" / "html" / "chapters"
    moments = {
        "early": lambda output: (root / "_build" / "ipython").exists(),
        "in the first chapter": lambda output: "Executing notebook" in output,
        "in the second": lambda output: re.search(r"(Executed|cached).*second.md: Executing", output, re.DOTALL),
        "while writing": lambda output: pages.exists() and any(pages.glob("*.html")),
    }
    for happened in moments.values():
        kill_when(root, happened)
        assert not (root / "_build" / "complete").exists()
    again = built(root)
    assert again.keys() == clean.keys()
    notebook = "_sources/chapters/index.ipynb"
    assert f"html/{notebook}" in again and f'href="../{notebook}"' in again["html/chapters/index.html"]
    assert "_sources/chapters/tests.ipynb" not in again["html/chapters/tests.html"], "a page without cells has none"
    assert [name for name in clean if again[name] != clean[name]] == []

    # And with files that were torn while they were written.
    (root / "_build" / "complete").unlink()
    for path in (root / "_build" / "doctrees").rglob("*.*"):
        path.write_bytes(path.read_bytes()[:50])
    for path in pages.glob("*.html"):
        path.write_text("")
    again = built(root)
    assert [name for name in clean if again[name] != clean[name]] == []
