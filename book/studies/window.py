"""The window of lasting chaos at the adopted pair: forcings that its chapters share, its ends, the order of events."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import paper
from duffing.melnikov import critical_amplitude

from . import transients
from .survival import exponential, law_test, survival
from .transients import ABOVE, P_CRISIS, SINCE, Escape

LOW = (0.147, 0.15, 0.16, 0.17, 0.18, 0.20, 0.22, 0.24)  # from just above mu_c on, at p = 0.1
BELOW = (0.25, 0.26, 0.264, 0.2663)
INSIDE = (0.268, 0.271, 0.274)
BEYOND = (0.277, 0.278, 0.280, 0.283, 0.287)
LINEAR = (0.077, 0.079, 0.09, 0.10, 0.12, 0.14, 0.16, 0.18, 0.20, 0.21, 0.22, 0.23)
LINEAR += (0.24, 0.245, 0.247, 0.249, 0.252, 0.26, 0.265, 0.275)  # the same at p = 1, up to above its crisis
MANY = {"columns": 40, "rows": 25}
BISECTED = ABOVE / 2**6  # to which `transients.crises` locates a crisis


class Law(NamedTuple):
    """Lifetimes at one forcing: time, settled (n,); fit, an Exponential; distance of the captures from the law and the
    probability of a larger one (Kolmogorov and Smirnov)."""

    time: np.ndarray
    settled: np.ndarray
    fit: NamedTuple
    distance: float
    chance: float


def laws(forcings=BELOW):
    """The Law at each forcing, p = 0.1, from 2000 initial conditions: dict mu -> Law."""
    result = {}
    for mu in forcings:
        time, settled, _ = transients.sample(mu, columns=50, rows=40)
        fit = exponential(time, settled, SINCE)
        result[mu] = Law(time, settled, fit, *law_test(time, settled, SINCE, until=1000))
    return result


def survivors(found):
    """What `figures.survival_curves` draws of the `laws`: dict label -> (n, fraction, since, mean)."""
    return {rf"$\mu = {mu:g}$": (*survival(one.time, one.settled), SINCE, one.fit.mean) for mu, one in found.items()}


def escapes():
    """The Escape of chaos in parts: dict "low", "below", "inside", "beyond" (p = 0.1) and "linear" (p = 1)."""
    return {
        "low": transients.escape(LOW, **MANY),
        "below": transients.escape(BELOW, columns=50, rows=40, periods=1000),
        "inside": transients.escape(INSIDE, columns=6, rows=4),
        "beyond": transients.escape(BEYOND),
        "linear": transients.escape(LINEAR, p=1.0, **MANY, periods=1000),
    }


def joined(parts):
    """One Escape of several, in their order."""
    return Escape(*(np.concatenate(columns, axis=-1) for columns in zip(*parts, strict=True)))


class Drawn(NamedTuple):
    """What the figures of lifetimes and rates draw: dicts p -> (mu, mean, error), (mu, bound), (mu, small, large)."""

    means: dict
    bounds: dict
    rates: dict


def drawn(found):
    """The Drawn of dict p -> Escape."""
    return Drawn(
        {p: (one.mu, one.mean, one.error) for p, one in found.items()},
        {p: (one.mu, one.bound) for p, one in found.items()},
        {p: (one.mu, one.small, one.large) for p, one in found.items()},
    )


def ends(p=(0.1, 1.0)):
    """Where the orbits S end and where the crisis is: two dicts p -> mu."""
    chosen = [P_CRISIS.index(one) for one in p]
    found = transients.folds()[0], transients.crises()
    return tuple({one: float(mu[k]) for one, k in zip(p, chosen, strict=True)} for mu in found)


class Order(NamedTuple):
    """Against p (n,): critical amplitude, fold of S and crisis, (n,) each."""

    p: np.ndarray
    critical: np.ndarray
    fold: np.ndarray
    crisis: np.ndarray


def order():
    """The Order at the exponents P_CRISIS."""
    p = np.array(P_CRISIS)
    return Order(p, critical_amplitude(replace(paper.OSCILLATOR, p=p)), transients.folds()[0], transients.crises())


def sign_changes(x, y):
    """The x (k,) at which y changes its sign, its points (n,), none of them zero, joined by straight lines."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    k = np.flatnonzero(y[1:] * y[:-1] < 0)
    return x[k] + y[k] / (y[k] - y[k + 1]) * (x[k + 1] - x[k])
