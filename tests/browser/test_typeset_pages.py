"""Numbers on the built pages are typeset: no computer's notation in what a reader reads. `make check-book`.

Looked at is the text of prose, captions and tables. Code, mathematics, file names and the pages that document code are
left out; of the outputs of cells only the names of NumPy's types are looked for, since no output should show them.
"""

import re

import pytest
from bs4 import BeautifulSoup
from visits import HTML, PAGES

READ = [page for page in PAGES if re.match(r"chapters/(?!api|tests)", page)]
APART = "script, style, code, pre, svg, .math, .MathJax, mjx-container, .highlight, .sig, nav, .visually-hidden"
IN_TEXT = {
    "a power of ten in a computer's notation": re.compile(r"(?<![\w.])\d+(?:\.\d+)?e[+-]?\d+\b"),
    "a hyphen for a minus": re.compile(r"(?:(?<=[\s(\[=])|^)-\.?\d"),
    "an error of zero": re.compile(r"±\s*0(?:\.0+)?(?![\d.])"),
    "a type of NumPy's": re.compile(r"np\.(?:float|int|bool)"),
    "mathematics that was left as it was written": re.compile(r"\$\\?\w"),
}
IN_OUTPUT = re.compile(r"np\.(?:float|int|bool)\w*\(")


def offences(html):
    """(what, where) of a page: the words around each offending place."""
    main = BeautifulSoup(html, "html.parser").main
    found = []
    for output in main.select(".cell_output pre"):
        found += [
            ("a type of NumPy's", around(output.get_text(), match)) for match in IN_OUTPUT.finditer(output.get_text())
        ]
    for apart in main.select(APART):
        apart.replace_with(" ")
    # Each block by itself: what ends one paragraph or cell does not begin the next.
    for block in main.find_all(["p", "td", "th", "li", "dd", "dt", "h1", "h2", "h3", "h4"]):
        if block.find(["p", "td", "li", "dd"]):
            continue
        text = block.get_text()
        found += [(what, around(text, match)) for what, one in IN_TEXT.items() for match in one.finditer(text)]
    return found


def around(text, match):
    return " ".join(text[max(0, match.start() - 30) : match.end() + 20].split())


@pytest.mark.parametrize("page", READ)
def test_numbers_on_a_page_are_typeset(page):
    assert offences((HTML / page).read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    ("shown", "what"),
    [
        ("<p>an error of 1.4e-04 remains</p>", "a power of ten in a computer's notation"),
        ("<table><tr><td>-0.057</td></tr></table>", "a hyphen for a minus"),
        ("<p>from (-0.5, 1)</p>", "a hyphen for a minus"),
        ("<p>1.000 ± 0.000</p>", "an error of zero"),
        (r"<p>not tied to $\mu_c$</p>", "mathematics that was left as it was written"),
        ('<div class="cell_output"><pre>[np.float64(0.38)]</pre></div>', "a type of NumPy's"),
        ("<p>1.4 × 10⁻⁴, −0.5, 0.1-0.2, 2026-11-28, ± 0.011</p>", None),
        ("<p><code>1e-08</code> and <code>-1</code></p>", None),
        ('<p><span class="math">-0.5</span></p>', None),
    ],
)
def test_an_offence_is_found_and_nothing_else(shown, what):
    found = offences(f"<html><main>{shown}</main></html>")
    assert [name for name, _ in found] == ([what] if what else [])
