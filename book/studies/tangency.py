"""What the chapter on the tangency computes: mu_t against p, against alpha at small p, and both sides of W^S."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import checks
from duffing.flow import integrate
from duffing.manifolds.curves import stable_manifold, unstable_manifold
from duffing.manifolds.passage import forward_frame
from duffing.manifolds.tangency import homoclinic_tangency, splitting
from duffing.manifolds.threshold import threshold
from duffing.melnikov import critical_amplitude
from duffing.oscillator import Duffing

from ..remember import remembered
from .dry_friction import dry_friction_tangency

EXPONENTS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0)


class Parting(NamedTuple):
    """t (n,) from the turn on, x (n, 2) of an orbit that falls back and of one that goes over, x_s : where W^S is."""

    t: np.ndarray
    x: np.ndarray
    x_s: float


def lobes(osc, amplitudes, length=14.0, spacing=0.004):
    """Manifolds of the right loop at the phase pi/2 as cases of `figures.lobes`: (title, [W^S], [W^U]) for each mu.

    osc : a single oscillator, its own mu not used; amplitudes : dict of what the title says -> mu
    spacing : of the points of a curve, small enough for the inset
    """
    line, found = critical_amplitude(checks.single(osc)), []
    for where, mu in amplitudes.items():
        forced = replace(osc, mu=float(mu))
        curves = [
            [follow(forced, length=length, spacing=spacing, phase=np.pi / 2)]
            for follow in (stable_manifold, unstable_manifold)
        ]
        found.append((rf"$\mu = {mu / line:.2f}\,\mu_c$, {where}", *curves))
    return found


def collapsed(alpha, curves, theory):
    """The curves (n, len(alpha)) of `figures.collapse` by alpha, and the greatest distance of each from the theory.

    Returns dict alpha -> (n,), and (len(alpha),) in per cent of the greatest value of the theory (n,).
    """
    distance = np.abs(curves - np.asarray(theory)[:, None]).max(axis=0)
    return dict(zip(np.asarray(alpha).tolist(), curves.T, strict=True)), 100 * distance / np.max(np.abs(theory))


def powers(alpha, correction):
    """The power of alpha (n,) that each row of the correction (m, n) follows in a fit on logarithmic axes: (m,)."""
    return np.polyfit(np.log(alpha), np.log(np.abs(correction)).T, 1)[0]


@remembered
def ratios(p=EXPONENTS, alpha=0.1, omega=1.0):
    """mu_t / mu_c at the exponents p, (n,); alpha and omega are numbers or (n,)."""
    osc = Duffing(alpha=alpha, p=np.array(p), omega=np.array(omega))
    return homoclinic_tangency(osc) / critical_amplitude(osc)


@remembered
def corrections(p, alpha):
    """mu_t / mu_c - 1 over alpha (n,) at one exponent, p = 0 (dry friction) included, omega = 1."""
    if p == 0:
        return np.array([dry_friction_tangency(value) for value in alpha]) - 1
    osc = Duffing(alpha=np.array(alpha), p=p)
    return homoclinic_tangency(osc) / critical_amplitude(osc) - 1


def orders(alpha, correction, turn):
    """The power of alpha that the correction follows, between alpha (n,) and the one `turn` places further on."""
    checks.count("turn", turn)
    return np.log(correction[turn:] / correction[:-turn]) / np.log(alpha[turn:] / alpha[:-turn])


@remembered
def parting(osc, phase, distance=1e-6, time=30.0):
    """The orbits that turn at the phase a small distance below and above x_s: a Parting.

    osc : a single oscillator with delta = -1, gamma = 1
    """
    frame = forward_frame(checks.single(osc))
    x_s = threshold(frame, np.array([phase]), np.array([0]))[0]
    t = np.linspace(0, time, 600)
    family = replace(osc, mu=np.full(2, osc.mu))
    start = np.array([[x_s - distance, x_s + distance], [0.0, 0.0]])
    return Parting(t, integrate(family, start, phase / osc.omega + t).states[0], float(x_s))


@remembered
def splittings(osc, phase, fractions=(0.9, 1.0, 1.1)):
    """Splitting at the phases (n,) for these fractions of the tangency: dict fraction -> (n,)."""
    family = replace(osc, mu=np.array(fractions) * homoclinic_tangency(osc))
    return dict(zip(fractions, splitting(family, np.array(phase)).T, strict=True))
