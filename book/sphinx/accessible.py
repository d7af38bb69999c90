"""Pages that a screen reader takes well: what Sphinx and the theme leave undone, mended (the rest is in book.js).

The roles that docutils gives a bibliography are deprecated, and its list holds no items: each entry becomes one.
"""


def mend(app, pagename, templatename, context, doctree):
    if "body" in context:
        context["body"] = context["body"].replace('role="doc-biblioentry"', 'role="listitem"')


def setup(app):
    app.add_js_file("book.js")
    app.connect("html-page-context", mend)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
