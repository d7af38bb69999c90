"""Melnikov's method for the Duffing oscillator with power-law damping: Eq. 8 to 13 of the paper.

Every formula takes numbers, arrays, mpmath numbers or sympy symbols (see `arithmetic`), so what is proved
in the chapters is what is plotted. All quantities are dimensionless. Every function raises ValueError unless
delta < 0 < gamma, and DivergedError where the value leaves the range of doubles.
"""

import mpmath
import numpy as np

from . import checks
from .arithmetic import library, within_range


@within_range
def homoclinic_orbit(osc, t, side=1):
    """The orbit of Eq. 8 that leaves the saddle x = 0 and returns to it, at its outermost point at t = 0.

    t : times, any shape that broadcasts with the family
    side : 1 for the loop in the right well (x > 0), -1 for its mirror image

    Returns (x, v), each of the shape that t broadcasts to.
    """
    checks.double_well(osc)
    checks.choice("side", side, (1, -1))
    t = checks.parameter("t", t)
    lib = library(osc.delta, osc.gamma, t)
    x = side * lib.sqrt(-2 * osc.delta / osc.gamma) * lib.sech(lib.sqrt(-osc.delta) * t)
    return _over_family(osc, x, t), _over_family(osc, side * loop_velocity(osc, t, lib), t)


def loop_velocity(osc, t, lib):
    """v* of Eq. 8 on the right loop by the functions of `lib`, nothing checked: for those who need it many times."""
    u = lib.sqrt(-osc.delta) * t
    return lib.sqrt(2 / osc.gamma) * osc.delta * lib.tanh(u) * lib.sech(u)


@within_range
def damping_integral(osc):
    """Integral of |v*|^(p+1) over the loop, closed form (the energy that damping takes at alpha = 1).

    (2/gamma)^((p+1)/2) (-delta)^(p+1/2) B((p+2)/2, (p+1)/2): with s = tanh(sqrt(-delta) t) it is a Beta function.
    """
    checks.double_well(osc)
    lib = library(osc.p, osc.delta, osc.gamma)
    scale = (2 / osc.gamma) ** ((osc.p + 1) / 2) * (-osc.delta) ** ((2 * osc.p + 1) / 2)
    return scale * lib.beta((osc.p + 2) / 2, (osc.p + 1) / 2)


@within_range
def forcing_integral(osc):
    """Amplitude over t0 of the integral of v* cos(omega (t + t0)): the most energy that forcing gives at mu = 1.

    sqrt(2/gamma) pi omega sech(pi omega / (2 sqrt(-delta))), the Fourier transform of sech tanh; shape of the family.
    """
    checks.double_well(osc)
    lib = library(osc.omega, osc.delta, osc.gamma)
    return lib.sqrt(2 / osc.gamma) * lib.pi * osc.omega * lib.sech(lib.pi * osc.omega / 2 / lib.sqrt(-osc.delta))


@within_range
def melnikov_function(osc, t0, side=1):
    """M(t0) of Eq. 9, evaluated: the energy gained along the loop that is at its outermost point at time t0.

    M(t0) = side mu forcing_integral sin(omega t0) - alpha damping_integral; t0 broadcasts with the family.
    The distance of the perturbed manifolds is M(t0) / |grad H0| to first order.
    """
    checks.double_well(osc)
    checks.choice("side", side, (1, -1))
    t0 = checks.parameter("t0", t0)
    lib = library(osc.omega, t0)
    value = side * osc.mu * forcing_integral(osc) * lib.sin(osc.omega * t0) - osc.alpha * damping_integral(osc)
    return _over_family(osc, value, t0)


@within_range
def critical_amplitude(osc):
    """mu_c of Eq. 13: the forcing amplitude at which the Melnikov function first has a zero; osc.mu is not used."""
    checks.double_well(osc)
    return _over_family(osc, osc.alpha * damping_integral(osc) / forcing_integral(osc))


def least_critical_frequency(osc):
    """The omega at which mu_c is least: omega = 2 sqrt(-delta) u / pi with u tanh u = 1, for every p, alpha and gamma.

    Returns a float array of the family's shape; osc.omega is not used.
    """
    checks.double_well(osc)
    u = float(mpmath.findroot(lambda u: u * mpmath.tanh(u) - 1, 1.2))
    return np.broadcast_to(2 * np.sqrt(-osc.delta) * u / np.pi, osc.shape)


def _over_family(osc, value, t=0.0):
    # A field that a formula does not use still belongs to the family, whose shape is promised.
    shape = np.broadcast_shapes(osc.shape, np.shape(t))
    if shape:
        return np.array(np.broadcast_to(value, shape))
    return value.item() if isinstance(value, np.generic) else value  # a number that shows itself as one
