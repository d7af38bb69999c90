"""Why M measures the distance of the manifolds, computed: a section through both, and the energy along an orbit on each."""

from typing import NamedTuple

import numpy as np

from duffing import homoclinic_orbit
from duffing.flow import integrate
from duffing.manifolds.curves import stable_manifold, unstable_manifold

REACH = 7.0  # of time before and after the section: as long as an orbit on a manifold can be followed from its end
LENGTH, SPACING = 3.2, 0.005


class Section(NamedTuple):
    """loop (2, n); unstable, stable (2, n): curves of W^U and W^S; ends (2, 2): their points at the section, W^U first;
    times, energies: pairs of (n,), along the orbit on W^U up to the section and along that on W^S from it on."""

    loop: np.ndarray
    unstable: np.ndarray
    stable: np.ndarray
    ends: np.ndarray
    times: tuple
    energies: tuple


def at_outermost_point(osc, phase=np.pi / 2):
    """The Section v = 0 of the right loop at a phase omega t0 of the forcing (radian), for one oscillator.

    The ends are the points computed on the curves that lie nearest to the section: points of the manifolds themselves,
    since one beside them would leave them along the orbit. The section is missed by less than the curves' spacing.
    """
    curves, ends, times, energies = [], [], [], []
    t0 = phase / osc.omega
    for manifold, sense in ((unstable_manifold, -1), (stable_manifold, 1)):
        curve = manifold(osc, 1, length=LENGTH, phase=phase, spacing=SPACING)
        end = curve[:, np.argmin(np.abs(curve[1]) + (curve[0] < 1))]
        t = t0 + sense * np.linspace(0, REACH, 141)
        path = integrate(osc, end, t, rtol=1e-12, atol=1e-14).states[..., 0]
        order = slice(None, None, sense)
        curves.append(curve)
        ends.append(end)
        times.append((t - t0)[order])
        energies.append(osc.energy(*path)[order])
    loop = np.array(homoclinic_orbit(osc, np.linspace(-12, 12, 800)))
    return Section(loop, *curves, np.transpose(ends), tuple(times), tuple(energies))
