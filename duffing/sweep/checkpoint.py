"""Finished blocks of a long run, kept in a folder: what is read back is exactly what this run would compute.

A file's name is a hash of everything that its numbers depend on: the function, its options, the members' parameters and
states, the package's own text and the versions of what it builds on. Its first line is a hash of that name and of the
numbers. A file that is cut short, changed or put there by somebody else does not fit and is computed again; nothing
read from it is ever executed. Files appear whole or not at all, so runs may share a folder and be killed at any time.
"""

import hashlib
import inspect
import io
import json
import os
import platform
import re
import tempfile
import warnings
from functools import cache
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

import numpy as np

import vectorized

PACKAGES = [Path(__file__).parents[1], Path(vectorized.__file__).parent]


class Checkpoint:
    """The folder's blocks of one function with one set of options.

    folder : path, made if it does not exist; files of other runs and of others are left alone
    function : at the top level of a module; options : numbers, words, arrays

    Raises ValueError when the folder cannot be written to, or when a change of the function could go unnoticed.
    """

    def __init__(self, folder, function, options):
        try:
            self.folder = Path(folder)
            self.folder.mkdir(parents=True, exist_ok=True)
            with tempfile.NamedTemporaryFile(dir=self.folder):
                pass
        except (OSError, TypeError) as reason:
            raise ValueError(f"checkpoint = {folder!r}: must be a folder that can be written to ({reason})") from None
        self._run = json.dumps([_identity(function), surroundings(), options], sort_keys=True, default=_plain)

    def key(self, columns, state):
        """Name of the block of members with these parameters (6, n) and states (2, n): a hexadecimal hash."""
        digest = hashlib.sha256(self._run.encode())
        for array in (columns, state):
            digest.update(json.dumps(_plain(array)).encode())
        return digest.hexdigest()

    def load(self, key):
        """The block's array, or None when it is not there. A damaged file is said to be so (RuntimeWarning)."""
        path = self._path(key)
        try:
            seal, _, content = path.read_bytes().partition(b"\n")
        except FileNotFoundError:
            return None
        except OSError:  # a folder of that name, a disk that fails
            seal = content = b""
        if seal != _seal(key, content):
            warnings.warn(f"{path} is damaged: its block is computed again", RuntimeWarning, stacklevel=2)
            return None
        return np.load(io.BytesIO(content), allow_pickle=False)

    def keep(self, key, array):
        """Write the block's array: to another name first, so that nobody ever sees half of it."""
        buffer = io.BytesIO()
        np.save(buffer, array, allow_pickle=False)
        content = buffer.getvalue()
        part = None
        try:
            with tempfile.NamedTemporaryFile(dir=self.folder, suffix=".part", delete=False) as file:
                part = file.name
                file.write(_seal(key, content) + b"\n" + content)
            os.replace(part, self._path(key))
        except OSError as reason:
            if part is not None:
                Path(part).unlink(missing_ok=True)
            raise OSError(f"checkpoint = {str(self.folder)!r}: a block cannot be kept ({reason})") from reason

    def _path(self, key):
        return self.folder / f"{key}.block"


@cache
def surroundings():
    """What numbers depend on besides the call: the package's text, the packages that it needs, Python, the machine."""
    digest = hashlib.sha256()
    for package in PACKAGES:
        for path in sorted(package.rglob("*.py")):
            digest.update(path.relative_to(package).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    needed = {re.match(r"[\w.-]+", line)[0] for line in requires("duffing") or () if "extra ==" not in line}
    return [digest.hexdigest(), sorted(map(_versioned, needed)), platform.python_version(), platform.machine()]


def _versioned(name):
    try:
        return f"{name} {version(name)}"
    except PackageNotFoundError:
        return name


def _identity(function):
    """Where the function stands, and the text of that file. What stands nowhere, or holds values, cannot be told."""
    name = getattr(function, "__qualname__", "<unknown>")
    try:
        text = Path(inspect.getsourcefile(function)).read_bytes()
    except (OSError, TypeError):
        text = None
    if "<" in name or text is None:
        raise ValueError(f"checkpoint: function = {function!r} must stand at the top level of a module's file")
    return [function.__module__, name, hashlib.sha256(text).hexdigest()]


def _seal(key, content):
    return hashlib.sha256(key.encode() + content).hexdigest().encode()


def _plain(value):
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return [value.dtype.str, value.shape, hashlib.sha256(np.ascontiguousarray(value)).hexdigest()]
    raise ValueError(f"checkpoint: an option of type {type(value).__name__} cannot be compared with a kept run's")
