"""Chapters are read side by side although one extension of Jupyter Book does not say that it allows it.

`sphinx_multitoc_numbering` only replaces a method when it is loaded, which is safe, but declares nothing; Sphinx then
reads one page after the other, with a warning.
"""


def declare_safe(app, config):
    app.extensions["sphinx_multitoc_numbering"].parallel_read_safe = True


def setup(app):
    app.connect("config-inited", declare_safe)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
