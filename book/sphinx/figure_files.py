"""Every figure can be cited and downloaded: `figures/fig4a.svg`, `.png` and its data as `.csv`, linked below it.

The files are the outputs of the figure's cell, taken from the executed notebook: the same whether the cell ran in this
build or its result came from the cache. A figure is called by its label: fig-4a is fig4a, as in the paper, and
fig-splitting keeps its name.
"""

import base64
import re
from pathlib import Path

import nbformat
from docutils import nodes
from myst_nb.core.render import NbElementRenderer

FORMATS = {"image/svg+xml": ("svg", "SVG"), "image/png": ("png", "PNG"), "text/csv": ("csv", "data")}


def stem(label):
    """Name of a figure's files, without an ending."""
    return re.sub(r"^fig-(\d+[a-z]?)$", r"fig\1", label)


def outputs(notebook):
    """Dict label -> dict ending -> bytes of the figures in an executed notebook that come with all of FORMATS."""
    found = {}
    for cell in notebook.cells:
        label = cell.metadata.get("mystnb", {}).get("figure", {}).get("name")
        for output in cell.get("outputs", []) if label else []:
            data = output.get("data", {})
            if FORMATS.keys() <= data.keys():
                found[label] = {ending: content(data[kind], kind) for kind, (ending, _) in FORMATS.items()}
    return found


def content(data, kind):
    return base64.b64decode(data) if kind == "image/png" else data.encode()


def executed(app, page):
    """The executed notebook of a page, or one without cells where there is none."""
    path = Path(app.env.mystnb_config.output_folder, f"{page}.ipynb")
    return nbformat.read(path, as_version=4) if path.is_file() else nbformat.v4.new_notebook()


def add_links(app, doctree):
    page = app.env.docname
    up = "../" * page.count("/")
    offered = outputs(executed(app, page))
    for figure in doctree.findall(nodes.figure):
        for label in offered.keys() & set(figure["names"]):
            links = [
                f'<a download href="{up}figures/{stem(label)}.{ending}" aria-label="{stem(label)}: {word}">{word}</a>'
                for ending, word in FORMATS.values()
            ]
            html = f'<p class="figure-files d-print-none">{" ".join(links)}</p>'
            figure += nodes.legend("", nodes.raw("", html, format="html"))


def write_files(app, exception):
    if exception is not None or app.builder.format != "html":
        return
    folder = Path(app.outdir, "figures")
    folder.mkdir(exist_ok=True)
    wanted = {
        f"{stem(label)}.{ending}": data
        for page in sorted(app.env.found_docs)
        for label, files in outputs(executed(app, page)).items()
        for ending, data in files.items()
    }
    for old in {path.name for path in folder.iterdir()} - wanted.keys():
        (folder / old).unlink()
    for name, data in wanted.items():
        (folder / name).write_bytes(data)


def but_data(render):
    """MyST-NB's own render_unhandled, without the complaint that a page cannot show a table of data."""

    def inside(self, data):
        return [] if data.mime_type == "text/csv" else render(self, data)

    return inside


def setup(app):
    NbElementRenderer.render_unhandled = but_data(NbElementRenderer.render_unhandled)
    app.connect("doctree-read", add_links)
    app.connect("build-finished", write_files)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
