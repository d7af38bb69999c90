"""A formula is written once and takes the library that evaluates it.

sympy to prove, mpmath to check fifty digits, numpy to draw: `library` looks at the values and returns
the functions that fit them.
"""

from functools import wraps
from types import SimpleNamespace

import numpy as np
import scipy.special

from .checks import _is_mpmath, _is_sympy
from .errors import DivergedError


def _sech(x):
    # 1 / cosh(x) without cosh's overflow: the orbit's tail is zero, not a warning.
    decay = np.exp(-np.abs(x))
    return 2 * decay / (1 + decay**2)


NUMPY = SimpleNamespace(
    sqrt=np.sqrt,
    cos=np.cos,
    sin=np.sin,
    cosh=np.cosh,
    sech=_sech,
    tanh=np.tanh,
    sign=np.sign,
    beta=scipy.special.beta,
    pi=np.pi,
)


def library(*values):
    """The functions sqrt, cos, sin, cosh, sech, tanh, sign, beta and the number pi for these values.

    Any sympy value calls for sympy, else any mpmath number for mpmath, else numpy (beta from SciPy).
    """
    if any(map(_is_sympy, values)):
        import sympy  # imported on use: half a second that no simulation should pay

        return sympy
    if any(map(_is_mpmath, values)):
        import mpmath

        return mpmath
    return NUMPY


def promoted(*values):
    """The values as numbers of one library; for sympy a float stands for the decimal that it is written as."""
    lib = library(*values)
    if lib is NUMPY:
        return values
    if any(np.ndim(value) for value in values):
        raise ValueError(f"{values}: a family holds floats only, not {lib.__name__} numbers")
    if lib.__name__ == "mpmath":
        return tuple(lib.mpf(value) for value in values)
    return tuple(lib.Rational(repr(value)) if isinstance(value, float) else lib.sympify(value) for value in values)


def within_range(formula):
    """The formula, but where doubles cannot hold its value it raises DivergedError instead of answering inf or nan."""

    @wraps(formula)
    def evaluate(*args, **kwargs):
        with np.errstate(all="ignore"):
            try:
                value = formula(*args, **kwargs)
            except (OverflowError, ZeroDivisionError):  # from Python's own floats
                value = np.inf
        parts = value if isinstance(value, tuple) else (value,)
        if library(*parts) is NUMPY and not all(np.all(np.isfinite(part)) for part in parts):
            raise DivergedError(
                f"{formula.__name__}: the value leaves the range of double precision; mpmath numbers as fields keep it"
            )
        return value

    return evaluate
