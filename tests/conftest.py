import sys
from pathlib import Path

BOOK = Path(__file__).parents[1]
sys.path.append(str(BOOK / "book" / "sphinx"))

import run_report  # noqa: E402 - its folder is put on the path above

# The tests in a browser need the built book: `make check-book` calls them by their folder.
collect_ignore = ["browser"]


def pytest_addoption(parser):
    parser.addoption(
        "--regenerate",
        action="store_true",
        help="write the figures' reference data and images anew instead of comparing with them",
    )


def pytest_configure(config):
    if not hasattr(config, "workerinput"):  # one process writes what all workers found
        config.pluginmanager.register(run_report.Recorder(BOOK))
