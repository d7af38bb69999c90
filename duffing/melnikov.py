"""Melnikov's method for the Duffing oscillator with power-law damping: Eq. 8 to 13 of the paper.

Every formula takes numbers, arrays, mpmath numbers or sympy symbols (see `arithmetic`), so what is proved
in the chapters is what is plotted. All quantities are dimensionless. Every function raises ValueError unless
delta < 0 < gamma, and DivergedError where the value leaves the range of doubles.
"""

from dataclasses import replace

import mpmath
import numpy as np

from . import checks
from .arithmetic import library, within_range
from .errors import ConvergenceError


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
    return _over_family(osc, x, t), _over_family(osc, side * _loop_velocity(osc, t, lib), t)


def _loop_velocity(osc, t, lib):
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


def melnikov_quadrature(osc, t0, digits=50):
    """M(t0) of Eq. 9 from its definition, by mpmath sums: nothing of the closed forms above is used.

    For one oscillator (no family). The error is less than 10^-digits of the larger of the two terms, damping and
    forcing, at every omega and p.

    The work of the damping, whose integrand has a kink at t = 0, is summed on the half line by the double exponential
    rule (Takahasi and Mori 1974). The work of the forcing is that of an analytic function on the whole line, for which
    the trapezoidal rule errs by its values at the frequencies 2 pi / h - omega (Poisson): the step h follows from omega
    and the orbit's nearest singularity, i pi / (2 sqrt(-delta)), and so do the digits that the oscillation cancels.

    Raises ValueError for invalid input, ConvergenceError where two sums with other nodes do not agree to the digits.
    """
    checks.double_well(checks.single(osc))
    checks.number("t0", t0)
    checks.count("digits", digits)
    with mpmath.workdps(digits + 20):
        exact = replace(osc, alpha=mpmath.mpf(osc.alpha))
        damping, its_error = _half_line_sum(lambda t: _power_taken(exact, t), digits)
        forcing, error = _whole_line_sum(exact, t0, digits, damping) if exact.mu else (mpmath.mpf(0), mpmath.mpf(0))
        larger = max(abs(damping), abs(forcing))
        if its_error + error > mpmath.mpf(10) ** -digits * larger:
            reached = mpmath.nstr((its_error + error) / larger, 2)
            raise ConvergenceError(f"digits = {digits}: the sums agree to a part in {reached} of the larger term only")
        return forcing - damping


def _power_taken(osc, t):
    # The two halves of the loop take the same, and v < 0 on this one.
    v = _loop_velocity(osc, t, mpmath)
    return 2 * osc.alpha * abs(v) ** (osc.p + 1)


def _half_line_sum(function, digits):
    """Integral from 0 to infinity of a function that decays exponentially, and the change of the last refinement."""
    least = mpmath.mpf(10) ** -(digits + 10)

    def terms(first, step):
        # t = exp(u - exp(-u)): away from the middle in both directions until nothing more is added.
        total = mpmath.mpf(0)
        for direction in (1, -1):
            u = first if direction == 1 else first - step
            largest = mpmath.mpf(0)
            while True:
                t = mpmath.exp(u - mpmath.exp(-u))
                term = function(t) * t * (1 + mpmath.exp(-u)) if t else mpmath.mpf(0)
                total += term
                largest = max(largest, term)
                if abs(u) > 1 and term <= least * largest:
                    break
                u += direction * step
        return total * step

    step = mpmath.mpf(1) / 4
    value = terms(mpmath.mpf(0), step)
    for _ in range(8):
        finer = (value + terms(step / 2, step)) / 2
        change, value, step = abs(finer - value), finer, step / 2
        if change <= mpmath.mpf(10) ** -(digits + 2) * value:
            break
    return value, change


def _whole_line_sum(osc, t0, digits, damping):
    """Integral of v* mu cos(omega (t + t0)), and half the difference of the sums at the nodes and between them."""
    rate = mpmath.sqrt(-osc.delta)
    # Decimals below v*: those that the oscillation cancels, but no more than the other term leaves visible.
    cancelled = osc.omega * mpmath.pi / 2 / rate / mpmath.log(10)
    hidden = mpmath.log10(osc.mu / damping) if damping else cancelled
    decimals = digits + 15 + max(0, int(min(cancelled, hidden)))
    with mpmath.workdps(decimals):
        logarithm = decimals * mpmath.log(10)
        h = 2 * mpmath.pi / (osc.omega + 2 * rate * logarithm / mpmath.pi)
        nodes = int(logarithm / rate / h) + 1
        sine = mpmath.sin(osc.omega * t0)

        # v* is odd: the two half lines add up with sin(omega t) sin(omega t0), and the cosines cancel.
        def total(shift):
            times = ((k + shift) * h for k in range(nodes + 1))
            terms = (_loop_velocity(osc, t, mpmath) * mpmath.sin(osc.omega * t) for t in times)
            return -2 * h * sine * mpmath.fsum(terms)

        at, between = (osc.mu * total(mpmath.mpf(shift)) for shift in (0, 0.5))
        return (at + between) / 2, abs(at - between) / 2


def _over_family(osc, value, t=0.0):
    # A field that a formula does not use still belongs to the family, whose shape is promised.
    shape = np.broadcast_shapes(osc.shape, np.shape(t))
    return np.array(np.broadcast_to(value, shape)) if shape else value
