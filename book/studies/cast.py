"""The cast of orbits: the branches at p = 0.1 and p = 1 that the page on notation draws, and where their letters stand."""

import numpy as np

from duffing.orbits.followed import at_exponent, curves, marks

from . import bifurcations as study
from .transients import crises

EXPONENTS = (0.1, 1.0)
# Letter: the branch, the mu at which the letter stands, and which of the orbits met there, from the smallest on.
LETTERS = {
    "S": (study.IN_WELL, 0.15, 0),
    "R": (study.IN_WELL, 0.10, -1),
    "L": (study.LARGE, 0.33, -1),
    "D": (study.LARGE, 0.33, 0),
    "P3": (study.THIRD, 0.24, -1),
    "H": (study.SADDLE, 0.15, 0),
}


def diagram():
    """What `figures.cast` draws: dict p -> (branches, marks, letters, crisis)."""
    at_crisis = crises(EXPONENTS)
    followed = [at_exponent(study.branches(), p) for p in EXPONENTS]
    return {
        p: (curves(one), marks(one), letters(curves(one)), float(crisis))
        for p, one, crisis in zip(EXPONENTS, followed, at_crisis, strict=True)
    }


def letters(branches, places=None):
    """(letter, mu, value) of each of LETTERS on branches as `followed.curves` gives them; none where none is met."""
    found = []
    for letter, (name, mu, which) in (places or LETTERS).items():
        values = sorted(value for one in branches if one[0] == name for value in met(one, mu))
        if values:
            found.append((letter, mu, values[which]))
    return found


def met(branch, mu):
    """Values of a branch (name, parameter, value, stable) wherever it passes the parameter mu, interpolated."""
    _, parameter, value, _ = branch
    before, after = parameter[:-1], parameter[1:]
    j = np.flatnonzero((before - mu) * (after - mu) <= 0)
    share = (mu - before[j]) / np.where(after[j] == before[j], 1, after[j] - before[j])
    return ((1 - share) * value[j] + share * value[j + 1]).tolist()
