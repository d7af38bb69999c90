"""A stored result is reused only while the code that computed it is unchanged.

The execution cache compares a chapter's own cells, not the package they call: after an edit in `duffing/` or `book/`
it would go on serving old numbers. Its folder is therefore named by a hash of everything a chapter depends on; a new
name also makes Sphinx read every chapter again, and so run it. An edit of prose, captions and alternative texts
included, changes no hash and runs nothing. What ran while the package was edited is not stored: it belongs to no one
state.
"""

import shutil
from functools import partialmethod
from pathlib import Path

from fingerprint import key
from jupyter_cache import get_cache
from jupyter_cache.cache.main import JupyterCacheBase
from sphinx.errors import SphinxError

store = JupyterCacheBase.cache_notebook_bundle


def set_cache_path(app, config):
    caches = Path(app.outdir).parent / "cache"
    current = caches / key(app.srcdir, config.cache_depends_on)
    for old in caches.glob("*"):
        if old != current:
            shutil.rmtree(old)
    config.nb_execution_cache_path = str(current)

    def store_if_unchanged(cache, *args, **kwargs):
        if key(app.srcdir, config.cache_depends_on) != current.name:
            raise SphinxError("the package or the environment changed while a chapter ran: build again")
        return store(cache, *args, **kwargs)

    JupyterCacheBase.cache_notebook_bundle = store_if_unchanged
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
