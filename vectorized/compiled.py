"""Compiled functions whose disk cache never outlives the code: a folder of its own for each state of a package.

Numba keeps compiled code by the file that a function stands in, and does not see an edit in a function that it calls:
an edited kernel would go on giving the old numbers. So the cache of a package lies in a folder named by a hash of all
its modules that hold compiled code, and of those here; compiled functions call no others. Where no folder may be
written to, every process compiles for itself, and says so once.
"""

import hashlib
import os
import shutil
import sys
import warnings
from functools import cache, wraps
from pathlib import Path

import numba
from numba.core import event

ROOM = Path(__file__).parent


def fingerprint(package):
    """Hash of the modules with compiled code, a package's and those here: twelve hexadecimal digits."""
    digest = hashlib.sha256()
    for folder in (ROOM, Path(package)):
        for path in sorted(folder.rglob("*.py")):
            text = path.read_bytes()
            if b"numba" in text or b".compiled import" in text:
                digest.update(path.relative_to(folder).as_posix().encode() + b"\0" + text + b"\0")
    return digest.hexdigest()[:12]


def _package(function):
    """The folder of the package that a function belongs to; a module or a notebook without one counts as of here."""
    depth = function.__module__.count(".")
    return Path(function.__code__.co_filename).parents[depth - 1] if depth else ROOM


@cache
def _folder(package):
    parent = package / "__pycache__"
    if not os.access(parent if parent.exists() else package, os.W_OK):
        return numba.config.CACHE_DIR  # an installation that may not be written to: numba looks for a place itself
    folder = parent / f"kernels-{fingerprint(package)}"
    if not folder.exists():
        for old in parent.glob("kernels-*"):
            shutil.rmtree(old, ignore_errors=True)
    return str(folder)


_UNCACHED = []  # what is compiled without a cache


def compiled(function=None, **options):
    """numba.njit with the cache on, outside the interpreter's lock, and NumPy's rules for division by zero.

    An infinity is NumPy's answer, too; the integrators reject what is not finite. Used with or without options.
    """
    if function is None:
        return lambda function: compiled(function, **options)
    if numba.config.DISABLE_JIT:
        return _refused(function)
    options = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True, **options}
    before, numba.config.CACHE_DIR = numba.config.CACHE_DIR, _folder(_package(function))
    try:
        return numba.njit(cache=not _UNCACHED, **options)(function)
    except RuntimeError as reason:
        if "no locator available" not in str(reason):
            raise
    finally:
        numba.config.CACHE_DIR = before
    _UNCACHED.append(function)
    warnings.warn(
        "compiled code cannot be kept: neither the folder of the package nor one below the home folder may be written "
        "to. Each process compiles anew, for some seconds; NUMBA_CACHE_DIR can name a folder",
        RuntimeWarning,
        stacklevel=2,
    )
    return numba.njit(**options)(function)


class _Notice(event.Listener):
    """Numba tells it of each compilation that the cache does not spare."""

    def __init__(self, kernel, what):
        self.kernel, self.what = kernel, what

    def on_start(self, event):
        if event.data["dispatcher"] is self.kernel and sys.stderr is not None and sys.stderr.isatty():
            print(f"duffing: compiling {self.what}, once on this machine; this takes a while", file=sys.stderr)

    def on_end(self, event):
        """Nothing to say."""


def announced(kernel, what):
    """The kernel, which says so on a terminal's standard error when it is being compiled, for that takes seconds."""
    event.register("numba:compile", _Notice(kernel, what))
    return kernel


def inlined(function):
    """A function that becomes part of each compiled function that calls it; it cannot be called from Python."""
    return numba.njit(forceinline=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)


def inner(function):
    """A function that compiled functions call; it cannot be called from Python, and has no place in the cache."""
    return numba.njit(nogil=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)


def _refused(function):
    """What stands for a compiled function where numba compiles nothing."""

    @wraps(function)
    def refuse(*arguments, **options):
        raise RuntimeError("NUMBA_DISABLE_JIT is set: the integrators only work compiled, unset it")

    return refuse
