"""The cast of orbits: the branches that the page on notation draws, at p = 0.1 and 1, and where their letters are."""

import numpy as np

from duffing.orbits.bifurcations import FLIP, FOLD

from . import bifurcations as study
from .followed import at_exponent, curves, marks, side_by_side
from .transients import crises

EXPONENTS = (0.1, 1.0)
# Letter: the branch, the mu at which the letter stands, and which of the orbits met there, from the smallest on.
LETTERS = {
    "S": (study.IN_WELL, 0.2, 0),
    "R": (study.IN_WELL, 0.2, -1),
    "L": (study.LARGE, 0.33, -1),
    "D": (study.LARGE, 0.33, 0),
    "P3": (study.THIRD, 0.285, -1),
    "H": (study.SADDLE, 0.33, 0),
}


def diagram():
    """What `figures.cast` draws: dict p -> (branches, marks, letters, crisis)."""
    at_crisis = crises(EXPONENTS)
    followed = [at_exponent(study.branches(EXPONENTS), p) for p in EXPONENTS]
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


def places(found):
    """Where the orbits of a `diagram` are born and end, for the prose: dict name -> mu; "small_..." is p = 0.1.

    Along a branch the first bifurcation of a kind comes first.
    """
    result = {}
    for p, (*_, crisis) in found.items():
        begin = {0.1: "small", 1.0: "linear"}[p]
        at = {}
        for name, kind, where in side_by_side(at_exponent(study.branches(EXPONENTS), p)):
            at.setdefault((name, kind), []).append(where[p])
        well = at[study.IN_WELL, FOLD]
        result |= {
            f"{begin}_end": max(well),
            f"{begin}_R": min(well),
            f"{begin}_R_flip": at[study.IN_WELL, FLIP][0],
            f"{begin}_L": at[study.LARGE, FOLD][0],
            f"{begin}_P3": at[study.THIRD, FOLD][0],
            f"{begin}_P3_flip": at[study.THIRD, FLIP][0],
            f"{begin}_crisis": crisis,
        }
    return result
