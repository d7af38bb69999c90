"""Compiled functions whose disk cache never outlives the code: a folder of its own for each state of the package.

Numba keeps compiled code by the file that a function stands in, and does not see an edit in a function that it calls:
an edited kernel would go on giving the old numbers. So the cache lies in a folder named by a hash of all modules that
hold compiled code.
"""

import hashlib
import os
import shutil
from pathlib import Path

import numba

PACKAGE = Path(__file__).parents[1]


def fingerprint(package=PACKAGE):
    """Hash of the names and texts of the modules with compiled code: a string of twelve hexadecimal digits."""
    digest = hashlib.sha256()
    for path in sorted(Path(package).rglob("*.py")):
        text = path.read_bytes()
        if b"numba" in text or b".compiled import" in text:
            digest.update(path.relative_to(package).as_posix().encode() + b"\0" + text + b"\0")
    return digest.hexdigest()[:12]


def _folder():
    parent = PACKAGE / "__pycache__"
    if not os.access(parent if parent.exists() else PACKAGE, os.W_OK):
        return numba.config.CACHE_DIR  # an installation that may not be written to: numba looks for a place itself
    folder = parent / f"kernels-{fingerprint()}"
    if not folder.exists():
        for old in parent.glob("kernels-*"):
            shutil.rmtree(old, ignore_errors=True)
    return str(folder)


_FOLDER = _folder()


def compiled(function=None, **options):
    """numba.njit with the cache on, outside the interpreter's lock, and NumPy's rules for division by zero.

    An infinity is NumPy's answer, too; the integrators reject what is not finite. Used with or without options.
    """
    if function is None:
        return lambda function: compiled(function, **options)
    before, numba.config.CACHE_DIR = numba.config.CACHE_DIR, _FOLDER
    try:
        return numba.njit(cache=True, nogil=True, error_model="numpy", **options)(function)
    finally:
        numba.config.CACHE_DIR = before


def inlined(function):
    """A function that becomes part of each compiled function that calls it; it cannot be called from Python."""
    return numba.njit(forceinline=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)


def inner(function):
    """A function that compiled functions call; it cannot be called from Python, and has no place in the cache."""
    return numba.njit(nogil=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)
