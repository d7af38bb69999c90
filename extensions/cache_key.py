"""A stored result is reused only while the code that computed it is unchanged.

The execution cache compares a chapter's own cells, not the package they call: after an edit in `duffing/` it would go
on serving old numbers. Its folder is therefore named by a hash of everything a chapter depends on; a new name also
makes Sphinx read every chapter again, and so run it. An edit of prose, captions and alternative texts included,
changes no hash and runs nothing.
"""

import hashlib
import shutil
import sys
from functools import partialmethod
from pathlib import Path

from jupyter_cache import get_cache
from jupyter_cache.cache.main import JupyterCacheBase


def key(root, patterns):
    """Hash (hex) of the names and contents of all files under root that match a pattern, and of Python's version."""
    digest = hashlib.sha256(f"{sys.version_info[:3]}".encode())
    for path in sorted({path for pattern in patterns for path in Path(root).glob(pattern) if path.is_file()}):
        content = hashlib.sha256(path.read_bytes()).hexdigest()
        digest.update(f"{path.relative_to(root).as_posix()} {content}\n".encode())
    return digest.hexdigest()[:16]


def set_cache_path(app, config):
    caches = Path(app.outdir).parent / "cache"
    current = caches / key(app.srcdir, config.cache_depends_on)
    for old in caches.glob("*"):
        if old != current:
            shutil.rmtree(old)
    config.nb_execution_cache_path = str(current)
    # Made here, before the chapters are shared out over processes that would race to make it.
    _ = get_cache(current).db


def setup(app):
    # The cache would compare a cell's whole metadata, which hold its figure's caption.
    hashed = JupyterCacheBase.create_hashed_notebook
    if not isinstance(hashed, partialmethod):
        JupyterCacheBase.create_hashed_notebook = partialmethod(hashed, cell_metadata=("tags",))
    app.add_config_value("cache_depends_on", [], "env")
    app.connect("config-inited", set_cache_path)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
