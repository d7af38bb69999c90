"""A hash of code and environment: what was computed from one state of them is not shown beside another."""

import hashlib
import platform
import re
from importlib.metadata import requires, version
from pathlib import Path


def versions():
    """Versions of Python and of the packages that `duffing` computes with: dict name -> version."""
    direct = [line for line in requires("duffing") if "extra" not in line]
    names = sorted(re.match(r"[\w.-]+", line)[0] for line in direct)
    return {"Python": platform.python_version(), **{name: version(name) for name in names}}


def key(root, patterns):
    """Hash (hex) of the names and contents of all files under root that match a pattern, and of `versions()`.

    What Python and numba compiled (`__pycache__`) follows from the rest and does not count.
    """
    digest = hashlib.sha256(f"{versions()}".encode())
    found = {path for pattern in patterns for path in Path(root).glob(pattern) if path.is_file()}
    for path in sorted(path for path in found if "__pycache__" not in path.parts):
        content = hashlib.sha256(path.read_bytes()).hexdigest()
        digest.update(f"{path.relative_to(root).as_posix()} {content}\n".encode())
    return digest.hexdigest()[:16]
