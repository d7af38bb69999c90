"""What a run of the tests leaves for the book: `_build/tests.json`, the outcome of each test for one state of the code.

tests/conftest.py writes it, test_marks.py reads it. The report names the state it is about, a hash of package, tests
and environment. A later run of some of the tests adds to the report of the same state and replaces that of another.
"""

import json
import os
import time
from collections import defaultdict
from pathlib import Path

from fingerprint import key, versions

COVERS = ("duffing/**/*", "book/**/*", "proof/**/*", "tests/**/*", "environment.txt")
WORST_FIRST = ("failed", "skipped", "passed")
NONE = {"state": "", "when": 0.0, "versions": {}, "outcomes": {}}


def place(root):
    return Path(root) / "_build" / "tests.json"


def load(root):
    """The report as it was written, or an empty one where there is none or it cannot be read."""
    try:
        return NONE | json.loads(place(root).read_text())
    except (OSError, ValueError):
        return NONE


def save(root, state, outcomes):
    """Add the outcomes (dict test -> one of WORST_FIRST) to the report of this state of the code."""
    before = load(root)
    kept = before["outcomes"] if before["state"] == state else {}
    report = {"state": state, "when": time.time(), "versions": versions(), "outcomes": kept | outcomes}
    place(root).parent.mkdir(exist_ok=True)
    unfinished = place(root).with_suffix(f".{os.getpid()}")
    unfinished.write_text(json.dumps(report, indent=1, sort_keys=True))
    unfinished.replace(place(root))  # whole or not at all, whenever the run is interrupted


def of_this_state(root):
    """The report if it is about the code as it stands now, else an empty one."""
    report = load(root)
    return report if report["state"] == key(root, COVERS) else NONE


def by_function(outcomes):
    """Dict test function -> (worst outcome, number of cases): the cases of a parametrised test are counted together."""
    cases = defaultdict(list)
    for test, outcome in outcomes.items():
        cases[test.partition("[")[0]].append(outcome)
    return {test: (min(found, key=WORST_FIRST.index), len(found)) for test, found in cases.items()}


class Recorder:
    """Pytest plugin of one run: notes each outcome and saves them when the run ends."""

    def __init__(self, root):
        self.root, self.state, self.outcomes = root, key(root, COVERS), {}

    def pytest_runtest_logreport(self, report):
        # Set-up, call and tear-down report one after the other: the worst counts. An expected failure is no success.
        outcome = "skipped" if hasattr(report, "wasxfail") else report.outcome
        both = (outcome, self.outcomes.get(report.nodeid, "passed"))
        self.outcomes[report.nodeid] = min(both, key=WORST_FIRST.index)

    def pytest_sessionfinish(self):
        # Code that was edited during the run was tested in no state that has a name.
        if self.outcomes and key(self.root, COVERS) == self.state:
            save(self.root, self.state, self.outcomes)
