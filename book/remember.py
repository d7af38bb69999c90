"""Results kept for the process: a figure's data are asked for by several chapters' cells and by the ledger."""

from functools import lru_cache, wraps

import numpy as np


def remembered(function):
    """Keep the function's results; lists and arrays among its arguments count as tuples.

    The arrays it returns, alone or in tuples and dictionaries, are read-only: a reader who writes into one would
    otherwise change what everybody else is given.
    """
    kept = lru_cache(lambda *args, **kwargs: _frozen(function(*args, **kwargs)))

    @wraps(function)
    def call(*args, **kwargs):
        return kept(*map(_hashable, args), **{name: _hashable(value) for name, value in kwargs.items()})

    return call


def _hashable(value):
    return tuple(value) if isinstance(value, list | np.ndarray) else value


def _frozen(result):
    if isinstance(result, np.ndarray):
        result.flags.writeable = False
    elif isinstance(result, tuple | dict):
        for part in result.values() if isinstance(result, dict) else result:
            _frozen(part)
    return result
