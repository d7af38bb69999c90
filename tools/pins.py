"""Compares what is installed in this Python's environment with the pins of environment.txt: python tools/pins.py

Says what is missing or of another version, and fails then. `make` asks it when somebody has installed or removed a
package by hand, and puts the pins back; packages that environment.txt does not know are left alone.
"""

import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from packaging.requirements import Requirement

PINS = Path(__file__).parents[1] / "environment.txt"


def changed(lines):
    """A line for each pin ("name==version ; marker") that counts on this system and is not what is installed."""
    for line in lines:
        if line.startswith(("#", "-")) or not line.strip():
            continue
        pin = Requirement(line)
        if pin.marker is not None and not pin.marker.evaluate():
            continue
        try:
            found = version(pin.name)
        except PackageNotFoundError:
            found = "missing"
        if found == "missing" or not pin.specifier.contains(found, prereleases=True):
            yield f"{pin.name} is {found}, pinned {pin.specifier}"


if __name__ == "__main__":
    sys.exit("\n".join(changed(PINS.read_text(encoding="utf-8").splitlines())) or None)
