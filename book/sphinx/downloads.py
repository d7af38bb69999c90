"""Each page with cells offers its executed notebook, outputs included, also when the cells did not run in this build.

The theme offers it only where a launch service is configured; else its button would give the chapter's Markdown alone.

On a cache hit MyST-NB shows the stored outputs on the page but writes the notebook as it was read, without any. Either
way the notebook is the same, to the byte: its cells' names are their numbers, where jupytext draws them by lot.
"""

import shutil
from pathlib import Path

from myst_nb.core.execute.cache import NotebookClientCache
from myst_nb.sphinx_ import NbMetadataCollector


def with_outputs(enter):
    """MyST-NB's own __enter__, followed by the outputs' way back into the notebook that is written."""

    def entered(client):
        read = client.notebook
        result = enter(client)
        for number, (cell, ran) in enumerate(zip(read.cells, client.notebook.cells, strict=True)):
            cell.id = f"cell-{number}"
            if cell.cell_type == "code":
                cell.outputs, cell.execution_count = ran.outputs, ran.execution_count
        if "language_info" in client.notebook.metadata:
            read.metadata.language_info = client.notebook.metadata.language_info
        return result

    return entered


def offer(app, pagename, templatename, context, doctree):
    """The theme's button leads to `ipynb_source` below _sources/, beside the Markdown."""
    if doctree is None or not NbMetadataCollector.get_exec_data(app.env, pagename):
        return
    name = f"{pagename}.ipynb"
    published = Path(app.outdir, "_sources", name)
    published.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(Path(app.outdir).parent / "jupyter_execute" / name, published)
    context["ipynb_source"] = name


def setup(app):
    app.connect("html-page-context", offer, priority=400)  # before the theme makes its buttons (500)
    # Not start_client: after it, MyST-NB takes the glued values out of the outputs.
    NotebookClientCache.__enter__ = with_outputs(NotebookClientCache.__enter__)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
