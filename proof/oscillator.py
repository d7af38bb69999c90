"""The equation in exact numbers: its force, and the Taylor coefficients of a solution and of its derivatives.

    x'' + alpha x'|x'|^(p-1) + delta x + gamma x^3 = mu cos(omega t),    p = 1, 2 or 3

For p = 1 and 3 the field is a polynomial; for p = 2 it is one on each side of v = 0, and continuously differentiable.

The parameters are rational. Backward in time, (x, v, t) -> (x, -v, -t), the equation is itself with -alpha, so the
stable manifold of the oscillator is the unstable one of `reversed()`, mirrored: everything is computed once.
"""

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from operator import mul

from flint import arb, ctx, fmpq

ZERO, ONE = arb(0), arb(1)
SIGNS = (("alpha", 1, "> 0"), ("omega", 1, "> 0"), ("delta", -1, "< 0"), ("gamma", 1, "> 0"))


class NotProved(ArithmeticError):
    """An inequality that the proof needs did not come out; the message says which step and the width it had."""


@dataclass(frozen=True)
class Oscillator:
    """The parameters without the forcing amplitude, rational; direction -1: time runs backward.

    sign : for p = 2, that of v where it is known: the friction is sign v^2 at every v. 0: v |v|, no polynomial.
    Raises ValueError outside the theorems' reach: p in {1, 2, 3}, alpha > 0, omega > 0, delta < 0 < gamma.
    """

    p: int = 1
    alpha: Fraction = Fraction(1, 10)
    omega: Fraction = Fraction(1)
    delta: Fraction = Fraction(-1)
    gamma: Fraction = Fraction(1)
    direction: int = 1
    sign: int = 0

    def __post_init__(self):
        if self.p not in (1, 2, 3):
            raise ValueError(f"p = {self.p!r}: covered are p = 1, 2 and 3, where the field is made of polynomials")
        for name, sign, allowed in SIGNS:
            value = exact(name, getattr(self, name))
            if not sign * value > 0:
                raise ValueError(f"{name} = {value}: covered are rational {name} {allowed}")
            object.__setattr__(self, name, value)

    def reversed(self):
        """The same equation backward in time."""
        return replace(self, direction=-self.direction)

    @property
    def coefficients(self):
        """(damping, delta, gamma) as balls; the damping carries the direction of time."""
        return _balls(self.direction * self.alpha, self.delta, self.gamma, ctx.prec)

    @property
    def well(self):
        """Where the right well is deepest, x = sqrt(-delta / gamma), as ball."""
        _, delta, gamma = self.coefficients
        return (-delta / gamma).sqrt()


def exact(name, value):
    """A rational number from an int, a Fraction or a decimal string; a float is refused, since it is another number."""
    if isinstance(value, bool) or not isinstance(value, int | str | Fraction):
        raise ValueError(f"{name} = {value!r}: must be an int, a Fraction or a decimal string, which are exact")
    try:
        return Fraction(value)
    except (ValueError, ZeroDivisionError):
        raise ValueError(f"{name} = {value!r}: must be a rational number") from None


@lru_cache(maxsize=64)
def _balls(*values):
    return tuple(map(ball, values[:-1]))


def ball(value):
    """The ball of a rational number at the present precision."""
    return arb(fmpq(value.numerator, value.denominator))


def around(radius):
    """The ball [-radius, radius]."""
    return arb(0, radius)


def force(osc, x, v, mu, phase):
    """v' at states, forcing and phases in balls."""
    damping, delta, gamma = osc.coefficients
    return mu * phase.cos() - (delta + gamma * x * x) * x - damping * friction(osc, v)[0]


def friction(osc, v):
    """v |v|^(p-1) and its derivative, v in a ball; not v**p, which is no number where a ball holds 0."""
    if osc.p == 2:
        if osc.sign:
            return osc.sign * v * v, 2 * osc.sign * v
        return (v * abs(v)).union(ZERO), 2 * abs(v)  # with what a step leaves out that computes without friction
    return (v, ONE) if osc.p == 1 else (v * v * v, 3 * v * v)


def stiffness(osc, x, v):
    """(-dv'/dx, -dv'/dv) at states in balls."""
    damping, delta, gamma = osc.coefficients
    return delta + 3 * gamma * x * x, damping * friction(osc, v)[1]


def drive(osc, phase, order):
    """Taylor coefficients of cos(omega t + phase) in t."""
    c, s, omega = phase.cos(), phase.sin(), ball(osc.omega)
    cycle, coefficients, power = (c, -s, -c, s), [], ONE
    for k in range(order):
        coefficients.append(cycle[k % 4] * power)
        power = power * omega / (k + 1)
    return coefficients


def _product(a, b, k):
    """Coefficient k of the product of two series."""
    return sum(map(mul, a, b[k::-1]), ZERO)


def taylor(osc, x, v, mu, cosine, order, tangents=0):
    """Taylor coefficients of x(t) up to `order`, and up to `tangents` of its derivatives by x, v and mu.

    By the recurrence that the equation gives: products of series are sums over lower coefficients.
    Those of v(t) are (k + 1) x_(k+1). Returns a list of balls and three such lists (empty when tangents is 0).
    cosine : what `drive` returns for at least that order.
    """
    damping, delta, gamma = osc.coefficients
    a, rate, square, rate_square = [x, v], [v], [], []
    for k in range(order - 1):
        square.append(_product(a, a, k))
        rate_square.append(_product(rate, rate, k) if osc.p > 1 else ZERO)
        slowing = (rate[k], osc.sign * rate_square[k], _product(rate_square, rate, k))[osc.p - 1]
        pull = delta * a[k] + gamma * _product(square, a, k)
        a.append((mu * cosine[k] - pull - damping * slowing) / ((k + 1) * (k + 2)))
        rate.append((k + 2) * a[k + 2])
    if not tangents:
        return a, []
    pull = [3 * gamma * value for value in square]
    pull[0] += delta
    slope = ([ONE], [2 * osc.sign * value for value in rate], [3 * value for value in rate_square])[osc.p - 1]
    columns = [[ONE, ZERO], [ZERO, ONE], [ZERO, ZERO]]
    for number, b in enumerate(columns):
        rate = [b[1]]
        for k in range(tangents - 1):
            slowing = damping * _product(slope, rate, k)
            push = cosine[k] if number == 2 else ZERO
            b.append((push - _product(pull, b, k) - slowing) / ((k + 1) * (k + 2)))
            rate.append((k + 2) * b[k + 2])
    return a, columns
