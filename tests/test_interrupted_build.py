"""A build that is killed at any moment leaves nothing that poisons the next: on a small book with the real settings."""

import os
import re
import signal
import time

import pytest
import small_book

PATIENCE = 120  # seconds for what should happen within some


@pytest.fixture
def small(tmp_path):
    """Makes small books: small("name") is the folder of one."""
    return lambda name: small_book.make(tmp_path / name)


def kill_when(root, happened):
    """Start a build and kill it, with all it started, as soon as happened(its output so far)."""
    process, deadline = small_book.start(root), time.monotonic() + PATIENCE
    while not happened((root / "output").read_text(encoding="utf-8")):
        assert process.poll() is None, (root / "output").read_text(encoding="utf-8")
        assert time.monotonic() < deadline
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def built(root):
    """Build to the end; returns dict name -> content of all that is published, without times."""
    code, output = small_book.build(root)
    assert code == 0, output
    files = {}
    for path in (root / "_build" / "html").rglob("*"):
        if path.suffix in (".html", ".ipynb", ".md", ".txt", ".svg", ".png", ".inv"):
            text = path.read_bytes().decode(errors="replace")
            text = re.sub(r"\.css\?v=\w+", ".css", text)  # known from the second build on
            text = re.sub(r"\d+\.\d+ s on \d{4}-\d\d-\d\d", "TIME", text)
            text = re.sub(r"<p>(\d+\.\d+|\d{4}-\d\d-\d\d \d\d:\d\d)</p>", "<p>TIME</p>", text)
            files[path.relative_to(root / "_build").as_posix()] = text
    # The words of the search index, without those that are times.
    words = re.findall(r"[\w-]+", (root / "_build" / "html" / "searchindex.js").read_text(encoding="utf-8"))
    return files | {"search": sorted(word for word in set(words) if not re.match(r"\d", word))}


def test_after_a_build_was_killed_early_while_executing_and_while_writing_the_next_is_that_of_a_clean_folder(small):
    root, clean = small("killed"), built(small("clean"))
    pages = root / "_build" / "html" / "chapters"
    moments = {
        "early": lambda output: (root / "_build" / "kernels").exists(),
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
        path.write_text("", encoding="utf-8")
    again = built(root)
    assert [name for name in clean if again[name] != clean[name]] == []
