"""Beside each numbered equation a mark that leads to the test that checks it, and says how its last run ended.

A chapter says it in words: "Eq. {eq}`eq-1` is checked by `tests/test_x.py::test_y`". From such a paragraph each
equation gets its marks; the page itself does not show it. A test cited within other prose becomes a mark there. The
pages of tests show the source of each, with its outcome, which comes from the last run of the tests if that was a run
of this very code (run_report.py); else the mark says that the test was not run. A numbered equation without a test is a
warning, which fails the build; so is a file of tests that stands on no page, or on two.
"""

import ast
import re
import time
from pathlib import Path

import run_report
from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective
from sphinx.util.nodes import make_refnode

CITED = re.compile(r"tests/test_\w+\.py::test_\w+")
ON_A_PAGE = re.compile(r"^```\{test-page\}(.*?)^```", re.MULTILINE | re.DOTALL)
# How a mark looks and reads: a sign and a word, since a colour alone says nothing to many readers.
MARKS = {
    "passed": ("✓", "tested"),
    "failed": ("✗", "test fails"),
    "skipped": ("○", "test skipped"),
    "not run": ("○", "test not run"),
}
logger = logging.getLogger(__name__)


def anchor(test):
    """Id of a test, or of a file of tests, on its page."""
    return re.sub(r"[^a-z0-9]+", "-", test.removeprefix("tests/").replace(".py", "").lower())


def in_words(test):
    """The name of a test as the sentence that it is."""
    words = test.rpartition("::test_")[2].replace("_", " ")
    return words[0].upper() + words[1:]


def outcome(app, test):
    """("passed", number of cases) and the like, for this state of the code."""
    return app.config.test_run["outcomes"].get(test, ("not run", 0))


def page_of(app, test):
    """The page that shows a test or a file of tests."""
    return app.config.test_pages.get(test.partition("::")[0], app.config.tests_page)


def is_reference(node):
    return isinstance(node, pending_xref) and node.get("reftype") == "eq"


def is_citation(node):
    return isinstance(node, nodes.literal) and CITED.fullmatch(node.astext()) is not None


def tells_tests_alone(paragraph):
    """Whether a paragraph says which tests check what, and little else: at most ten words to each test."""
    cited = [node.astext() for node in paragraph.findall(is_citation)]
    words = paragraph.astext().split()
    return bool(cited) and "checked by" in " ".join(words).lower() and len(words) - len(cited) <= 10 * len(cited)


def checks(doctree):
    """Which tests check which equation: dict label -> tests.

    Read from the paragraphs "Eq. ... is checked by ...": a test checks the equations that are named since the last
    test; "Eq. 8 by A and the signs by B" gives both to 8. "Checked by A" alone speaks of the last equation before it.
    """
    found, last = {}, []
    for block in doctree.findall(lambda node: isinstance(node, nodes.paragraph | nodes.math_block)):
        if isinstance(block, nodes.math_block):
            last = [block["label"]] if block.get("label") else last
            continue
        text = re.sub(r"\s+", " ", block.astext())
        if "checked by" not in text.lower():
            continue
        equations, answered = last if text.startswith("Checked by") else [], False
        for node in block.findall(lambda node: is_reference(node) or is_citation(node)):
            if is_citation(node):
                answered = True
                for label in equations:
                    found.setdefault(label, []).append(node.astext())
            else:
                equations, answered = ([] if answered else equations) + [node["reftarget"]], False
    return found


def place_marks(app, doctree):
    tests = checks(doctree)
    for equation in list(doctree.findall(nodes.math_block)):
        label = equation.get("label")
        if label is None:
            continue
        if label not in tests:
            logger.warning(f"no test is named for the equation {label}", location=equation, type="test_marks")
            continue
        marks = nodes.paragraph(classes=["test-marks"])
        marks += [nodes.inline(test=test, kind="mark") for test in dict.fromkeys(tests[label])]
        equation.parent.insert(equation.parent.index(equation) + 1, marks)
    for paragraph in list(doctree.findall(nodes.paragraph)):
        if tells_tests_alone(paragraph):
            paragraph.parent.remove(paragraph)
    for literal in list(doctree.findall(is_citation)):
        literal.replace_self(nodes.inline(test=literal.astext(), kind="mark"))


def fill(app, doctree, page):
    """Turn what was placed into links with the outcome of the last run."""
    for node in list(doctree.findall(lambda node: isinstance(node, nodes.inline) and "test" in node)):
        test = node["test"]
        how, cases = outcome(app, test)
        sign, word = MARKS[how]
        if node["kind"] == "outcome":
            count = f", {cases} cases" if cases > 1 else ""
            seconds = app.config.test_run["seconds"].get(test, 0.0)
            took = f", {seconds:.0f} s" if seconds >= run_report.SLOW else ""
            node += nodes.Text(f"{sign} {how}{count}{took}")
            node["classes"] += ["test-outcome", how.replace(" ", "-")]
        else:
            shown = nodes.inline(classes=["test-mark", how.replace(" ", "-")])
            shown += [nodes.Text(f"{sign} {word}"), nodes.inline("", f": {in_words(test)}", classes=["spoken"])]
            node.replace_self(link(app, page, test, shown, f"{in_words(test)}: {how}"))
    for node in list(doctree.findall(nodes.inline)):
        if "summary" in node:
            node += nodes.Text(summary(app.config.test_run))
        elif "totals" in node:
            node += nodes.Text(totals(app, node["totals"]))
    for node in list(doctree.findall(lambda node: isinstance(node, nodes.bullet_list) and "slow" in node)):
        node += slow(app, page)
        if not node.children:
            node.parent.replace(node, nodes.paragraph("", "None."))


def link(app, page, test, shown, title=None):
    """A link from a page to a test, or to a file of tests, on its page."""
    return make_refnode(app.builder, page, page_of(app, test), anchor(test), shown, title)


def totals(app, page):
    """How the tests of a page ended, and how long they took."""
    run = app.config.test_run
    ended = {test: how for test, (how, _) in run["outcomes"].items() if page_of(app, test) == page}
    seconds = sum(run["seconds"].get(test, 0.0) for test in ended)
    return f"{counted(ended.values())}, {seconds:.0f} s" if ended else "not run"


def slow(app, page):
    """A list item for each slow test of the last run, the slowest first."""
    for test, seconds in sorted(app.config.test_run["seconds"].items(), key=lambda item: -item[1]):
        if seconds >= run_report.SLOW:
            named = link(app, page, test, nodes.Text(in_words(test)))
            yield nodes.list_item("", nodes.paragraph("", "", named, nodes.Text(f", {seconds:.0f} s")))


def counted(ended):
    ended = list(ended)
    return ", ".join(f"{ended.count(how)} {how}" for how in ("passed", "failed", "skipped") if how in ended)


def summary(run):
    """The last run of the tests in one sentence."""
    if not run["outcomes"]:
        return (
            "The tests were not run on this state of the code; after “make test” the next build shows how they ended."
        )
    when = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime(run["when"]))
    count = counted(how for how, _ in run["outcomes"].values())
    used = ", ".join(f"{name} {number}" for name, number in run["versions"].items())
    return f"Last run of the tests on this very code: {when}, {count}, with {used}."


class TestOverview(SphinxDirective):
    """`{test-overview}`: how the last run ended, the pages of tests with their totals, and the slow tests."""

    def run(self):
        pages = nodes.bullet_list(bullet="-")
        for page in sorted(set(self.config.test_pages.values())):
            where = {"reftarget": f"/{page}", "refdoc": self.env.docname, "refexplicit": False, "refwarn": True}
            named = pending_xref("", nodes.inline(), refdomain="std", reftype="doc", **where)
            pages += nodes.list_item("", nodes.paragraph("", "", named, nodes.Text(": "), nodes.inline(totals=page)))
        title = nodes.title("", "Slow tests")
        which = nodes.paragraph("", f"These took {run_report.SLOW:g} s or more in the last run, all cases together.")
        section = nodes.section("", title, which, nodes.bullet_list(bullet="-", slow=True), ids=["slow-tests"])
        return [nodes.paragraph("", "", nodes.inline(summary=True)), pages, section]


class TestPage(SphinxDirective):
    """`{test-page}` and names of files in its lines ("flow" for tests/test_flow.py): a section for each, with the
    outcome of each test and the source of those cited."""

    has_content = True

    def run(self):
        root = Path(self.env.srcdir)
        cited = set()
        for page in self.env.found_docs:
            path = Path(self.env.doc2path(page))
            self.env.note_dependency(str(path))
            cited |= set(CITED.findall(path.read_text(encoding="utf-8")))
        result = []
        for name in " ".join(self.content).split():
            path = root / "tests" / f"test_{name}.py"
            self.env.note_dependency(str(path))
            result.append(self.file(path, path.relative_to(root).as_posix(), cited))
        return result

    def file(self, path, name, cited):
        text = path.read_text(encoding="utf-8")
        tree = ast.parse(text)
        section = nodes.section("", nodes.title("", "", nodes.literal("", name)), ids=[anchor(name)], names=[name])
        section += nodes.paragraph("", (ast.get_docstring(tree) or "").partition("\n\n")[0].replace("\n", " "))
        tests = nodes.bullet_list(bullet="-")
        section += tests
        for node in tree.body:
            test = f"{name}::{getattr(node, 'name', '')}"
            if not isinstance(node, ast.FunctionDef) or not node.name.startswith("test_"):
                continue
            state = nodes.inline(test=test, kind="outcome")
            item = nodes.list_item("", nodes.paragraph("", "", nodes.Text(f"{in_words(test)} – "), state))
            item["ids"] = [anchor(test)]
            if test in cited:
                first = min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])
                source = "\n".join(text.splitlines()[first - 1 : node.end_lineno])
                item += nodes.literal_block(source, source, language="python")
            tests += item
        return section


def find_pages(app, config):
    """Which page shows which file of tests: the pages are those in the folder of the overview's name."""
    root, found = Path(app.srcdir), {}
    for path in sorted((root / config.tests_page).glob("*.md")):
        for name in " ".join(ON_A_PAGE.findall(path.read_text(encoding="utf-8"))).split():
            file, page = f"tests/test_{name}.py", path.relative_to(root).with_suffix("").as_posix()
            if found.setdefault(file, page) != page:
                logger.warning(f"{file} stands on two pages of tests: {found[file]} and {page}", type="test_marks")
    for path in sorted((root / "tests").glob("test_*.py")):
        if path.relative_to(root).as_posix() not in found:
            logger.warning(f"tests/{path.name} stands on no page of tests", type="test_marks")
    config.test_pages = found


def load_run(app, config):
    report = run_report.of_this_state(app.srcdir)
    functions = {
        "outcomes": run_report.by_function(report["outcomes"]),
        "seconds": run_report.seconds_of(report["durations"]),
    }
    config.test_run = {**report, **functions}


def setup(app):
    app.add_config_value("tests_page", "tests", "env")
    app.add_config_value("test_run", {}, "html")  # another run: every page is written anew, none is read anew
    app.add_config_value("test_pages", {}, "html")  # as above
    app.add_directive("test-overview", TestOverview)
    app.add_directive("test-page", TestPage)
    app.add_css_file("marks.css")
    app.connect("config-inited", find_pages)
    app.connect("config-inited", load_run)
    app.connect("doctree-read", place_marks)
    app.connect("doctree-resolved", fill)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
