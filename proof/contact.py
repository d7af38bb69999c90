"""Where the manifolds touch, nearly: a search that proves nothing and tells the proofs where to look."""

from dataclasses import dataclass
from fractions import Fraction

from flint import arb, ctx

from .manifold import fly
from .oscillator import NotProved, ball
from .pieces import BITS, Setting, curve


@dataclass(frozen=True)
class Meeting:
    """The points of both manifolds at one phase: places on the curves, difference x_u - x_s and its derivatives."""

    unstable: arb
    stable: arb
    apart: arb
    slope: arb
    by_mu: arb


def at_time(here, t, period, xi):
    """(Flight, xi, lateness) of a point of the manifold that crosses v = 0 at the time t modulo the period, nearly."""
    for _ in range(8):
        flight = fly(here, xi, xi)
        late = ((flight.t - t) / period).mid()
        late = ((late - (late + 0.5).floor()) * period).mid()
        if abs(late) < 1e-7:
            return flight, xi, late
        xi = (xi * (-late / (xi * flight.rate.mid())).exp()).mid()
        if not xi < here.r:
            xi = (xi / here.factor**2).mid()
    raise NotProved("the search for a phase does not converge")


def meeting(setting, t, near):
    """The Meeting at the time t of crossing; near : a Meeting close by or None."""
    with ctx.workprec(BITS):
        here, back = curve(setting), curve(setting.reversed())
        period = 2 * arb.pi() / ball(setting.osc.omega)
        xi, eta = (near.unstable, near.stable) if near else ((here.r / 4).mid(), (back.r / 4).mid())
        u, xi, late = at_time(here, t, period, xi)
        s, eta, early = at_time(back, -t, period, eta)
        apart = u.x - s.x - u.slope.mid() * late + s.slope.mid() * early
        return Meeting(xi, eta, apart.mid(), (u.slope + s.slope).mid(), (u.by_mu - s.by_mu).mid())


def highest(setting, t, near=None):
    """(time, Meeting) where x_u - x_s is greatest, from a time near it: the zero of its slope by secants."""
    with ctx.workprec(BITS):
        old, t_old = meeting(setting, t, near), t
        t = (t + arb("0.01")).mid()
        for _ in range(12):
            new = meeting(setting, t, old)
            bend = (new.slope - old.slope) / (t - t_old)
            if abs(new.slope) < 1e-7:
                return t, new, bend.mid()
            t_old, old, t = t, new, (t - new.slope / bend).mid()
    raise NotProved("the search for the contact does not converge")


def contact(osc, guess, depth=17):
    """(mu, time) of the tangency, nearly, from a forcing amplitude near it: Newton in mu at the highest phase."""
    mu, t, near = Fraction(guess), (arb.pi() / 2 / ball(osc.omega)).mid(), None
    for _ in range(8):
        t, near, bend = highest(Setting(osc, mu, depth=depth), t, near)
        change = float(near.apart / near.by_mu)
        mu -= Fraction(change).limit_denominator(10**18)
        if abs(change) < 1e-9 * mu:
            return mu, t, bend
    raise NotProved("the search for the tangency does not converge")
