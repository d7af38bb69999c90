"""The notebook that a page offers for download holds its outputs, also when the cells did not run in this build.

On a cache hit MyST-NB shows the stored outputs on the page but writes the notebook as it was read, without any.
"""

from myst_nb.core.execute.cache import NotebookClientCache


def with_outputs(start_client):
    """MyST-NB's own start_client, followed by the outputs' way back into the notebook that is written."""

    def start(client):
        read = client.notebook
        start_client(client)
        for cell, ran in zip(read.cells, client.notebook.cells, strict=True):
            if cell.cell_type == "code":
                cell.outputs, cell.execution_count = ran.outputs, ran.execution_count

    return start


def setup(app):
    NotebookClientCache.start_client = with_outputs(NotebookClientCache.start_client)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
