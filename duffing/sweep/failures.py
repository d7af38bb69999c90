"""A family some of whose members have no answer: NaN for those alone, and one warning, where that is asked for."""

import warnings

import numpy as np

from ..errors import DuffingError, LostWorkerError


def answers(function, osc, rows):
    """function(members) for all N members of a family: array (*rows, N), NaN for those without an answer.

    function : takes an index array (n,) of members and returns an array (*rows, n), or raises a DuffingError
    One warning says how many have none and why the first. Raises what else the function raises.
    """
    result = attempted(function, np.arange(osc.columns().shape[1]), rows)
    announce(result, osc, function)
    return result


def attempted(function, members, rows):
    """As `answers`, in silence. A family that fails is halved until those that fail stand alone: a member's numbers
    do not depend on its company (those of the saddle orbit and the tangency by no more than their own error), so the
    others' are what they would have been."""
    try:
        return function(members)
    except LostWorkerError:
        raise
    except DuffingError:
        if members.size == 1:
            return np.full((*rows, 1), np.nan)
    halves = np.array_split(members, 2)
    return np.concatenate([attempted(function, half, rows) for half in halves], axis=-1)


def announce(result, osc, function):
    """Warn (RuntimeWarning) of the members that are NaN in the result (..., N); function as for `answers`."""
    failed = np.flatnonzero(np.isnan(result).any(axis=tuple(range(result.ndim - 1))))
    if failed.size == 0:
        return
    reason = "no reason is known"
    try:
        function(failed[:1])
    except DuffingError as error:
        reason = f"{type(error).__name__}: {error}"
    warnings.warn(
        f"{failed.size} of {result.shape[-1]} members have no answer and are NaN; the first is member {failed[0]}, "
        f"{osc.named(failed[0])} ({reason})",
        RuntimeWarning,
        stacklevel=5,
    )
