"""The dimension D of a basin boundary by the uncertainty exponent (Grebogi, McDonald, Ott and Yorke 1983).

A start is eps-uncertain when a start at the distance eps ends elsewhere. In the plane the part of such starts goes as
f(eps) ~ eps^(2 - D): D = 1 for a smooth boundary, where a start ten times better known is ten times less often in
doubt; for D near 2 better knowledge hardly helps.
"""

from typing import NamedTuple

import numpy as np

from .. import checks
from ..errors import ConvergenceError


class Dimension(NamedTuple):
    """value and one standard error of a dimension."""

    value: float
    error: float


def uncertain_starts(label, box, eps, starts=2**14, seed=20260612):
    """How many of so many random starts have another label at a distance eps in x, to either side: counts (n,).

    label : label(states (2, N)) gives N labels; any two that differ count
    box : ((x least, x most), (v least, v most)), uniformly filled, by other starts for every eps
    eps : (n,) distances; seed : of the random starts
    """
    eps = np.atleast_1d(checks.parameter("eps", eps, "positive distances", lower=0.0, strict=True))
    checks.function("label", label)
    starts, low, high = checks.count("starts", starts), *_corners(box)
    random, counts = np.random.default_rng(checks.count("seed", seed, least=0)), []
    for distance in eps:
        states = random.uniform(low[:, None], high[:, None], (2, starts))
        aside = np.array([[distance], [0.0]])
        one, left, right = label(np.concatenate([states, states - aside, states + aside], axis=1)).reshape(3, -1)
        counts.append(np.sum((one != left) | (one != right)))
    return np.array(counts)


def dimension(eps, uncertain, starts):
    """D in the plane from counts (n,) of uncertain starts among so many, independent for every eps: a Dimension.

    The slope of log f against log eps by least squares, weighted with the counts' binomial variances; where the points
    scatter about the line by more than those (a fractal with steps in its scales), the error grows in proportion.

    Raises ConvergenceError where fewer than three distances have uncertain starts.
    """
    eps = np.atleast_1d(checks.parameter("eps", eps, "positive distances", lower=0.0, strict=True))
    starts = checks.count("starts", starts)
    uncertain = checks.floats("uncertain", uncertain, "counts of starts")
    if uncertain.shape != eps.shape or not np.all((uncertain >= 0) & (uncertain <= starts)):
        raise ValueError(f"uncertain = {uncertain}: must be counts from 0 to starts = {starts}, one for each eps")
    seen = uncertain > 0
    if seen.sum() < 3:
        raise ConvergenceError(f"uncertain = {uncertain}: at least three distances must have uncertain starts")
    share = uncertain[seen] / starts
    weight = starts * share / np.maximum(1 - share, 1 / starts)  # inverse variance of log f
    x, y = np.log(eps[seen]), np.log(share)
    x = x - np.average(x, weights=weight)
    slope = np.sum(weight * x * y) / np.sum(weight * x * x)
    left = y - np.average(y, weights=weight) - slope * x
    excess = np.sum(weight * left**2) / (seen.sum() - 2)
    return Dimension(float(2 - slope), float(np.sqrt(max(1.0, excess) / np.sum(weight * x * x))))


def _corners(box):
    sides = checks.floats("box", box, "((x least, x most), (v least, v most))")
    if sides.shape != (2, 2) or not np.all(np.isfinite(sides)) or not np.all(sides[:, 0] < sides[:, 1]):
        raise ValueError(f"box = {box!r}: must be ((x least, x most), (v least, v most))")
    return sides.T
