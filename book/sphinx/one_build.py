"""One build at a time in a folder: a second one would read pages that the first has half written.

The lock is SQLite's, the one in Python's own library that is the same on every system: it ends with its process,
however that ends.
"""

import sqlite3
from pathlib import Path

from sphinx.errors import SphinxError

held = {}


def lock(folder):
    """Hold the folder until this process ends; SphinxError if another process holds it."""
    path = Path(folder).absolute() / "lock"
    if path in held:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    connection = sqlite3.connect(path, timeout=0, isolation_level=None, check_same_thread=False)
    try:
        connection.execute("BEGIN EXCLUSIVE")
    except sqlite3.OperationalError as error:
        if error.sqlite_errorname != "SQLITE_BUSY":
            raise
        raise SphinxError(f"another build is at work in {path.parent}: wait until it has ended") from None
    held[path] = connection


def setup(app):
    lock(Path(app.outdir).parent)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
