"""A fundamental domain of the manifold in pieces, as numbers that can be written down: exact rationals.

The half map stretches xi by at most g, so each solution of the manifold has r / g <= xi <= r at some phase k pi: the
pieces of [r / g, r] at the phases 0 and pi are all of it. A piece's ends are whole numbers n, xi = n r / 2^40. Each is
flown to v = 0 by itself, so that they can be flown on several cores, and any of them anew.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

from flint import arb, ctx

from .manifold import fly, local_curve
from .oscillator import NotProved, Oscillator, ball
from .rational import Fraction, Interval, point, read, written
from .saddle import saddle

UNIT = 2**40
BITS = 96
NONE = Fraction(0)


@dataclass(frozen=True)
class Setting:
    """Which manifold: oscillator (its direction included), forcing amplitudes mu +- spread, r = 2^-depth.

    orders : of the Taylor polynomials and of their derivatives'.
    """

    osc: Oscillator
    mu: Fraction
    spread: Fraction = NONE
    depth: int = 15
    orders: tuple = (16, 10)

    def reversed(self):
        """The stable manifold's setting."""
        return replace(self, osc=self.osc.reversed())


@dataclass(frozen=True)
class Piece:
    """Phase 0 or pi (turn 0 or 1), ends in units of r / 2^40, and manifold.Flight's numbers as Intervals.

    t, x : the middle's, at mu; time : the whole; slope : dx/dt; by_mu : dx/dmu at fixed t; rate : dt/dxi.
    """

    turn: int
    low: int
    high: int
    t: Interval
    x: Interval
    time: Interval
    slope: Interval
    by_mu: Interval
    rate: Interval


@lru_cache(maxsize=16)
def curve(setting):
    """The local curve of a setting: about the exact middle of the ball of mu, what is left of mu in `rest`."""
    with ctx.workprec(BITS):
        mu = ball(setting.mu)
        rest = mu - mu.mid()
        spread = arb(0, (ball(setting.spread) + rest).abs_upper())
        backward = setting.osc.direction < 0
        orbit = curve(setting.reversed()).saddle.reversed() if backward else saddle(setting.osc, mu.mid(), spread)
        return local_curve(setting.osc, orbit, rest, arb(2) ** -setting.depth)


def factor(setting):
    """How much a half turn stretches the curve at most, as written interval."""
    return written(curve(setting).factor)


def flown(setting, turn, low, high):
    """The record of a piece: its turn, its ends and six [middle, radius] pairs, rounded outward. Raises NotProved."""
    if turn not in (0, 1) or not (type(low) is type(high) is int and 0 < low <= high <= UNIT):
        raise NotProved(f"the piece {turn}, {low}, {high}: must be of turn 0 or 1, with whole 0 < low <= high <= 2^40")
    with ctx.workprec(BITS):
        here = curve(setting)
        flight = fly(here, here.r * low / UNIT, here.r * high / UNIT, turn, setting.orders)
        balls = (flight.t, flight.x, flight.time, flight.slope, flight.by_mu, flight.rate)
        return [turn, low, high, *map(written, balls)]


def piece(record):
    """The Piece of a record."""
    return Piece(*record[:3], *map(read, record[3:]))


def first_pieces(stretch, width):
    """(turn, low, high) of pieces that cover [r / stretch, r] at both phases, each shorter by 1/width than its end."""
    ends = [UNIT]
    while ends[-1] * stretch > UNIT:
        ends.append(ends[-1] * (width - 1) // width)
    return [(turn, low, high) for turn in (0, 1) for low, high in zip(ends[1:], ends, strict=False)]


def inner(setting, piece):
    """Times that a piece is proved to cross at, not only within: |t'| half the width on both sides of the middle."""
    half = Fraction(piece.high - piece.low, 2 * UNIT * 2**setting.depth)
    reach = -piece.rate.high * half
    return Interval(piece.t.high - reach, piece.t.low + reach)


def difference(unstable, stable, turn, time):
    """x_s - x_u at a time (an Interval) where both pieces cross: the mean value theorem from their middles."""
    middle = stable.x - unstable.x
    return middle + stable.slope * ((turn - stable.t) - time) + unstable.slope * (unstable.t - time)


def gap(unstable, stable, turn, spread=NONE):
    """A lower bound of x_s - x_u at all phases that two pieces share, and for all mu of the interval.

    stable : a Piece of the reversed oscillator, that is time and slope with the other sign; turn : the whole number
    of periods between them as Interval. None where they share no phase. By the mean value theorem:

        x_s - x_u = x_s(t_s) - x_u(t_u) + S_s (c - t_s) - S_u (c - t_u) + (S_s - S_u)(t - c) + (B_s - B_u)(mu' - mu)
    """
    backward = turn - stable.time
    low, high = max(unstable.time.low, backward.low), min(unstable.time.high, backward.high)
    if low > high:
        return None
    middle, zero = difference(unstable, stable, turn, point((low + high) / 2)), point(0)
    reach = Interval((low - high) / 2, (high - low) / 2)
    turning = (zero - stable.slope - unstable.slope) * reach
    return (middle + turning + (stable.by_mu - unstable.by_mu) * Interval(-spread, spread)).low
