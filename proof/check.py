"""The checker: reads a certificate and asserts each theorem's inequalities anew, in exact rational arithmetic.

Checked in full: the pieces cover a fundamental domain of each manifold (the local curve and its stretching are proved
anew), every pair of pieces at a common phase is apart, the transverse intersection's signs. Not in full: that the
numbers of a piece hold its flight. A sample of pieces is flown anew, and must come out within the numbers written
down, the two of the intersection always; `make proof` flies all of them.
"""

import json
from fractions import Fraction
from pathlib import Path
from random import Random

from .cover import falling, shared
from .oscillator import NotProved, Oscillator
from .pieces import UNIT, Setting, curve, factor, flown, piece
from .rational import period, read, written
from .saddle import RADIUS
from .theorems import FINE, saddle_orbit, transverse

CERTIFICATES = Path(__file__).parent / "certificates"


def load(name):
    """A certificate by its name: p1, p2, p3, first1, first2, first3."""
    return json.loads((CERTIFICATES / f"{name}.json").read_text(encoding="utf-8"))


def check(certificate, sample=10, seed=0):
    """Assert the theorems of a certificate; raises NotProved. sample : how many pieces are flown anew, None all.

    Returns (mu_low, mu_high, least gap) as Fractions.
    """
    osc, saddle = oscillator(certificate), certificate["saddle"]
    low, high = Fraction(certificate["low"]), Fraction(certificate["high"])
    if not 0 < low < high:
        raise NotProved(f"low = {float(low)}, high = {float(high)}: they must be in this order")
    least = check_below(Setting(osc, low), certificate["below"])
    transverse(Setting(osc, high, **FINE), certificate["above"])
    above, below = certificate["above"], certificate["below"]
    for side, name in sides(Setting(osc, high, **FINE)):
        flown_within(side, above[name])
    found = saddle_orbit(Setting(osc, high, **FINE))
    for name in ("x", "v", "stretch", "slope"):
        within(found[name], saddle[name], f"the saddle orbit's {name}")
    tasks = [(side, record) for side, name in sides(Setting(osc, low)) for record in below[name]]
    wide = Setting(osc, (low + high) / 2, (high - low) / 2)
    for i, name in enumerate("xv"):
        if not read(saddle[name]).distance(read(written(curve(wide).saddle.z[i, 0]))) < RADIUS / 20:
            raise NotProved(f"the saddle orbit's {name} is not near that of the bracket's middle")
    for side, pieces in zip((wide, wide.reversed()), certificate["between"]["pieces"], strict=True):
        covers(side, pieces)
        tasks += [(side, record) for record in pieces]
    chosen = tasks if sample is None else Random(seed).sample(tasks, min(sample, len(tasks)))
    for side, record in chosen:
        flown_within(side, record)
    return low, high, least


def sides(setting):
    """Both manifolds of a setting with their names."""
    return (setting, "unstable"), (setting.reversed(), "stable")


def oscillator(certificate):
    """The Oscillator of a certificate."""
    p, *values = (certificate["oscillator"][name] for name in ("p", "alpha", "omega", "delta", "gamma"))
    return Oscillator(int(p), *map(Fraction, values))


def covers(setting, records):
    """Assert that the pieces cover [r / g, r] at the phases 0 and pi, g the stretching proved anew."""
    stretch = read(factor(setting)).high
    for turn in (0, 1):
        ends = sorted(tuple(record[1:3]) for record in records if record[0] == turn)
        if not ends or ends[0][0] * stretch > UNIT or ends[-1][1] != UNIT:
            raise NotProved(f"the pieces from phase {turn} pi do not reach from r / g to r")
        for (low, high), (after, _) in zip(ends, [*ends[1:], (UNIT, UNIT)], strict=True):
            if not low < high or high < after:
                raise NotProved(f"the pieces from phase {turn} pi leave a hole after {high}")


def check_below(setting, found):
    """Assert that the pieces of both manifolds cover and are apart at all phases: the least gap."""
    for side, name in sides(setting):
        covers(side, found[name])
    return min(separated(setting, [found["unstable"], found["stable"]]))


def separated(setting, both):
    """The gaps of all pairs of pieces, of their records (unstable, stable), that share a phase: each positive."""
    unstable, stable = ([piece(record) for record in falling(records)] for records in both)
    for one in unstable + stable:
        if not one.rate.high < 0:
            raise NotProved(f"a piece is no graph over the phase: dt/dxi up to {float(one.rate.high):.1e}")
    gaps = [least for one in unstable for _, least in shared(one, stable, period(setting.osc.omega), setting.spread)]
    if gaps and not min(gaps) > 0:
        raise NotProved(f"the manifolds may meet at mu = {float(setting.mu)}: gap {float(min(gaps)):.1e}")
    return gaps


def flown_within(setting, record):
    """Fly a piece anew and assert that it comes out within its record (ends alone: that it is a graph)."""
    for new, old in zip(flown(setting, *record[:3])[3:], record[3:], strict=False):
        within(new, old, f"the piece {record[:3]}, flown anew,")


def within(new, old, what):
    """Assert that the interval of one pair of strings lies within that of another."""
    a, b = read(new), read(old)
    if not b.low <= a.low <= a.high <= b.high:
        raise NotProved(f"{what} is at {new}, not within {old}")
