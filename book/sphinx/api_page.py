"""The pages on the package, an overview and one for each room, made from docstrings by Sphinx's autodoc.

Docstrings are plain text, made to be read in an editor: "name : what it is" for each parameter, dashes below a
heading, names in `backticks`, formulas as they are typed. Here they become lists, links and code.
"""

import inspect
import re
from functools import cache
from importlib import import_module
from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

PARAMETER = re.compile(r"(\w[^:`]*?) : +(\S.*)")
SPECIAL = re.compile(r"([\\*|_<>])")


def modules_of(package):
    """Modules of a package and of its rooms, those of Sphinx's own folder left out: sorted whole names."""
    folder = Path(import_module(package).__file__).parent
    paths = [path.relative_to(folder).with_suffix("") for path in folder.rglob("*.py") if not path.stem.startswith("_")]
    return sorted(".".join((package, *path.parts)) for path in paths if "sphinx" not in path.parts)


def rooms_of(package):
    """dict: room ("duffing.manifolds") -> whole names of its modules; the package itself is the first room."""
    rooms = {}
    for module in sorted(modules_of(package), key=lambda module: (module.rpartition(".")[0], module)):
        rooms.setdefault(module.rpartition(".")[0], []).append(module)
    return rooms


def members(module):
    """Public functions and classes that a module defines itself, in the order of the source."""
    module = import_module(module)
    found = [
        key
        for key, value in vars(module).items()
        if not key.startswith("_")
        and (inspect.isfunction(value) or inspect.isclass(value))
        and value.__module__ == module.__name__
    ]
    return sorted(found, key=lambda key: inspect.getsourcelines(inspect.unwrap(getattr(module, key)))[1])


def first_sentence(module):
    return inspect.getdoc(import_module(module)).partition("\n\n")[0].replace("\n", " ")


class Names:
    """What a word in backticks means: the entry for it on some page, or nothing."""

    def __init__(self, packages):
        self.public = {name: package for package in packages for name in getattr(import_module(package), "__all__", ())}
        self.modules = [module for package in packages for module in modules_of(package)]
        self.entries = {}
        for module in self.modules:
            for member in members(module):
                place = self.public.get(member, module)
                self.entries.setdefault(member, []).append(f"{place}.{member}")

    def link(self, word, module):
        """reStructuredText for a word of the docstrings of a module ("duffing.flow")."""
        entries = self.entries.get(word.removesuffix("()"), [])
        near = [entry for entry in entries if entry.startswith(f"{module}.")]
        for entry in near or entries[: len(entries) == 1]:
            return f":py:obj:`{word} <{entry}>`"
        named = [name for name in self.modules if f".{name}".endswith(f".{word}")]
        return f":py:mod:`{word} <{named[0]}>`" if len(named) == 1 else f"``{word}``"


@cache
def names_of(*packages):
    return Names(packages)


def to_rst(lines, link):
    """A docstring's lines as lines of reStructuredText; link(word) renders a word in backticks."""

    def inline(text):
        parts = re.split(r"`+([^`]+)`+", text)
        return "".join(link(part) if n % 2 else SPECIAL.sub(r"\\\1", part) for n, part in enumerate(parts))

    def paragraph(text):
        text = inline(re.sub(r"\s+", " ", text).strip())
        return text if re.match(r"[\w:`\\]", text) and not re.match(r"\w+[.)] ", text) else f"\\{text}"

    result, open_item = [], False
    for block in re.split(r"\n\s*\n", "\n".join(lines).strip("\n")):
        rows = block.split("\n")
        if all(row.startswith("    ") for row in rows):  # a formula on lines of its own
            result += ["::", "", *("    " + row for row in rows), ""]
            continue
        text = []
        if len(rows) > 1 and re.fullmatch("-+", rows[1]):
            result += [f"**{rows[0]}**", ""]
            rows = rows[2:]
        for row in rows:
            match = PARAMETER.fullmatch(row)
            if match or (text and not open_item and row.startswith("- ")):
                result += [*([paragraph(" ".join(text))] if text else []), ""] if not open_item else [" ".join(text)]
                text, open_item = [f"- ``{match[1]}``: {inline(match[2])}"], True
            elif open_item and row.startswith(" "):
                text.append(inline(row.strip()))
            elif open_item:
                result += [" ".join(text), ""]
                text, open_item = [row], False
            else:
                text.append(row)
        result += [" ".join(text) if open_item else paragraph(" ".join(text)), ""]
        open_item = False
    return result


def process(app, what, name, obj, options, lines):
    module = getattr(inspect.unwrap(obj) if callable(obj) else obj, "__module__", None) or name
    module = name if what == "module" else module
    names = names_of(*app.config.api_packages)
    lines[:] = to_rst(lines, lambda word: names.link(word, module))


def skip(app, what, name, obj, skipped, options):
    """Fields of named tuples say nothing but their position: the class's docstring describes them."""
    doc = inspect.getdoc(obj) or ""
    return True if doc.startswith("Alias for field number") else None


class PackageDirective(SphinxDirective):
    """What both directives need: sections, and nodes of lines of reStructuredText."""

    @property
    def names(self):
        return names_of(*self.config.api_packages)

    def section(self, title, content, code=False):
        shown = nodes.literal("", title) if code else nodes.Text(title)
        node = nodes.section("", nodes.title(title, "", shown), ids=[nodes.make_id(f"package {title}")], names=[title])
        node += content
        return node

    def parsed(self, lines):
        holder = nodes.Element()
        text = StringList(["```{eval-rst}", *lines, "```"], self.get_source_info()[0])
        self.state.nested_parse(text, self.content_offset, holder)
        return holder.children


class PackageOverview(PackageDirective):
    """`{package-overview}`: the public names with their documentation, then all rooms with a line for each module.

    A room's title leads to its page, <folder of this page>/api/<room>, which must exist.
    """

    def run(self):
        rooms = [room for package in self.config.api_packages for room in rooms_of(package).items()]
        return [self.section("Public names", self.public_names()), *(self.room(*room) for room in rooms)]

    def public_names(self):
        lines = []
        for name, package in self.names.public.items():
            kind = "autofunction" if inspect.isfunction(getattr(import_module(package), name)) else "autoclass"
            lines += [f".. {kind}:: {package}.{name}"]
            lines += ["   :members:", "   :member-order: bysource"] if kind == "autoclass" else []
            lines.append("")
        return self.parsed(lines)

    def room(self, room, modules):
        lines = [f"{first_sentence(room)} :doc:`All of its functions <api/{room}>`.", ""]
        for module in modules:
            (line,) = filter(None, to_rst([first_sentence(module)], lambda word: f"``{word}``"))
            lines.append(f"* :py:mod:`{module.rpartition('.')[2]} <{module}>`: {line}")
        return self.section(room, self.parsed(lines), code=True)


class RoomPage(PackageDirective):
    """`{room-page} duffing.manifolds`: a section for each module of the room, with all of its functions."""

    required_arguments = 1

    def run(self):
        room = self.arguments[0]
        modules = rooms_of(room.partition(".")[0]).get(room)
        if modules is None:
            raise self.error(f"no such room: {room}")
        return [self.module(module) for module in modules]

    def module(self, module):
        offered = [member for member in members(module) if member in self.names.public]
        lines = [f".. automodule:: {module}", "   :members:", "   :member-order: bysource"]
        lines += [f"   :exclude-members: {', '.join(offered)}"] if offered else []
        content = self.parsed(lines)
        if offered:
            links = ", ".join(f":py:obj:`{member} <{self.names.public[member]}.{member}>`" for member in offered)
            content += self.parsed([f"Public, documented with the public names: {links}."])
        return self.section(module.rpartition(".")[2], content, code=True)


def setup(app):
    app.setup_extension("sphinx.ext.autodoc")
    app.config.autodoc_preserve_defaults = True
    app.config.autodoc_typehints = "none"  # NamedTuples alone have any, and their docstrings say more
    app.add_config_value("api_packages", ["duffing", "vectorized", "book", "proof"], "env")
    app.add_directive("package-overview", PackageOverview)
    app.add_directive("room-page", RoomPage)
    app.connect("autodoc-process-docstring", process)
    app.connect("autodoc-skip-member", skip)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
