"""Builds the book: `jupyter-book build . -W -n --keep-going`, but with chapters read side by side.

Run from the root of the repository: python book/sphinx/build.py [number of chapters side by side]
"""

import shutil
import sys
from pathlib import Path

from isolation import isolate
from jupyter_book.sphinx import build_sphinx
from one_build import lock
from sphinx.errors import SphinxError
from sphinx.util.console import nocolor


def main(jobs=2):
    root = Path.cwd()
    build = root / "_build"
    try:
        lock(build)
    except SphinxError as error:
        sys.exit(f"{error}")
    isolate(build / "kernels", root)  # before the processes that read chapters side by side
    if not sys.stdout.isatty():
        nocolor()
    complete = build / "complete"
    # Sphinx warns about a page only when it reads it: after a build that failed or was interrupted every page is read
    # again, else the second attempt would pass. Chapters that ran to their end do not run again: they are in the cache.
    if not complete.exists():
        shutil.rmtree(build / "doctrees", ignore_errors=True)
    complete.unlink(missing_ok=True)
    result = build_sphinx(
        root,
        build / "html",
        noconfig=True,
        path_config=root / "_config.yml",
        confoverrides={"external_toc_path": "_toc.yml", "latex_individualpages": False, "nitpicky": True},
        doctreedir=build / "doctrees",
        warningiserror=True,
        keep_going=True,
        jobs=jobs,
    )
    if result != 0:
        sys.exit("The book is not built: see the warnings above.")
    complete.touch()


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
