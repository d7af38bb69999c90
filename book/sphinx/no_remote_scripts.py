"""No page holds the script that would fetch Thebe from the network.

Jupyter Book loads it on every page, twice (an error in the browser's console), even where no button calls it.
"""


def drop_thebe(app, pagename, templatename, context, doctree):
    def is_thebe(file):
        return "thebe" in f"{file.filename} {file.attributes.get('body', '')}".lower()

    for kind in ("script_files", "css_files"):
        context[kind] = [file for file in context[kind] if not is_thebe(file)]


def setup(app):
    # After sphinx_thebe has added its own (priority 500).
    app.connect("html-page-context", drop_thebe, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
