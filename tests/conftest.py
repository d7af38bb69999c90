"""What holds for every test: nothing personal is seen, Ctrl-C arrives, no test waits for ever, outcomes are noted."""

import signal
import sys
import threading
from pathlib import Path

import pytest

BOOK = Path(__file__).parents[1]
sys.path.append(str(BOOK / "book" / "sphinx"))
sys.path.insert(0, str(BOOK))  # the package that lies here is the one that is tested, whatever is installed

import isolation  # noqa: E402 - its folder is put on the path above
import run_report  # noqa: E402 - as above

# Before anything imports Matplotlib; the processes that tests start get the same.
isolation.isolate(BOOK / "_build" / "kernels", BOOK)
isolation.warm(BOOK / "_build" / "kernels")

# The tests in a browser need the built book: `make check-book` calls them by their folder.
collect_ignore = ["browser"]
# Seconds after which a test that waits is given up; some minutes later pytest ends the process (pyproject.toml).
PATIENCE = 600


def pytest_addoption(parser):
    parser.addoption(
        "--regenerate",
        action="store_true",
        help="write the figures' reference data and images anew instead of comparing with them",
    )


def pytest_configure(config):
    if not hasattr(config, "workerinput"):  # one process writes what all workers found
        config.pluginmanager.register(run_report.Recorder(BOOK))


def pytest_collection_modifyitems(items):
    slow = (BOOK / "tools" / "slow_tests.txt").read_text(encoding="utf-8").split()
    for item in items:
        if item.nodeid.partition("[")[0] in slow:
            item.add_marker("slow")


@pytest.fixture(autouse=True)
def interruptible():
    """Ctrl-C interrupts, for a test and for what it starts, also where the run ignores it (nohup, a job system)."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(autouse=True)
def bounded(interruptible):
    """A test that waits for what does not come fails with a sentence, and what it started is ended by its own means."""
    if not hasattr(signal, "SIGALRM") or threading.current_thread() is not threading.main_thread():
        yield
        return

    def give_up(number, frame):
        raise TimeoutError(f"the test has waited for {PATIENCE} seconds")

    before = signal.signal(signal.SIGALRM, give_up)
    signal.alarm(PATIENCE)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)
