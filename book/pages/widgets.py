"""Pages that move: precomputed data and a page fragment become one HTML output, without a server or a network."""

import json
from pathlib import Path


def widget(name, data):
    """The fragment <name>.html beside this module with the data in its place, as an IPython HTML object.

    The fragment holds the word DATA once, inside a script of type application/json.
    """
    from IPython.display import HTML  # only a notebook calls this; the package runs without one

    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    # Nothing in the data may end the script that holds it.
    return HTML(
        Path(__file__)
        .with_name(f"{name}.html")
        .read_text(encoding="utf-8")
        .replace("DATA", text.replace("<", "\\u003c"))
    )
