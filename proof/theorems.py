"""The theorems on one oscillator, and how each is found: below, above and between two forcing amplitudes."""

from fractions import Fraction
from math import exp

from .cover import cover, domain
from .oscillator import NotProved
from .pieces import UNIT, Setting, curve, difference, factor, flown, inner, piece
from .rational import period, point, read, written
from .saddle import RADIUS

FINE = {"depth": 19, "orders": (24, 12)}
NEAR = 2e-7  # half the time that a piece about the transverse intersection takes to cross


def prove(osc, low, high, time, each=map, tick=lambda: None):
    """The certificate of an oscillator: a dict of JSON's types. Raises NotProved: which step, and the width it had.

    low, high : forcing amplitudes about the tangency; time : of a primary intersection at high, nearly.
    """
    return {
        "oscillator": {name: str(getattr(osc, name)) for name in ("p", "alpha", "omega", "delta", "gamma")},
        "low": str(low),
        "high": str(high),
        "saddle": saddle_orbit(Setting(osc, high, **FINE)),
        "below": below(Setting(osc, low), each, tick),
        "above": above(Setting(osc, high, **FINE), time),
        "between": between(Setting(osc, (low + high) / 2, (high - low) / 2), each, tick),
    }


def saddle_orbit(setting):
    """Where the saddle orbit is at phase 0, the radius in which it is the only one, what its half map stretches by."""
    here = curve(setting)
    x, v = (written(here.saddle.z[i, 0]) for i in (0, 1))
    return {"x": x, "v": v, "box": str(RADIUS), "stretch": written(here.factor), "slope": written(here.L)}


def below(setting, each=map, tick=lambda: None):
    """No primary intersection at the setting's forcing amplitudes: pieces of both manifolds, all apart."""
    (unstable, stable), least = cover(setting, each=each, tick=tick)
    return {"depth": setting.depth, "unstable": unstable, "stable": stable, "gap": f"{float(least):.3e}"}


def above(setting, time):
    """A transverse primary intersection near a time of crossing: a thin piece of each manifold about it."""
    for _ in range(3):
        records = thin(setting, time), thin(setting.reversed(), -time)
        u, s = map(piece, records)
        turns = round((u.t.middle + s.t.middle) / period(setting.osc.omega).middle)
        turn = period(setting.osc.omega) * point(turns)
        time = float(u.t.middle + (difference(u, s, turn, u.t).middle / (u.slope + s.slope).middle))
    inside = inner(setting, u), turn - inner(setting, s)
    first, last = max(one.low for one in inside), min(one.high for one in inside)
    times = [f"{float((share * first + (10 - share) * last) / 10):.15f}" for share in (9, 1)]
    found = {"depth": setting.depth, "unstable": records[0], "stable": records[1], "turns": turns, "times": times}
    transverse(setting, found)
    return found


def thin(setting, time):
    """The record of a piece that crosses within NEAR of a time, modulo the period. Raises NotProved."""
    turn, stretch = float(period(setting.osc.omega).middle), float(read(factor(setting)).middle)
    n = UNIT // 4
    for _ in range(20):
        one = piece(flown(setting, 0, n, n))
        late = (float(one.t.middle) - time + turn / 2) % turn - turn / 2
        rate = float(one.rate.middle) * 2.0**-setting.depth / UNIT
        if abs(late) < NEAR / 100:
            half = round(-NEAR / rate)
            return flown(setting, 0, n - half, n + half)
        n = round(n * exp(-late / (n * rate)))
        while n > UNIT:
            n = round(n / stretch**2)
    raise NotProved(f"no piece is found that crosses at the time {time}: {late:.1e} away")


def transverse(setting, found):
    """Assert a transverse intersection in what `above` found: x_s - x_u changes its sign, its slope does not."""
    u, s = piece(found["unstable"]), piece(found["stable"])
    if type(found["turns"]) is not int:
        raise NotProved(f"turns = {found['turns']!r}: must be a whole number")
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
