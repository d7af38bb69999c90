"""What a run of the tests leaves for the book: `_build/tests.json`, how each test ended in one state of the code.

tests/conftest.py writes it, test_marks.py reads it. The report names the state it is about, a hash of package, tests
and environment. A later run of some of the tests adds to the report of the same state and replaces that of another.
"""

import json
import os
import sys
import time
from collections import defaultdict
from pathlib import Path

from fingerprint import key, versions

SLOW = 3.0  # seconds from which a test is slow: its time is shown, and `make check` leaves it out
COVERS = ("duffing/**/*", "vectorized/*", "book/**/*", "proof/**/*", "tests/**/*", "environment.txt")
WORST_FIRST = ("failed", "skipped", "passed")
NONE = {"state": "", "when": 0.0, "versions": {}, "outcomes": {}, "durations": {}}


def place(root):
    return Path(root) / "_build" / "tests.json"


def load(root):
    """The report as it was written, or an empty one where there is none or it cannot be read."""
    try:
        return NONE | json.loads(place(root).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return NONE


def save(root, state, outcomes, durations):
    """Add outcomes (test -> one of WORST_FIRST) and durations (test -> seconds) to the report of this state."""
    before = load(root)
    before = before if before["state"] == state else NONE
    both = {"outcomes": before["outcomes"] | outcomes, "durations": before["durations"] | durations}
    report = {"state": state, "when": time.time(), "versions": versions(), **both}
    place(root).parent.mkdir(exist_ok=True)
    unfinished = place(root).with_suffix(f".{os.getpid()}")
    unfinished.write_text(json.dumps(report, indent=1, sort_keys=True), encoding="utf-8")
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


def seconds_of(durations):
    """Dict test function -> seconds of all its cases together."""
    total = defaultdict(float)
    for test, seconds in durations.items():
        total[test.partition("[")[0]] += seconds
    return dict(total)


class Recorder:
    """Pytest plugin of one run: notes how each test ended and how long it took, and saves both when the run ends."""

    def __init__(self, root):
        self.root, self.state, self.outcomes, self.durations = root, key(root, COVERS), {}, defaultdict(float)

    def pytest_runtest_logreport(self, report):
        # Set-up, call and tear-down report one after the other: the worst counts. An expected failure is no success.
        outcome = "skipped" if hasattr(report, "wasxfail") else report.outcome
        both = (outcome, self.outcomes.get(report.nodeid, "passed"))
        self.outcomes[report.nodeid] = min(both, key=WORST_FIRST.index)
        self.durations[report.nodeid] += round(report.duration, 3)

    def pytest_sessionfinish(self):
        # Code that was edited during the run was tested in no state that has a name.
        if self.outcomes and key(self.root, COVERS) == self.state:
            save(self.root, self.state, self.outcomes, self.durations)


def main(root, threshold=SLOW):
    """Write the names of the slow tests, as the last run of the tests measured them: `make slow`."""
    report = of_this_state(root)
    if not report["durations"]:
        sys.exit("The tests were not run on this state of the code: run `make test` first.")
    slow = {test: seconds for test, seconds in seconds_of(report["durations"]).items() if seconds >= threshold}
    (Path(root) / "tools" / "slow_tests.txt").write_text(
        "".join(f"{test}\n" for test in sorted(slow)), encoding="utf-8"
    )
    rest = sum(report["durations"].values()) - sum(slow.values())
    print(f"{len(slow)} slow tests take {sum(slow.values()):.0f} s, the others {rest:.0f} s")


if __name__ == "__main__":
    main(Path(__file__).parents[2], *map(float, sys.argv[1:]))
