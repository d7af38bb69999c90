"""What the local extensions of Sphinx add to a page: marks of the tests, a line on the run, the package's entries."""

import re
import shutil
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import numpy
import pytest

import duffing

BOOK = Path(__file__).parents[1]
sys.path.append(str(BOOK / "book" / "sphinx"))

import api_page  # noqa: E402 - its folder is put on the path above
import run_report  # noqa: E402 - as above

CONFIG = """
    extensions = ["myst_nb", "test_marks", "page_footer"]
    html_theme = "basic"
    exclude_patterns = ["_build", "tests"]
    myst_enable_extensions = ["dollarmath"]
    tests_page = "tests_page"
    run_times_page = "tests_page"
"""
INDEX = """
    # Book

    ```{toctree}
    tests_page
    tests_page/whole
    tests_page/rest
    ```

    $$ a $$ (eq-1)

    $$ b $$ (eq-2)

    Eq. {eq}`eq-1` and {eq}`eq-2` are checked by `tests/test_a.py::test_one_is_one`, its sign by
    `tests/test_a.py::test_two_is_two`.

    $$ c $$ (eq-own)

    Checked by `tests/test_a.py::test_three_is_three`.
"""
TESTS_PAGE = """
    # All tests

    ```{test-overview}
    ```
"""
WHOLE_PAGE = """
    # Whole

    ```{test-page}
    a
    ```
"""
REST_PAGE = """
    # Rest

    ```{test-page}
    b
    ```
"""
REST = "def test_of_another_file():\n    assert True\n"
TESTS = '''
    """Whole numbers."""
    import pytest

    @pytest.mark.parametrize("n", [1, 2])
    def test_one_is_one(n):
        assert n == n

    def test_two_is_two():
        assert 2 == 2

    def test_three_is_three():
        assert 3 == {three}

    def test_nobody_cites_me():
        pytest.skip("not today")
'''
CONFTEST = f"""
    import sys
    from pathlib import Path
    sys.path.append({str(BOOK / "book" / "sphinx")!r})
    import run_report

    def pytest_configure(config):
        if not hasattr(config, "workerinput"):
            config.pluginmanager.register(run_report.Recorder(Path(__file__).parents[1]))
"""


def write(root, files):
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text), encoding="utf-8")


@pytest.fixture
def book(tmp_path):
    """A small book with tests of its own."""
    head = f"import sys\nsys.path.append({str(BOOK / 'book' / 'sphinx')!r})\n"
    write(tmp_path, {"index.md": INDEX, "tests_page.md": TESTS_PAGE, "pytest.ini": "[pytest]\n"})
    write(tmp_path, {"tests_page/whole.md": WHOLE_PAGE, "tests_page/rest.md": REST_PAGE, "tests/test_b.py": REST})
    write(tmp_path, {"tests/conftest.py": CONFTEST, "tests/test_a.py": TESTS.format(three=3)})
    (tmp_path / "conf.py").write_text(head + textwrap.dedent(CONFIG), encoding="utf-8")
    return tmp_path


def run_tests(book, *options):
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *options]
    return subprocess.run(command, cwd=book, capture_output=True, text=True, encoding="utf-8")


def build(book):
    """Build it as the real book is built; returns the HTML of its pages and what Sphinx complained of."""
    command = [sys.executable, "-m", "sphinx", "-b", "html", "-W", "-n", "--keep-going", ".", "_build/html"]
    run = subprocess.run(command, cwd=book, capture_output=True, text=True, encoding="utf-8")
    complaints = [line for line in run.stderr.splitlines() if "[IPKernelApp]" not in line]
    html = book / "_build" / "html"
    pages = {path.relative_to(html).as_posix().removesuffix(".html"): path for path in html.rglob("*.html")}
    return {name: path.read_text(encoding="utf-8") for name, path in pages.items()}, "\n".join(complaints)


def marks_of(html):
    """What stands beside each equation: a list of (link, text) for each label."""
    found = {}
    for label, paragraph in re.findall(r'id="equation-([\w-]+)".*?<p class="test-marks">(.*?)</p>', html, re.DOTALL):
        links = re.findall(r'href="([^"]+)".*?>(?=<span)(.*?)</a>', paragraph, re.DOTALL)
        found[label] = [(link, re.sub(r"<[^>]+>", "", text)) for link, text in links]
    return found


def plain(html):
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", html))


def words(found):
    return {label: [text.partition(":")[0] for _, text in texts] for label, texts in found.items()}


def test_a_mark_beside_each_equation_leads_to_its_tests_and_says_how_they_ended(book):
    write(book, {"tests/test_a.py": TESTS.format(three=4)})
    assert run_tests(book, "-n2").returncode == 1
    html, complaints = build(book)
    assert complaints == ""
    found = marks_of(html["index"])
    assert words(found) == {"eq-1": ["✓ tested"] * 2, "eq-2": ["✓ tested"] * 2, "eq-own": ["✗ test fails"]}
    link, text = found["eq-1"][0]
    assert text == "✓ tested: One is one"
    page, anchor = link.split("#")
    assert page == "tests_page/whole.html" and f'id="{anchor}"' in html["tests_page/whole"]
    listed, overview = (plain(html[name]) for name in ("tests_page/whole", "tests_page"))
    assert "One is one – ✓ passed, 2 cases" in listed and "Three is three – ✗ failed" in listed
    assert "Nobody cites me – ○ skipped" in listed
    assert "3 passed, 1 failed, 1 skipped, with Python" in overview
    assert re.search(r"Rest: 1 passed, \d+ s Whole: 2 passed, 1 failed, 1 skipped, \d+ s", overview)
    assert "Of another file – ✓ passed" in plain(html["tests_page/rest"]) and "Of another file" not in listed
    assert "assert 3 == 4" in listed and "not today" not in listed, "the source of the cited tests, and of those alone"
    assert "checked by" not in html["index"].lower() and "test_one_is_one" not in html["index"], "marks say it"


def test_a_test_cited_within_prose_becomes_a_mark_there(book):
    prose = "It holds (`tests/test_a.py::test_one_is_one`), and twelve more words of prose stand here "
    prose += "beside it, which are checked by nobody."
    write(book, {"index.md": INDEX + f"\n    {prose}\n"})
    html, complaints = build(book)
    assert complaints == ""
    assert re.search(r"It holds \(<a [^>]*><span class=\"test-mark not-run\">○ test not run", html["index"])
    assert "twelve more words of prose" in html["index"] and "test_one_is_one" not in html["index"]


def test_without_a_run_of_the_tests_on_this_very_code_a_mark_says_so(book):
    not_run = {"eq-1": ["○ test not run"] * 2, "eq-2": ["○ test not run"] * 2, "eq-own": ["○ test not run"]}
    html, complaints = build(book)
    assert (words(marks_of(html["index"])), complaints) == (not_run, "")
    assert run_tests(book).returncode == 0
    assert words(marks_of(build(book)[0]["index"]))["eq-own"] == ["✓ tested"], "pages are written anew"
    write(book, {"tests/test_a.py": TESTS.format(three="1 + 2")})
    html, complaints = build(book)
    assert (words(marks_of(html["index"])), complaints) == (not_run, "")


def test_the_overview_leads_to_the_slow_tests_the_slowest_first(book):
    record(book, Report("tests/test_a.py::test_one_is_one[1]", "passed", 4.0)).pytest_sessionfinish()
    record(book, Report("tests/test_b.py::test_of_another_file", "passed", 7.4)).pytest_sessionfinish()
    record(book, Report("tests/test_a.py::test_two_is_two", "passed", 2.9)).pytest_sessionfinish()
    html, complaints = build(book)
    assert complaints == ""
    found = re.findall(r'<a [^>]*href="([^"]+)"[^>]*>([^<]+)</a>(, \d+ s)', html["tests_page"])
    assert [(text, took) for _, text, took in found] == [("Of another file", ", 7 s"), ("One is one", ", 4 s")]
    for link, _, _ in found:
        page, anchor = link.split(".html#")
        assert f'id="{anchor}"' in html[page]


def test_a_file_of_tests_on_no_page_or_on_two_fails_the_build(book):
    write(book, {"tests/test_c.py": REST, "tests_page/rest.md": REST_PAGE.replace("    b", "    b a")})
    complaints = build(book)[1]
    assert "tests/test_c.py stands on no page of tests" in complaints
    assert "tests/test_a.py stands on two pages of tests: tests_page/rest and tests_page/whole" in complaints


def test_an_equation_without_a_test_fails_the_build(book):
    write(book, {"index.md": INDEX + "\n    $$ d $$ (eq-lonely)\n"})
    assert "no test is named for the equation eq-lonely" in build(book)[1]


class Report:
    """What pytest tells of one phase of a test."""

    def __init__(self, nodeid, outcome, duration=0.0, **more):
        self.nodeid, self.outcome, self.duration = nodeid, outcome, duration
        vars(self).update(more)


def record(book, *reports):
    recorder = run_report.Recorder(book)
    for report in reports:
        recorder.pytest_runtest_logreport(report)
    return recorder


def test_a_later_run_of_some_tests_adds_to_the_report_of_the_same_code(book):
    record(book, Report("a", "passed"), Report("b", "failed")).pytest_sessionfinish()
    record(book, Report("b", "passed")).pytest_sessionfinish()
    assert run_report.of_this_state(book)["outcomes"] == {"a": "passed", "b": "passed"}
    write(book, {"tests/test_a.py": "x = 1"})
    record(book, Report("c", "passed")).pytest_sessionfinish()
    assert run_report.of_this_state(book)["outcomes"] == {"c": "passed"}
    assert [path.name for path in (book / "_build").iterdir()] == ["tests.json"]


def test_a_test_is_as_good_as_its_worst_phase():
    phases = {"setup": "passed", "call": "failed", "teardown": "passed"}
    recorder = record(BOOK, *(Report("a", outcome) for outcome in phases.values()), Report("b", "skipped"))
    recorder.pytest_runtest_logreport(Report("c", "passed", wasxfail="known"))
    assert recorder.outcomes == {"a": "failed", "b": "skipped", "c": "skipped"}


def test_the_times_of_a_tests_phases_and_cases_add_up_and_the_slow_ones_are_listed(book):
    reports = [Report("a::b[1]", "passed", 2.0), Report("a::b[1]", "passed", 0.5), Report("a::b[2]", "passed", 1.0)]
    record(book, *reports, Report("a::c", "passed", 2.5)).pytest_sessionfinish()
    record(book, Report("a::d", "passed", 4.0)).pytest_sessionfinish()
    assert run_report.seconds_of(run_report.of_this_state(book)["durations"]) == {"a::b": 3.5, "a::c": 2.5, "a::d": 4.0}
    (book / "tools").mkdir()
    run_report.main(book)
    assert (book / "tools" / "slow_tests.txt").read_text(encoding="utf-8").split() == ["a::b", "a::d"]
    write(book, {"tests/new.py": ""})
    with pytest.raises(SystemExit, match="run `make test` first"):
        run_report.main(book)


def test_code_that_was_edited_during_a_run_is_not_reported_as_tested(book):
    recorder = record(book, Report("a", "passed"))
    write(book, {"tests/new.py": ""})
    recorder.pytest_sessionfinish()
    assert not run_report.place(book).exists()


@pytest.mark.parametrize("text", ["", "{", '{"state": 1}'])
def test_a_report_that_cannot_be_read_counts_as_none(tmp_path, text):
    write(tmp_path, {"_build/tests.json": text})
    assert run_report.of_this_state(tmp_path)["outcomes"] == {}


def test_the_worst_of_a_tests_cases_counts():
    outcomes = {"a::b[1]": "passed", "a::b[2]": "failed", "a::c": "skipped", "a::d[x[0]]": "passed"}
    assert run_report.by_function(outcomes) == {"a::b": ("failed", 2), "a::c": ("skipped", 1), "a::d": ("passed", 1)}


def test_a_page_with_cells_says_how_long_it_ran_and_with_which_versions(book):
    cells = "---\nfile_format: mystnb\nkernelspec: {name: python3, display_name: Python 3, language: python}\n---\n"
    page = "# Page\n\n```{code-cell} python\nimport time\ntime.sleep(0.3)\n```\n"
    write(book, {"index.md": INDEX.replace("    tests_page\n", "    tests_page\n    page\n", 1)})
    (book / "page.md").write_text(cells + page, encoding="utf-8")
    begin = time.monotonic()
    html, complaints = build(book)
    elapsed = time.monotonic() - begin
    assert complaints == ""
    (line,) = re.findall(r'<p class="page-run">(.*?)</p>', html["page"], re.DOTALL)
    seconds = re.search(r"ran in (\d+\.\d) s on \d{4}-\d\d-\d\d, with", line)[1]
    assert 0.3 <= float(seconds) < elapsed + 0.1
    assert f"Python {sys.version.split()[0]}" in line
    assert f"numpy {numpy.__version__}" in line
    assert 'href="tests_page.html"' in line
    assert "page-run" not in html["index"], "no cells, no line"


def link(word):
    return f"<{word}>"


def test_a_docstring_in_plain_text_becomes_a_list_of_its_parameters():
    docstring = """First |v|^p line, x_u - x_s,
    goes on.

    alpha : the `damping`
        coefficient
    t (n,), states (2, n) : times*
    """
    lines = [line.removeprefix("    ") for line in docstring.splitlines()]
    assert api_page.to_rst(lines, link) == [
        r"First \|v\|^p line, x\_u - x\_s, goes on.",
        "",
        "",
        "- ``alpha``: the <damping> coefficient",
        r"- ``t (n,), states (2, n)``: times\*",
        "",
    ]


def test_a_formula_on_lines_of_its_own_stays_as_it_is():
    rst = api_page.to_rst(["Let", "", "    a = b_*", "", "- not a list"], link)
    assert rst == ["Let", "", "::", "", "        a = b_*", "", r"\- not a list", ""]


def test_a_heading_of_a_docstring_is_shown_without_its_dashes():
    rst = api_page.to_rst(
        ["Parameters", "----------", "t : times", "", "Raises", "------", "ValueError : if not"], link
    )
    assert rst == ["**Parameters**", "", "", "- ``t``: times", "", "**Raises**", "", "", "- ``ValueError``: if not", ""]


def test_names_in_docstrings_lead_to_the_nearest_entry():
    names = api_page.Names(("duffing", "vectorized", "book", "proof"))
    assert (
        names.link("integrate", "duffing.integrators.rk4") == ":py:obj:`integrate <duffing.integrators.rk4.integrate>`"
    )
    assert names.link("splitting", "duffing.integrators.rk4") == ":py:obj:`splitting <duffing.splitting>`"
    assert names.link("flow", "duffing.integrators.rk4") == ":py:mod:`flow <duffing.flow>`"
    assert names.link("no such name", "duffing.integrators.rk4") == "``no such name``"


def test_the_pages_on_the_package_hold_every_public_name_and_every_module(tmp_path):
    rooms = [room for package in ("duffing", "vectorized", "book", "proof") for room in api_page.rooms_of(package)]
    assert {path.stem for path in (BOOK / "chapters" / "api").glob("*.md")} == set(rooms), "a page for each room"
    shutil.copytree(BOOK / "chapters" / "api", tmp_path / "api")
    pages = "\n".join(f"api/{room}" for room in rooms)
    (tmp_path / "index.md").write_text(
        f"# The package\n\n```{{toctree}}\n{pages}\n```\n\n```{{package-overview}}\n```\n", encoding="utf-8"
    )
    head = f"import sys\nsys.path.append({str(BOOK / 'book' / 'sphinx')!r})\n"
    (tmp_path / "conf.py").write_text(
        head + 'extensions = ["myst_nb", "api_page"]\nhtml_theme = "basic"\n', encoding="utf-8"
    )
    html, complaints = build(tmp_path)
    assert complaints == ""
    for name in duffing.__all__:
        assert html["index"].count(f'id="duffing.{name}"') == 1, name
    for package in ("duffing", "vectorized", "book", "proof"):
        for name in api_page.modules_of(package):
            assert html[f"api/{name.rpartition('.')[0]}"].count(f'id="module-{name}"') == 1, name


NUMBERS = """
    ---
    file_format: mystnb
    kernelspec: {name: python3, display_name: Python 3, language: python}
    ---
    # Page

    ```{code-cell} python
    from myst_nb import glue
    glue("small", -1.36e-3, display=False)
    ```

    It is {glue:text}`small:.2e`, code stays `-1e-03`.

    | a | b |
    | :-- | :-- |
    | -0.5 | `-0.5` |
"""


def test_glued_numbers_and_tables_are_typeset_and_code_is_not(tmp_path):
    (tmp_path / "index.md").write_text(textwrap.dedent(NUMBERS).lstrip(), encoding="utf-8")
    head = f"import sys\nsys.path[:0] = [{str(BOOK / 'book' / 'sphinx')!r}, {str(BOOK)!r}]\n"
    (tmp_path / "conf.py").write_text(
        head + 'extensions = ["myst_nb", "typeset_numbers"]\nhtml_theme = "basic"\n', encoding="utf-8"
    )
    html, _ = build(tmp_path)
    assert 'It is <span class="pasted-text">\u22121.36 \u00d7 10\u207b\u00b3</span>' in html["index"]
    assert "<p>\u22120.5</p>" in html["index"]
    assert html["index"].count("-1e-03") == html["index"].count(">-0.5<") == 1
