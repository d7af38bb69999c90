"""Every page of the book works without a network: equations, figures, links and the search."""

from functools import cache
from html.parser import HTMLParser
from urllib.parse import unquote, urldefrag, urlsplit

import pytest
from visits import FRONT, HTML, PAGES

# Maths that MathJax left as it was written: outside code, and outside what it made itself.
UNTOUCHED = r"""() => {
  const walk = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  const left = [], ours = "pre, code, script, style, mjx-container";
  while (walk.nextNode()) {
    const node = walk.currentNode;
    if (/\\[(\[]|\$\$|\\begin\{/.test(node.data) && !node.parentElement.closest(ours))
      left.push(node.data);
  }
  return left;
}"""


@cache
def anchors(address):
    """What a link into a page may name, as written in its file."""
    found = set()

    class Reader(HTMLParser):
        def handle_starttag(self, tag, attrs):
            found.update(value for name, value in attrs if name in ("id", "name"))

    Reader().feed((HTML / address).read_text(encoding="utf-8"))
    return found


def test_a_page_asks_the_network_for_nothing_and_has_no_error(visit):
    assert visit.requests == []
    assert visit.errors == []


def test_every_equation_is_typeset(visit):
    written, set_in_type, wrong = visit.value(
        "['.math', '.math > mjx-container', '[data-mml-node=merror], mjx-merror']"
        ".map(what => document.querySelectorAll(what).length)"
    )
    assert set_in_type == written
    assert wrong == 0
    assert visit.value(UNTOUCHED) == []


def test_every_picture_is_there(visit):
    empty = visit.value(
        "() => [...document.images].filter(image => !image.complete || !image.naturalWidth).map(image => image.src)"
    )
    assert empty == []
    figures = visit.value("""() => [...document.querySelectorAll("figure")].map(figure => {
        const shown = [...figure.querySelectorAll("img, svg, canvas")].filter(it => !it.closest("mjx-container"));
        return [figure.id, Math.max(0, ...shown.map(it => it.getBoundingClientRect().height))];
    })""")
    assert [name for name, height in figures if height < 50] == []


def test_every_link_inside_the_book_leads_somewhere(visit):
    broken = []
    for link in visit.value("() => [...document.querySelectorAll('a[href]')].map(link => link.href)"):
        address, anchor = urldefrag(link)
        if urlsplit(address).scheme != "file":
            continue
        path = urlsplit(address).path
        inside = unquote(path).removeprefix(f"{HTML.as_posix()}/")
        if not (HTML / inside).is_file() or (anchor and unquote(anchor) not in anchors(inside)):
            broken.append(link)
    assert broken == []


def test_the_front_door_leads_to_the_first_chapter(opened):
    visit = opened(HTML.as_uri(), PAGES[0])
    visit.page.goto(f"{HTML.as_uri()}/{FRONT}")
    visit.page.wait_for_url("**/chapters/index.html")


@pytest.mark.parametrize("from_server", [False, True], ids=["as a file", "from a server"])
def test_the_search_finds_the_tangency(opened, server, from_server):
    visit = opened(server if from_server else HTML.as_uri(), "chapters/model.html")
    visit.page.locator("button.search-button__button:visible").first.click()
    visit.page.keyboard.type("tangency")
    visit.page.keyboard.press("Enter")
    visit.page.wait_for_url("**/search.html?q=tangency*")
    visit.page.wait_for_function("/found/.test(document.querySelector('#search-results .search-summary')?.textContent)")
    found = visit.value("() => [...document.querySelectorAll('#search-results li a')].map(link => link.href)")
    assert any("chapters/tangency.html" in link for link in found)
    assert visit.requests == []
    assert visit.errors == []
