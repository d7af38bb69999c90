"""Each page with cells ends by saying how long they ran, when, and with which versions."""

import time

from docutils import nodes
from fingerprint import versions
from myst_nb.sphinx_ import NbMetadataCollector
from sphinx.addnodes import pending_xref


def sentence(run, used):
    """How long, when, with what: run is MyST-NB's record, used a dict name -> version."""
    when = time.strftime("%Y-%m-%d", time.localtime(run["mtime"]))
    return f"The cells of this page ran in {run['runtime']:.1f} s on {when}, with " + ", ".join(
        f"{name} {number}" for name, number in used.items()
    )


def add_footer(app, doctree):
    page = app.env.docname
    run = NbMetadataCollector.get_exec_data(app.env, page)
    if not run or run["runtime"] is None:
        return
    footer = nodes.paragraph("", sentence(run, versions()) + ". ", classes=["page-run"])
    if page != app.config.run_times_page in app.env.found_docs:
        link = pending_xref(
            "", refdomain="std", reftype="doc", reftarget=f"/{app.config.run_times_page}", refexplicit=True, refdoc=page
        )
        footer += [link, nodes.Text(".")]
        link += nodes.inline("", "All run times")
    doctree += footer


def setup(app):
    app.add_config_value("run_times_page", "", "env")
    app.add_css_file("marks.css")
    app.connect("doctree-read", add_footer)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
