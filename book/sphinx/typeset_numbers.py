"""Numbers in prose and tables as a journal prints them, whatever format a cell or a glue role gave them.

Glued text and the cells of tables go through `book.pages.typeset.typeset`. Code, mathematics and outputs of code stay.
"""

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

from book.pages.typeset import typeset

UNTOUCHED = (nodes.literal, nodes.literal_block, nodes.math, nodes.math_block, nodes.raw)


class TypesetNumbers(SphinxPostTransform):
    """After references to values of other pages have been resolved (their priority is 5)."""

    default_priority = 900

    def run(self, **kwargs):
        glued = [node for node in self.document.findall(nodes.inline) if "pasted-text" in node["classes"]]
        for place in (*glued, *self.document.findall(nodes.entry)):
            for text in list(place.findall(nodes.Text)):
                if not any(isinstance(above, UNTOUCHED) for above in ancestors(text, place)):
                    set_text = typeset(text.astext())
                    if set_text != text.astext():
                        text.parent.replace(text, nodes.Text(set_text))


def ancestors(node, last):
    """The nodes above, up to `last`."""
    while node is not last:
        node = node.parent
        yield node


def setup(app):
    app.add_post_transform(TypesetNumbers)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
