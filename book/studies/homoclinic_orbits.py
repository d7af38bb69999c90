"""Fig. 2 computed: the manifolds of the saddle orbit at a phase, and where those of the right loop first cross."""

import numpy as np

from duffing import trajectory
from duffing.manifolds.curves import stable_manifold, unstable_manifold

SIDES = (1, -1)


def strobed(osc, start, periods, samples=200):
    """A path from `start` over some forcing periods: t (n,), path (2, n), stroboscopic points (2, periods + 1)."""
    t = np.linspace(0, periods * osc.period, periods * samples + 1)
    path = trajectory(osc, start, t)
    return t, path, path[:, ::samples]


def manifolds(osc, ratio, phase=np.pi / 2, length=10.0):
    """A case of `figures.fig2`: title, curves of W^S and of W^U (right branch first), and a primary homoclinic point.

    ratio : mu over the critical amplitude, for the title; the point is (2,), or None where the curves do not cross
    """
    stable = [stable_manifold(osc, side, length=length, phase=phase) for side in SIDES]
    unstable = [unstable_manifold(osc, side, length=length, phase=phase) for side in SIDES]
    return rf"$\mu = {ratio:g}\,\mu_c$", stable, unstable, primary_point(stable[0], unstable[0])


def primary_point(stable, unstable):
    """The crossing of two curves (2, n) and (2, m) with the least sum of arc lengths along both: (2,), or None.

    On neither curve does a nearer crossing lie between it and the saddle orbit, which is what makes it primary.
    """
    a, b = stable[:, :-1, None], unstable[:, None, :-1]
    along, across = np.diff(stable)[:, :, None], np.diff(unstable)[:, None, :]
    denominator = along[0] * across[1] - along[1] * across[0]
    gap = b - a
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (gap[0] * across[1] - gap[1] * across[0]) / denominator
        u = (gap[0] * along[1] - gap[1] * along[0]) / denominator
    i, j = np.nonzero((s >= 0) & (s < 1) & (u >= 0) & (u < 1))
    away = np.maximum(_lengths(stable)[i], _lengths(unstable)[j])  # the curves' common beginning is no crossing
    found = away > 0.5
    if not found.any():
        return None
    i, j = i[found], j[found]
    first = np.argmin(_lengths(stable)[i] + _lengths(unstable)[j])
    return stable[:, i[first]] + s[i[first], j[first]] * along[:, i[first], 0]


def _lengths(curve):
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(curve)))])
