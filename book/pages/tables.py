"""Tables for the book's pages: rows in, Markdown out, to be glued into a page."""


def table(head, rows):
    """A Markdown table. head : the columns' heads; rows : sequences of cells, each a string with roles and maths.

    A vertical line in a cell is escaped. Returns an IPython Markdown object.
    """
    from IPython.display import Markdown  # only a notebook calls this; the package runs without one

    lines = [head, [":--"] * len(head), *rows]
    escaped = (" | ".join(str(cell).replace("|", r"\|") for cell in line) for line in lines)
    return Markdown("\n".join(f"| {line} |" for line in escaped))
