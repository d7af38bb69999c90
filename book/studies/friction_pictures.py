"""What the chapter on friction time draws: a crossing of v = 0 in time and in friction time, and a creep."""

from typing import NamedTuple

import numpy as np

from duffing.flow import integrate


class Path(NamedTuple):
    """t, s (n,): time and friction time, both from the first point on; x, v (n,); damping (n,): Y = sign(v) |v|^p;
    force (n,): F / alpha, which Y follows in a creep."""

    t: np.ndarray
    s: np.ndarray
    x: np.ndarray
    v: np.ndarray
    damping: np.ndarray
    force: np.ndarray


def path(osc, start, first, last, points=1200):
    """The Path of one oscillator from its state at t = 0, between two times. The friction time is what the integrator
    measures between two points; it is infinite from a creep through zero force on (p <= 1/2)."""
    t = np.linspace(first, last, points)
    orbit = integrate(osc, start, np.append(0.0, t) if first > 0 else t)
    x, v = orbit.states[..., -t.size :, 0]
    s = np.append(0.0, np.cumsum(orbit.friction_time[-t.size + 1 :, 0]))
    return Path(t - first, s, x, v, np.sign(v) * np.abs(v) ** osc.p, osc.force(x, t) / osc.alpha)
