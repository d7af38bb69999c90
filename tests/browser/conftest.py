"""A browser, a visit to each page, and a server of this machine."""

import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest
from playwright.sync_api import sync_playwright
from visits import CHROMIUM, HTML, MISSING, PAGES, QUIET, Visit


def pytest_configure(config):
    if MISSING:
        raise pytest.UsageError(MISSING)


@pytest.fixture(scope="session")
def browser():
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=CHROMIUM, args=[f"--{flag}" for flag in QUIET])
        yield browser
        browser.close()


@pytest.fixture(scope="session", params=PAGES)
def visit(browser, request):
    """Each page of the book in turn, opened as a file; all tests of a page share the one visit."""
    visit = Visit(browser, HTML.as_uri(), request.param)
    yield visit
    visit.context.close()


@pytest.fixture
def opened(browser):
    """opened(home, address): a visit of the test's own; home None is the book as files."""
    visits = []

    def make(home, address):
        visits.append(Visit(browser, home or HTML.as_uri(), address))
        return visits[-1]

    yield make
    for visit in visits:
        visit.context.close()


@pytest.fixture(scope="session")
def server():
    """The book's address on a server of this machine."""

    class Silent(SimpleHTTPRequestHandler):
        def log_message(self, *args):
            """Says nothing."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Silent, directory=HTML))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()
