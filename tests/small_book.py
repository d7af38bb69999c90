"""A small book with the real settings and extensions, and how it is built: in seconds, not minutes.

The chapters call the real package where `real` asks for it, else one of a single line.
"""

import os
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

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
    "chapters/tests.md": "# Tests\n\n```{test-overview}\n```\n",
    "chapters/tests/small.md": "# Small tests\n\n```{test-page}\nsmall\n```\n",
    "tests/test_small.py": "def test_it():\n    assert True\n",
    "duffing/model.py": "x = 1\n",
    "environment.txt": "",
    "chapters/references.bib": "",
    "_toc.yml": "{format: jb-book, root: chapters/index, chapters: "
    "[{file: chapters/second}, {file: chapters/about}, "
    "{file: chapters/tests, sections: [{file: chapters/tests/small}]}]}",
}


DRAWN = """

    ```{code-cell} ipython3
    ---
    mystnb:
      figure: {name: fig-small, caption: "The potential of the book, drawn by its own function."}
      image: {alt: "A curve with two valleys and a hill between them, drawn for this test."}
    ---
    import numpy as np
    from book.figures import paper as figures
    from duffing import Duffing, critical_amplitude
    x = np.linspace(-1.5, 1.5, 50)
    figures.fig1a(x, Duffing().potential(x))
    ```

    ```{code-cell} ipython3
    round(critical_amplitude(Duffing(p=0.5)), 6)
    ```
"""


def make(root, real=False):
    """Write a small book into the folder root, which is made; real : with the package and a figure of the book."""
    for path, text in PAGES.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        text = text + DRAWN if real and path == "chapters/second.md" else text
        (root / path).write_text(textwrap.dedent(text).lstrip("\n"), encoding="utf-8")
    config = yaml.safe_load((BOOK / "_config.yml").read_text(encoding="utf-8"))
    config["sphinx"]["config"] |= {"paper_equations": 0, "paper_figures": []}
    (root / "_config.yml").write_text(yaml.safe_dump(config), encoding="utf-8")
    sources = ["book/sphinx", "chapters/_static", *(["duffing", "vectorized", "book"] if real else [])]
    for name in sorted(sources):
        shutil.rmtree(root / name, ignore_errors=True)
        shutil.copytree(BOOK / name, root / name, ignore=shutil.ignore_patterns("__pycache__"), dirs_exist_ok=True)
    return root


def start(root, **variables):
    """Start its build; what it says goes to the file `output`."""
    command = [sys.executable, "-u", "book/sphinx/build.py", "1"]
    environment = {name: value for name, value in (os.environ | variables).items() if value is not None}
    with (root / "output").open("w", encoding="utf-8") as output:
        return subprocess.Popen(
            command, cwd=root, env=environment, stdout=output, stderr=subprocess.STDOUT, start_new_session=True
        )


def build(root, patience=300, **variables):
    """Build it to the end: its exit code and what it said."""
    process = start(root, **variables)
    try:
        code = process.wait(patience)
    finally:
        process.kill()
        process.wait()
    return code, (root / "output").read_text(encoding="utf-8", errors="replace")
