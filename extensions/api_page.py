"""The page on the package, made from its docstrings by Sphinx's autodoc.

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
    """Modules of a package and its folders, no two of one name: dict name -> whole name."""
    folder = Path(import_module(package).__file__).parent
    paths = [path.relative_to(folder).with_suffix("") for path in folder.rglob("*.py") if not path.stem.startswith("_")]
    return {path.name: ".".join((package, *path.parts)) for path in sorted(paths, key=lambda path: path.name)}


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
    """What a word in backticks means: the page's entry for it, or nothing."""

    def __init__(self, package):
        self.package, self.public = package, import_module(package).__all__
        self.modules = modules_of(package)
        self.entries = {}
        for module in self.modules.values():
            for member in members(module):
                place = package if member in self.public else module
                self.entries.setdefault(member, []).append(f"{place}.{member}")

    def link(self, word, module):
        """reStructuredText for a word of the docstrings of a module ("duffing.flow")."""
        entries = self.entries.get(word.removesuffix("()"), [])
        near = [entry for entry in entries if entry.startswith(f"{module}.")]
        for entry in near or entries[: len(entries) == 1]:
            return f":py:obj:`{word} <{entry}>`"
        if word in self.modules:
            return f":py:mod:`{word} <{self.modules[word]}>`"
        return f"``{word}``"


@cache
def names_of(package):
    return Names(package)


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
    names = names_of(app.config.api_package)
    lines[:] = to_rst(lines, lambda word: names.link(word, module))


def skip(app, what, name, obj, skipped, options):
    """Fields of named tuples say nothing but their position: the class's docstring describes them."""
    doc = inspect.getdoc(obj) or ""
    return True if doc.startswith("Alias for field number") else None


class PackagePage(SphinxDirective):
    """`{package-page}`: lines "Theme: module module ..." become a map, the public names, and a section for each theme.

    Modules that no line names come last, so that none is ever missing.
    """

    has_content = True

    def run(self):
        names = names_of(self.config.api_package)
        themes = {}
        for line in filter(None, self.content):
            theme, _, chosen = line.partition(":")
            themes[theme] = chosen.split()
        unknown = {name for chosen in themes.values() for name in chosen} - set(names.modules)
        if unknown:
            raise self.error(f"no such module of {names.package}: {', '.join(sorted(unknown))}")
        told = {name for chosen in themes.values() for name in chosen}
        themes["More"] = [name for name in names.modules if name not in told]
        themes = {theme: chosen for theme, chosen in themes.items() if chosen}
        return [
            self.section("Map", [self.map(themes)]),
            self.section("Public names", self.public_names()),
            *(self.section(theme, [self.module(name) for name in chosen]) for theme, chosen in themes.items()),
        ]

    def section(self, title, content, code=False):
        shown = nodes.literal("", title) if code else nodes.Text(title)
        node = nodes.section("", nodes.title(title, "", shown), ids=[nodes.make_id(f"package {title}")], names=[title])
        node += content
        return node

    def parsed(self, lines):
        """Nodes of lines of reStructuredText."""
        holder = nodes.Element()
        text = StringList(["```{eval-rst}", *lines, "```"], self.get_source_info()[0])
        self.state.nested_parse(text, self.content_offset, holder)
        return holder.children

    def map(self, themes):
        names, lines = names_of(self.config.api_package), []
        for theme, chosen in themes.items():
            lines += [f"**{theme}**", ""]
            for name in chosen:
                (line,) = filter(None, to_rst([first_sentence(names.modules[name])], lambda word: f"``{word}``"))
                path = names.modules[name].partition(".")[2]
                lines.append(f"* :py:mod:`{path} <{names.modules[name]}>`: {line}")
            lines.append("")
        return nodes.container("", *self.parsed(lines), classes=["package-map"])

    def public_names(self):
        package, lines = import_module(self.config.api_package), []
        for name in package.__all__:
            kind = "autofunction" if inspect.isfunction(getattr(package, name)) else "autoclass"
            lines += [f".. {kind}:: {package.__name__}.{name}"]
            lines += ["   :members:", "   :member-order: bysource"] if kind == "autoclass" else []
            lines.append("")
        return self.parsed(lines)

    def module(self, name):
        names = names_of(self.config.api_package)
        offered = [member for member in members(names.modules[name]) if member in names.public]
        lines = [f".. automodule:: {names.modules[name]}", "   :members:", "   :member-order: bysource"]
        lines += [f"   :exclude-members: {', '.join(offered)}"] if offered else []
        content = self.parsed(lines)
        if offered:
            links = ", ".join(f":py:obj:`{member} <{names.package}.{member}>`" for member in offered)
            content += self.parsed([f"Public, documented above: {links}."])
        return self.section(names.modules[name].partition(".")[2], content, code=True)


def setup(app):
    app.setup_extension("sphinx.ext.autodoc")
    app.config.autodoc_preserve_defaults = True
    app.config.autodoc_typehints = "none"  # NamedTuples alone have any, and their docstrings say more
    app.add_config_value("api_package", "duffing", "env")
    app.add_directive("package-page", PackagePage)
    app.connect("autodoc-process-docstring", process)
    app.connect("autodoc-skip-member", skip)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
