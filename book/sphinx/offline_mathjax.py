"""Equations are typeset without a network: MathJax travels with the book.

One file (2.3 MB, TeX input, SVG output, all TeX extensions, no fonts to fetch), taken from the installed package
`sphinx-mathjax-offline`, which carries MathJax 3.2.2 (Apache-2.0) as published. That package's own Sphinx
extension is not used: it would copy 24 MB.
"""

from importlib.util import find_spec
from pathlib import Path


def script():
    """Path of the MathJax script in the installed package."""
    package = find_spec("sphinx-mathjax-offline").submodule_search_locations[0]
    return Path(package) / "static" / "mathjax" / "tex-svg-full.js"


def use_local_mathjax(app, config):
    config.html_static_path.append(str(script()))
    config.mathjax_path = script().name


def setup(app):
    app.set_html_assets_policy("always")  # titles with mathematics stand in the sidebar of every page
    app.connect("config-inited", use_local_mathjax)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
