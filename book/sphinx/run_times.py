"""The build ends by saying how long each chapter ran, which of them ran now, and where the book is.

The table of run times says in words whether a chapter ran to its end: an emoji is a box where its font is missing.
"""

import time
from pathlib import Path

from myst_nb.ext import execution_tables
from myst_nb.sphinx_ import NbMetadataCollector
from sphinx.util import logging

logger = logging.getLogger(__name__)


def pages_with_table(app, env):
    """Pages that show the run times are written anew: pages read in parallel do not tell them that they ran."""
    return [page for page, data in NbMetadataCollector.get_doc_data(env).items() if data.get("has_exec_table")]


def report(app, exception):
    if exception is not None:
        return
    runs = {}
    for page in sorted(app.env.found_docs):
        run = NbMetadataCollector.get_exec_data(app.env, page)
        if run and run["runtime"] is not None:
            runs[page] = run
    for page, run in sorted(runs.items(), key=lambda item: -item[1]["runtime"]):
        when = "ran now" if run["mtime"] >= app.started else "unchanged, ran " + time.ctime(run["mtime"])
        logger.info(f"{run['runtime']:8.1f} s  {page}  ({when})")
    logger.info(f"{sum(run['runtime'] for run in runs.values()):8.1f} s  in all")
    if app.builder.format == "html":
        logger.info(f"Open {Path(app.outdir, 'index.html')}")


def setup(app):
    app.started = time.time()
    execution_tables._key2transform["succeeded"] = lambda succeeded: "complete" if succeeded else "failed"
    app.connect("env-updated", pages_with_table)
    app.connect("build-finished", report, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
