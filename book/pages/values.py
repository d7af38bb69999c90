"""Values for the prose: what the text around a cell quotes, handed over by name in one call."""

import numpy as np


def values(**named):
    """Glue each value under its name, for `{glue:text}` in the prose, where its format stands.

    named : numbers (Python's or NumPy's, without a shape), words, or tables (IPython Markdown objects)

    Raises ValueError for anything else, an array among it, and for a number that is not finite: prose cannot show it.
    """
    from myst_nb import glue  # only a notebook calls this

    for name, value in named.items():
        if isinstance(value, np.generic):
            value = value.item()
        if isinstance(value, np.ndarray) and value.ndim == 0:
            value = value.item()
        if not isinstance(value, int | float | str) and not hasattr(value, "_repr_markdown_"):
            raise ValueError(f"{name} = {value!r}: must be a number, a word or a table")
        if isinstance(value, float) and not np.isfinite(value):
            raise ValueError(f"{name} = {value}: must be finite, for the prose quotes it")
        glue(name, value, display=False)
