"""What an earlier build wrote and this book no longer has: pages of chapters that went, pictures that changed.

Sphinx writes and never deletes. The pages would be found by whoever looks into the folder, and be packed with it.
"""

import re
from pathlib import Path


def remove(app, exception):
    if exception is not None or app.builder.name != "html":
        return
    out = Path(app.outdir)
    # Every page of a document has its source beside it; the index of words and the search are no documents.
    for source in [path for path in (out / "_sources").rglob("*") if path.is_file()]:
        page = re.sub(r"(\.md|\.rst|\.ipynb)(\.txt)?$", "", source.relative_to(out / "_sources").as_posix())
        if page not in app.env.found_docs:
            source.unlink()
            (out / f"{page}.html").unlink(missing_ok=True)
    shown = {
        "_images": {name for _, name in app.env.images.values()},
        "_downloads": {name for _, name in app.env.dlfiles.values()},
    }
    for folder, names in shown.items():
        for path in [path for path in (out / folder).rglob("*") if path.is_file()]:
            if path.relative_to(out / folder).as_posix() not in names:
                path.unlink()
    if app.config.root_doc != "index":
        (out / "index.html").unlink(missing_ok=True)  # leads to the first page, and is then written anew


def setup(app):
    app.connect("build-finished", remove, priority=100)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
