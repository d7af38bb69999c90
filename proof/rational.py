"""Intervals with rational ends, in exact arithmetic: what a certificate holds and what its checker computes with."""

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, log10

PI_LOW = Fraction("3.14159265358979323846264338327950288")  # the decimals of pi, cut off


@dataclass(frozen=True)
class Interval:
    """The real numbers from low to high."""

    low: Fraction
    high: Fraction

    def __add__(self, other):
        return Interval(self.low + other.low, self.high + other.high)

    def __sub__(self, other):
        return Interval(self.low - other.high, self.high - other.low)

    def __mul__(self, other):
        ends = [a * b for a in (self.low, self.high) for b in (other.low, other.high)]
        return Interval(min(ends), max(ends))

    @property
    def middle(self):
        return (self.low + self.high) / 2

    def distance(self, other):
        """The greatest distance of two numbers of the intervals."""
        return max(self.high - other.low, other.high - self.low)

    @property
    def radius(self):
        return (self.high - self.low) / 2


def point(value):
    """The interval of one number."""
    return Interval(Fraction(value), Fraction(value))


def period(omega):
    """2 pi / omega."""
    return Interval(2 * PI_LOW / omega, 2 * (PI_LOW + Fraction(1, 10**35)) / omega)


def fraction(exact_ball):
    """The dyadic number that an exact ball of python-flint holds."""
    mantissa, exponent = exact_ball.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def written(ball):
    """A ball as two decimal strings, [middle, radius], that hold it: rounded outward."""
    low, high = fraction(ball.lower()), fraction(ball.upper())
    middle, radius = (low + high) / 2, (high - low) / 2
    digits = max(4, 2 - floor(log10(radius))) if radius else 30
    rounded = Fraction(round(middle * 10**digits), 10**digits)
    outer = ceil((radius + abs(middle - rounded)) * 10**digits)
    return [decimal(rounded, digits), f"{outer}e-{digits}"]


def read(pair):
    """The Interval of two decimal strings [middle, radius]."""
    middle, radius = map(Fraction, pair)
    return Interval(middle - radius, middle + radius)


def rounded(value, towards):
    """A positive fraction to two digits as float, towards : floor or ceil."""
    exponent = floor(log10(value)) - 1
    return float(f"{towards(value / Fraction(10) ** exponent)}e{exponent}")


def decimal(value, digits):
    """A fraction that ends after so many decimals, as a string."""
    count = int(value * 10**digits)
    return f"{'-' * (count < 0)}{abs(count) // 10**digits}.{abs(count) % 10**digits:0{digits}d}"
