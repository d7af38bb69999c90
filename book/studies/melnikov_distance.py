"""Why M measures the distance of the manifolds: a section through both, and the energy along an orbit on each."""

from typing import NamedTuple

import numpy as np

from duffing import homoclinic_orbit
from duffing.flow import integrate
from duffing.manifolds.curves import stable_manifold, unstable_manifold

REACH = 7.0  # of time before and after the section: as long as an orbit on a manifold can be followed from its end
LENGTH, SPACING = 3.2, 0.005


class Section(NamedTuple):
    """loop (2, n); unstable, stable (2, n): curves of W^U and W^S; ends (2, 2): where they meet the section, W^U first;
    gap: the energy of the first end minus that of the second; times, energies: pairs of (n,), along an orbit on W^U up
    to the section and along one on W^S from it on."""

    loop: np.ndarray
    unstable: np.ndarray
    stable: np.ndarray
    ends: np.ndarray
    gap: float
    times: tuple
    energies: tuple


def at_outermost_point(osc, phase=np.pi / 2):
    """The Section v = 0 of the right loop at a phase omega t0 of the forcing (radian), for one oscillator."""
    curves, ends, times, energies = [], [], [], []
    t0 = phase / osc.omega
    for manifold, sense in ((unstable_manifold, -1), (stable_manifold, 1)):
        curve = manifold(osc, 1, length=LENGTH, phase=phase, spacing=SPACING)
        nearest = np.argmin(np.abs(curve[1]) + (curve[0] < 1))
        around = curve[:, nearest - 3 : nearest + 4]
        ends.append([np.polynomial.Polynomial.fit(around[1], around[0], 4)(0.0), 0.0])
        # The orbit goes through a point of the curve: one beside the manifold would leave it.
        t = t0 + sense * np.linspace(0, REACH, 141)
        path = integrate(osc, curve[:, nearest], t, rtol=1e-12, atol=1e-14).states[..., 0]
        order = slice(None, None, sense)
        curves.append(curve)
        times.append((t - t0)[order])
        energies.append(osc.energy(*path)[order])
    gap = float(np.subtract(*(osc.energy(*end) for end in ends)))
    loop = np.array(homoclinic_orbit(osc, np.linspace(-12, 12, 800)))
    return Section(loop, *curves, np.transpose(ends), gap, tuple(times), tuple(energies))
