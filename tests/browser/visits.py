"""The built book in a real browser, with the network cut: `make check-book`, after `make book`.

Chromium is Debian's (`apt-get install chromium`) or the one that the variable CHROMIUM names. Pages are opened as
files, as by a reader who unpacked the book on a train; the search is tried from a server on this machine as well.
"""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2] / "tools"))

import chromium

HTML = Path(__file__).parents[2] / "_build" / "html"
FRONT = "index.html"  # leads to the first chapter, and is nothing else
WRITTEN = {path.relative_to(HTML).as_posix() for path in HTML.rglob("*.html") if "_static" not in path.parts}
PAGES = sorted(WRITTEN - {FRONT})
CHROMIUM, NO_CHROMIUM = chromium.found()
QUIET = ["no-sandbox", "disable-gpu", "disable-quic", "no-first-run", "disable-background-networking",
         "disable-component-update", "disable-sync"]  # the browser's own habits, not the book's  # fmt: skip

# Missing means failed: a check of the book that skips itself would pass on every machine that cannot make it.
MISSING = NO_CHROMIUM or (None if PAGES else f"there is no book in {HTML}: run `make book` first")


class Visit:
    """A page opened in a tab of its own, and all that went wrong in it: errors, and requests that leave the book."""

    def __init__(self, browser, home, address):
        self.address, self.errors, self.requests = address, [], []
        self.context = browser.new_context(viewport={"width": 1280, "height": 900}, color_scheme="light")
        self.context.route(lambda url: not url.startswith(home), self.cut)
        self.page = self.context.new_page()
        self.page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("requestfailed", lambda request: self.errors.append(f"not loaded: {request.url}"))
        self.page.goto(f"{home}/{address}")
        self.settle()

    def cut(self, route):
        self.requests.append(route.request.url)
        route.abort()

    def settle(self):
        """Wait until equations are typeset, fonts are there and the page is drawn."""
        self.page.evaluate("window.MathJax?.startup?.promise?.then(() => null)")
        self.page.evaluate("document.fonts.ready.then(() => null)")
        self.page.evaluate("new Promise(drawn => requestAnimationFrame(() => requestAnimationFrame(drawn)))")

    def look(self, *, width=1280, theme="light"):
        """Show the page at a width, in a theme; nothing moves on its way there."""
        self.page.set_viewport_size({"width": width, "height": 900})
        self.page.emulate_media(color_scheme=theme, reduced_motion="reduce")
        self.page.wait_for_function("theme => document.documentElement.dataset.theme == theme", arg=theme)
        self.page.wait_for_timeout(
            400
        )  # the theme looks anew, after a pause, at which boxes scroll and need a tab stop
        self.settle()

    def value(self, script, *given):
        """The value of a JavaScript expression, or of a function of what is given, on the page."""
        return self.page.evaluate(script, *given)
