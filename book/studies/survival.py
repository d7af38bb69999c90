"""The exponential law of lifetimes: survival curves, mean lifetimes from censored samples, and a test of the law.

Captured at a constant rate, orbits die out exponentially, S(n) = exp(-n / tau). Lifetimes are whole forcing periods, so
the law is met in its discrete form, the geometric one: each period captures the same share h = 1 - exp(-1 / tau) of
those still wandering. An orbit still wandering when the watch ends has not been lost: it was at risk all that time.
"""

from typing import NamedTuple

import numpy as np

from duffing import checks
from duffing.errors import ConvergenceError

SEED = 20061201  # of the bootstrap


class Exponential(NamedTuple):
    """mean : the mean lifetime tau from `since` on, in periods; error : one standard error; events : captures seen;
    exposure : periods at risk, over all orbits."""

    mean: float
    error: float
    events: int
    exposure: int


def survival(time, settled):
    """Share of orbits that wander longer than n periods (Kaplan and Meier): n (m,), share (m,), from (0, 1) downwards.

    time, settled : as in `duffing.transients.lifetimes.Lifetimes`, any shape
    """
    time, settled = _sample(time, settled)
    n = np.unique(time[settled])
    at_risk = time.size - np.searchsorted(np.sort(time), n)
    captured = np.diff(np.searchsorted(np.sort(time[settled]), n, side="right"), prepend=0)
    return np.concatenate([[0], n]), np.concatenate([[1.0], np.cumprod(1 - captured / at_risk)])


def exponential(time, settled, since=0):
    """The Exponential of greatest likelihood for the orbits that wander longer than `since` periods.

    Raises ConvergenceError where none of them was captured: such a sample has no mean lifetime, only a lower bound.
    """
    time, settled = _sample(time, settled)
    late = time > checks.count("since", since, least=0)
    events, exposure = int(np.sum(settled & late)), int(np.sum(time[late] - since))
    if events == 0:
        raise ConvergenceError(
            f"since = {since}: none of {late.sum()} orbits was captured in {exposure} periods at risk"
        )
    share = events / exposure
    mean = 0.0 if share == 1 else -1 / np.log1p(-share)
    error = 0.0 if share == 1 else mean**2 * share / np.sqrt((1 - share) * events)
    return Exponential(float(mean), float(error), events, exposure)


def rate(time, captured, since=0):
    """Captures per period at risk and one standard error, where `captured` marks those by one of several attractors.

    The rates of several attractors add up to the whole. Without a capture the rate is 0, its error that of one capture.
    """
    time, captured = _sample(time, captured, "captured")
    late = time > checks.count("since", since, least=0)
    events, exposure = np.sum(captured & late), np.sum(time[late] - since)
    if exposure == 0:
        raise ConvergenceError(f"since = {since}: no orbit wanders longer")
    return float(events / exposure), float(np.sqrt(max(events, 1)) / exposure)


def law_test(time, settled, since=0, until=None, resamples=400, seed=SEED):
    """Kolmogorov and Smirnov's distance of the captures from the fitted law, and the probability of a larger one.

    until : periods for which every orbit was watched (default: the longest time); captures are compared with the law
        cut off there. The probability is that of samples drawn from the fitted law, each fitted anew: as the mean
        lifetime is taken from the data, the textbook's table would not do.

    Returns (distance, probability).
    """
    time, settled = _sample(time, settled)
    until = checks.count("until", int(time.max()) if until is None else until)
    since = checks.count("since", since, least=0)
    if until <= since:
        raise ValueError(f"until = {until}: must be more than since = {since}")
    until -= since
    fit = exponential(time, settled, since)
    late = time > since
    draw = np.random.default_rng(checks.count("seed", seed, least=0))
    distance = _distance(time[late] - since, settled[late], fit.mean, until)
    drawn = np.ceil(draw.exponential(fit.mean, (checks.count("resamples", resamples), late.sum()))).astype(int)
    larger = 0
    for sample in drawn:
        seen = sample < until
        again = exponential(np.minimum(sample, until), seen)
        larger += _distance(np.minimum(sample, until), seen, again.mean, until) >= distance
    return float(distance), larger / resamples


def _distance(time, settled, mean, until):
    n = np.arange(1, until + 1)
    found = np.searchsorted(np.sort(time[settled]), n, side="right") / settled.sum()
    law = np.expm1(-n / mean) / np.expm1(-until / mean)
    return np.max(np.abs(found - law))


def _sample(time, marked, name="settled"):
    allowed = "whole numbers of periods >= 0, at least one"
    time = checks.floats("time", time, allowed).ravel()
    if time.size == 0 or not np.all((time >= 0) & (time <= checks.MOST) & (time == np.floor(time))):
        raise ValueError(f"time = {time}: must be {allowed}")
    marked = checks.floats(name, marked, "True or False for each time", kinds="b").ravel() > 0
    if marked.size != time.size:
        raise ValueError(f"{name} has {marked.size} marks, time has {time.size} numbers: must be as many")
    return time.astype(int), marked
