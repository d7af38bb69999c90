"""A stored result is reused only while the code that computed it is unchanged.

The execution cache compares a chapter's own cells, not the package they call: after an edit in `duffing/` or `book/`
it would go on serving old numbers. Its folder is therefore named by a hash of everything a chapter depends on; a new
name also makes Sphinx read every chapter again, and so run it. An edit of prose, captions and alternative texts
included, changes no hash and runs nothing. What ran while the package was edited is not stored: it belongs to no one
state. Nor is a chapter that wrote to its error stream: it fails the build (the message shows what it wrote), and would
go on failing it from the cache after the reason is gone.
"""

import shutil
from functools import partialmethod
from pathlib import Path
from types import SimpleNamespace

from fingerprint import key
from jupyter_cache import get_cache
from jupyter_cache.cache.main import JupyterCacheBase
from myst_nb.core.render import NbElementRenderer
from sphinx.errors import SphinxError

store = JupyterCacheBase.cache_notebook_bundle
show_stderr = NbElementRenderer.render_stderr


def errors(notebook):
    """What the cells wrote to the error stream, except where a cell's tag says that it may."""
    return "".join(
        output.get("text", "")
        for cell in notebook.cells
        if "remove-stderr" not in cell.metadata.get("tags", [])
        for output in cell.get("outputs", [])
        if output.get("name") == "stderr"
    )


def show_stderr_with_text(renderer, output, *args):
    """MyST-NB's own warning that there is something, with the thing."""
    real = renderer._logger
    told = f":\n{output['text'].rstrip()}"
    renderer._logger = SimpleNamespace(
        **{
            level: lambda message, level=level, **where: getattr(real, level)(message + told, **where)
            for level in ("warning", "error", "critical")
        }
    )
    try:
        return show_stderr(renderer, output, *args)
    finally:
        renderer._logger = real


def set_cache_path(app, config):
    caches = Path(app.outdir).parent / "cache"
    current = caches / key(app.srcdir, config.cache_depends_on)
    if Path(app.outdir).name == "html" and not current.exists():
        shutil.rmtree(app.outdir, ignore_errors=True)  # pages of another state, and what another Sphinx put beside them
    for old in caches.glob("*"):
        if old != current:
            shutil.rmtree(old)
    config.nb_execution_cache_path = str(current)

    def store_if_sound(cache, bundle, *args, **kwargs):
        if key(app.srcdir, config.cache_depends_on) != current.name:
            raise SphinxError("the package or the environment changed while a chapter ran: build again")
        if errors(bundle.nb):
            return SimpleNamespace(pk="none, it wrote to its error stream")
        return store(cache, bundle, *args, **kwargs)

    JupyterCacheBase.cache_notebook_bundle = store_if_sound
    # Made here, before the chapters are shared out over processes that would race to make it.
    _ = get_cache(current).db


def setup(app):
    # The cache would compare a cell's whole metadata, which hold its figure's caption.
    hashed = JupyterCacheBase.create_hashed_notebook
    if not isinstance(hashed, partialmethod):
        JupyterCacheBase.create_hashed_notebook = partialmethod(hashed, cell_metadata=("tags",))
    NbElementRenderer.render_stderr = show_stderr_with_text
    app.add_config_value("cache_depends_on", [], "env")
    app.connect("config-inited", set_cache_path)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
