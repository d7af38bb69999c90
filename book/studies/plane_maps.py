"""The plane of parameters as its chapter shows it: borders and brute force side by side, neighbours, rows of tables."""

from typing import NamedTuple

import numpy as np

from duffing.melnikov import critical_amplitude
from duffing.oscillator import Duffing

from .plane import EXPONENTS, agreement, borders, lasting, region


class Mapped(NamedTuple):
    """Maps of lasting chaos: panels, as `figures.regions` draws them; inside, filled : the `agreement` of each."""

    panels: list
    inside: list
    filled: list


def mapped(lines, grid, mu, **sizes):
    """The Mapped of both EXPONENTS against alpha at omega = 1 and against omega at alpha = 0.1.

    lines, grid : dicts "alpha", "omega" -> values at which the borders are computed, and those of the `region`
    """
    panels, agreed = [], []
    for p in EXPONENTS:
        for field, fixed in (("omega", r"$\alpha = 0.1$"), ("alpha", r"$\omega = 1$")):
            x = lines[field]
            found = borders(*((x, 1.0) if field == "alpha" else (0.1, x)), p)
            across = region(field, grid[field], mu, p, **sizes).across
            title = f"$p = {p:g}$, {fixed}"
            panels.append((title, field, (grid[field], mu), across, np.array(x), found._asdict()))
            agreed.append(agreement(grid[field], mu, across, x, found))
    return Mapped(panels, *(list(part) for part in zip(*agreed, strict=True)))


def neighbours(alpha, omega, part=0.01):
    """The nine pairs within a part of alpha and omega: array (2, 9)."""
    near = np.array([1 - part, 1.0, 1 + part])
    return np.array([(a, w) for a in np.round(alpha * near, 6) for w in np.round(omega * near, 6)]).T


def shares(pair, mu, **sizes):
    """dict p -> (mu, shares in chaos across and inside the wells, mu_c) of a pair; sizes : as for `lasting`."""
    found = {p: lasting(*pair, p, tuple(mu), **sizes) for p in EXPONENTS}
    critical = {p: float(critical_amplitude(Duffing(alpha=pair[0], p=p, omega=pair[1]))) for p in EXPONENTS}
    return {p: (mu, one.across, one.inside, critical[p]) for p, one in found.items()}


def row_of(pair, one):
    """Cells of a table of a pair and its Compared."""
    first = ["none" if np.isnan(m) else f"{m:.3f} ({ratio:.2f} $\\mu_c$)" for m, ratio in one.first]
    change = f"{one.difference:+.3f} ± {one.error:.3f}" if one.forcings else "no common chaos"
    return [f"{pair[0]:g}, {pair[1]:g}", *first, f"{one.smaller} of {one.forcings}", change]
