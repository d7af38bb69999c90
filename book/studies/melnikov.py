"""The Melnikov integral from its definition, to any number of digits: what the closed forms are checked against."""

from dataclasses import replace

import mpmath

from duffing import Duffing, checks
from duffing.errors import ConvergenceError
from duffing.melnikov import loop_velocity, melnikov_function


def melnikov_quadrature(osc, t0, digits=50):
    """M(t0) of Eq. 9 from its definition, by mpmath sums: nothing of the closed forms of `duffing.melnikov` is used.

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
    v = loop_velocity(osc, t, mpmath)
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
            terms = (loop_velocity(osc, t, mpmath) * mpmath.sin(osc.omega * t) for t in times)
            return -2 * h * sine * mpmath.fsum(terms)

        at, between = (osc.mu * total(mpmath.mpf(shift)) for shift in (0, 0.5))
        return (at + between) / 2, abs(at - between) / 2


# p, omega, delta, gamma of the problems at which the chapter compares the closed form with the sums, as decimal text.
PROBLEMS = tuple((p, *rest) for p in ("0.1", "0.5", "1", "3") for rest in (("0.2", "-1", "1"), ("4", "-1.7", "0.6")))


def agreeing_digits(problems, alpha="0.1", mu="0.3", t0="0.7", digits=50):
    """Digits to which the closed form of M(t0) and the sums agree over the problems (p, omega, delta, gamma): int."""
    worst = mpmath.mpf(0)
    with mpmath.workdps(digits + 15):
        t0 = mpmath.mpf(t0)
        for p, omega, delta, gamma in problems:
            osc = Duffing(*map(mpmath.mpf, (alpha, p, mu, omega, delta, gamma)))
            worst = max(worst, abs(melnikov_quadrature(osc, t0, digits=digits) / melnikov_function(osc, t0) - 1))
        return int(mpmath.floor(-mpmath.log10(worst)))
