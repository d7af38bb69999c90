"""Bad input gets a clear error: the parameter's name, its value and what is allowed. Nothing else is here."""

import math
import sys
from collections.abc import Hashable

import numpy as np

MOST = 2**53  # counts beyond it are not told apart by a double


def floats(name, value, allowed, kinds="iuf"):
    """Real numbers in any shape, finite or not, as float array; kinds : of NumPy's types that are taken."""
    try:
        array = np.asarray(value)
    except ValueError:  # ragged
        raise ValueError(f"{name} = {value!r}: must be {allowed}") from None
    if array.dtype.kind not in kinds or np.ma.is_masked(value):  # what a mask hides is no number
        raise ValueError(f"{name} = {value!r}: must be {allowed}")
    return array.astype(float)


def parameter(name, value, allowed="a finite number", lower=None, strict=False):
    """One parameter of the oscillator, checked: a float, a read-only float array, an mpmath or a sympy number.

    lower is the least value allowed (excluded when strict). A sympy symbol must carry the assumption that
    proves it (for example negative=True), since a proof is only as good as what it assumes.
    """
    if _is_sympy(value):
        excess = None if lower is None else value - lower
        holds = value.is_real if excess is None else excess.is_positive if strict else excess.is_nonnegative
        if not holds:
            raise ValueError(f"{name} = {value}: must be {allowed}; give the symbol the assumption that says so")
        return value
    if _is_mpmath(value):
        finite, number = math.isfinite(value), value
    else:
        number = floats(name, value, allowed)
        finite = np.all(np.isfinite(number))
    if not finite or (lower is not None and not np.all(number > lower if strict else number >= lower)):
        raise ValueError(f"{name} = {value}: must be {allowed}")
    if isinstance(number, np.ndarray) and number.ndim:
        number = number + 0.0  # a copy of our own, without negative zeros, which would hash differently
        number.flags.writeable = False
        return number
    return number if _is_mpmath(value) else float(number) + 0.0


def model(osc):
    """An oscillator: anything else is refused by name before somebody asks it for its shape."""
    if isinstance(osc, type) or not hasattr(osc, "columns"):
        raise ValueError(f"osc = {osc!r}: must be a Duffing oscillator")
    return osc


def single(osc):
    """An oscillator that is no family."""
    if model(osc).shape:
        raise ValueError(f"osc has the shape {osc.shape}: must be a single oscillator")
    return osc


def number(name, value, allowed="a finite number", lower=None, strict=False):
    """One finite number, as `parameter` but no array: a float, an mpmath or a sympy number."""
    value = parameter(name, value, allowed, lower, strict)
    if isinstance(value, np.ndarray):
        raise ValueError(f"{name} = {value}: must be {allowed}, one for all members")
    return value


def count(name, value, least=1):
    """A whole number >= least, as int."""
    if type(value) in (bool, np.timedelta64) or not isinstance(value, int | np.integer) or not least <= value <= MOST:
        raise ValueError(f"{name} = {value!r}: must be a whole number >= {least} (and <= 2^53)")
    return int(value)


def counts(name, value, size, least=1):
    """Whole numbers >= least, one for all members or one each: an integer array (size,)."""
    array = floats(name, value, f"whole numbers >= {least}").ravel()
    if array.size not in (1, size):
        raise ValueError(f"{name} has {array.size} numbers: must be one, or {size}, one a member")
    return np.repeat([count(name, int(k) if k.is_integer() else k, least) for k in array.tolist()], size // array.size)


def positive(name, value):
    """A finite float > 0."""
    return number(name, value, allowed="a finite number > 0", lower=0.0, strict=True)


def choice(name, value, allowed):
    """One of the allowed words."""
    if not isinstance(value, Hashable) or value not in allowed:  # an array has no single truth
        raise ValueError(f"{name} = {value!r}: must be one of {', '.join(map(repr, allowed))}")
    return value


def instances(name, value, kind):
    """Things of a kind, as a tuple."""
    if not isinstance(value, tuple | list) or not all(isinstance(one, kind) for one in value):
        raise ValueError(f"{name} = {value!r}: must be a tuple of {kind.__name__}")
    return tuple(value)


def function(name, value):
    """What can be called."""
    if not callable(value):
        raise ValueError(f"{name} = {value!r}: must be a function")
    return value


def state(value, shape, name="state"):
    """States (x, v) of a family, as float array (2, N): from (2,) for all members or (2, *shape)."""
    array = floats(name, value, "two finite numbers (x, v)")
    size = math.prod(shape)
    if array.shape == (2,):
        array = np.repeat(array[:, None], size, axis=1)
    elif array.shape in ((2, *shape), (2, size)):  # also flat, as the integrators pass it on
        array = array.reshape(2, size)
    else:
        raise ValueError(f"{name} has shape {array.shape}: must be (2,) or (2, *family) = {(2, *shape)}")
    if not np.all(np.isfinite(array)):
        raise ValueError(f"{name} = {value}: must be finite")
    return np.ascontiguousarray(array)


def starts(value, name="starts"):
    """States (x, v) of M >= 1 motions: float array (2, M)."""
    array = floats(name, value, "finite states (2, M)")
    if array.ndim != 2 or len(array) != 2 or array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}: must be (2, M), M >= 1, x and v of each start")
    if not np.all(np.isfinite(array)):
        raise ValueError(f"{name} = {value}: must be finite")
    return array


def times(value, name="t"):
    """Increasing finite times, as float array (n,), n >= 1."""
    array = floats(name, value, "increasing finite numbers")
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}: must be a sequence of at least one number")
    if not np.all(np.isfinite(array)) or not np.all(np.diff(array) > 0):
        raise ValueError(f"{name} = {value}: must be finite and strictly increasing")
    return array


def double_well(osc):
    """Raise unless delta < 0 < gamma: only then are there two wells and a homoclinic loop."""
    model(osc)
    for name, value, sign, allowed in (("delta", osc.delta, -1, "< 0"), ("gamma", osc.gamma, 1, "> 0")):
        signed = sign * value
        if not (signed.is_positive if _is_sympy(signed) else np.all(signed > 0)):
            raise ValueError(f"{name} = {value}: must be {allowed} for a double well (homoclinic loops need one)")


def _is_sympy(value):
    # Asked without importing sympy: a value can only be sympy's when somebody has imported it.
    return "sympy" in sys.modules and isinstance(value, sys.modules["sympy"].Basic)


def _is_mpmath(value):
    return "mpmath" in sys.modules and isinstance(value, sys.modules["mpmath"].mpf)
