"""The theorems on one oscillator, and how each is found: below, above and between two forcing amplitudes."""

from fractions import Fraction

from flint import ctx

from .contact import contact, meeting
from .cover import cover, domain
from .oscillator import NotProved, ball
from .pieces import BITS, UNIT, Setting, curve, difference, flown, inner, piece
from .rational import fraction, period, point, written

SHARE = Fraction(48, 10**10)  # (mu_t - mu_low) / mu_t, and the same above
FINE = {"depth": 17, "orders": (24, 12)}


def prove(osc, guess, each=map, tick=lambda: None):
    """The certificate of an oscillator: a dict of JSON's types. guess : a forcing amplitude near the tangency.

    Raises NotProved, with the step that failed and the width it had.
    """
    mu, time, bend = contact(osc, guess)
    low, high = (Fraction(round(mu * (1 + share) * 10**16), 10**16) for share in (-SHARE, SHARE))
    return {
        "oscillator": {name: str(getattr(osc, name)) for name in ("p", "alpha", "omega", "delta", "gamma")},
        "low": str(low),
        "high": str(high),
        "saddle": saddle_orbit(Setting(osc, high, **FINE)),
        "below": below(Setting(osc, low), each, tick),
        "above": above(Setting(osc, high, **FINE), time, bend),
        "between": between(Setting(osc, (low + high) / 2, (high - low) / 2), each, tick),
    }


def saddle_orbit(setting):
    """Where the saddle orbit is at phase 0, the radius in which it is the only one, what its half map stretches by."""
    here = curve(setting)
    x, v = (written(here.saddle.z[i, 0]) for i in (0, 1))
    return {"x": x, "v": v, "box": written(here.saddle.box), "stretch": written(here.factor), "slope": written(here.L)}


def below(setting, each=map, tick=lambda: None):
    """No primary intersection at the setting's forcing amplitudes: pieces of both manifolds, all apart."""
    (unstable, stable), least = cover(setting, each=each, tick=tick)
    return {"depth": setting.depth, "unstable": unstable, "stable": stable, "gap": f"{float(least):.3e}"}


def above(setting, time, bend):
    """A transverse primary intersection: a thin piece of each manifold about a zero of x_u - x_s.

    time : of the greatest x_u - x_s, nearly; bend : its second derivative there.
    """
    with ctx.workprec(BITS):
        near = meeting(setting, time, None)
        away = (-2 * near.apart / bend).sqrt()
        time = (time + away).mid()
        for _ in range(4):
            near = meeting(setting, time, near)
            time = (time - near.apart / near.slope).mid()
        near, half = meeting(setting, time, near), away / 500
        records = []
        for side, xi in ((setting, near.unstable), (setting.reversed(), near.stable)):
            here = curve(side)
            width = half / (here.r * flown_rate(side, xi))
            middle = xi / here.r
            ends = (fraction(((middle + sign * width) * UNIT).floor().mid()) for sign in (-1, 1))
            records.append(flown(side, 0, *map(int, ends)))
        u, s = map(piece, records)
        turns = round((u.t.middle + s.t.middle) / period(setting.osc.omega).middle)
        turn = period(setting.osc.omega) * point(turns)
        inside = [inner(setting, u), turn - inner(setting, s)]
        ends = max(i.low for i in inside), min(i.high for i in inside)
        result = {"depth": setting.depth, "unstable": records[0], "stable": records[1], "turns": turns}
        result["times"] = [f"{float(t):.15f}" for t in (ends[0] * 9 + ends[1], ends[0] + ends[1] * 9) for t in [t / 10]]
    transverse(setting, result)
    return result


def flown_rate(setting, xi):
    """|dt/dxi| at a point of the manifold, nearly."""
    here = curve(setting)
    n = int(fraction((xi / here.r * UNIT).floor().mid()))
    return ball(-piece(flown(setting, 0, n, n)).rate.middle)


def transverse(setting, found):
    """Assert a transverse intersection in what `above` found: x_s - x_u changes its sign, its slope does not."""
    u, s = piece(found["unstable"]), piece(found["stable"])
    turn = period(setting.osc.omega) * point(found["turns"])
    ends = [point(Fraction(time)) for time in found["times"]]
    for end in ends:
        for inside in (inner(setting, u), turn - inner(setting, s)):
            if not inside.low < end.low < inside.high:
                raise NotProved(f"the pieces do not both cross at the time {float(end.low)}")
    first, last = (difference(u, s, turn, end) for end in ends)
    if not (first.high < 0 < last.low or last.high < 0 < first.low):
        raise NotProved(f"no change of sign between {float(first.middle):.2e} and {float(last.middle):.2e}")
    slope = point(0) - s.slope - u.slope
    if slope.low <= 0 <= slope.high:
        width = f"{float(slope.middle):.1e} +- {float(slope.radius):.1e}"
        raise NotProved(f"the manifolds may be parallel: their slopes differ by {width}")


def between(setting, each=map, tick=lambda: None):
    """For every forcing amplitude of the interval both manifolds are graphs over the phase: the pieces."""
    sides = [domain(side, 20, each, tick) for side in (setting, setting.reversed())]
    return {"depth": setting.depth, "pieces": [[record[:3] for record in side] for side in sides]}
