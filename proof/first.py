"""No primary intersection for any forcing amplitude up to mu_low: (0, mu_low] in intervals, each proved by itself."""

from fractions import Fraction
from itertools import pairwise
from random import Random

from .check import covers, oscillator, sides
from .cover import cover, falling, halves, shared
from .oscillator import NotProved
from .pieces import Setting, factor, first_pieces, flown, piece
from .rational import period, read
from .theorems import SHARE

WIDTH, MOST = 18, 1500  # of the first pieces, and how many pieces an interval may take before it is divided


def intervals(low, share):
    """Ends of intervals of mu from 0 to `low`; share : of mu that lies between low and the tangency, nearly."""
    tangency, away = low / (1 - share), share
    ends = [low]
    while away < Fraction(1, 50):
        away *= 3
        ends.append(rounded(tangency * (1 - away)))
    ends += [rounded(tangency * Fraction(n, 100)) for n in (88, 78, 68, 56, 44, 30, 15)]
    return [*ends, Fraction(0)][::-1]


def rounded(mu):
    """To 14 decimals, which is exact enough to be written down."""
    return Fraction(round(mu * 10**14), 10**14)


def setting(osc, low, high):
    """The Setting of an interval: r shrinks towards the tangency, where the launch must be exact."""
    return Setting(osc, (low + high) / 2, (high - low) / 2, depth=8 if (high - low) / high > Fraction(1, 10**5) else 12)


def prove_interval(task):
    """Records of one interval (osc, low, high), or of its parts where the whole is not proved. Raises NotProved."""
    osc, low, high = task
    try:
        here = setting(osc, low, high)
        both, least = cover(here, WIDTH, most=MOST)
        texts = [halvings(side, rows) for (side, _), rows in zip(sides(here), both, strict=True)]
        return [[str(low), str(high), *texts, f"{float(least):.2e}"]]
    except NotProved:
        middle = rounded((low + 2 * high) / 3)
        if not low < middle < high or high - low < high / 10**9:
            raise
        return prove_interval((osc, low, middle)) + prove_interval((osc, middle, high))


def halvings(setting, records):
    """The pieces as text: of each of the first pieces 0 where it was taken whole, 1 and its halves' text where not."""
    taken = {tuple(record[:3]) for record in records}

    def text(ends):
        return "0" if ends in taken else "1" + "".join(map(text, halves(*ends)))

    return "".join(map(text, first_pieces(read(factor(setting)).high, WIDTH)))


def pieces(setting, text):
    """The pieces (turn, low, high) that a text of `halvings` means."""
    found, marks = [], iter(text)

    def walk(ends):
        if next(marks) == "0":
            found.append(ends)
        else:
            for half in halves(*ends):
                walk(half)

    for ends in first_pieces(read(factor(setting)).high, WIDTH):
        walk(ends)
    return found


def prove_first(certificate, each=map, known=()):
    """Yields lists of interval records, lowest forcing first, of (0, low] for the `low` of a certificate.

    known : records of an earlier, interrupted run, which are not proved again.
    """
    osc, low = oscillator(certificate), Fraction(certificate["low"])
    ends = intervals(low, SHARE)
    have = {(record[0], record[1]) for record in known}
    todo = [(osc, *pair) for pair in pairwise(ends) if not covered(pair, have)]
    yield from each(prove_interval, todo)


def covered(pair, have):
    """Whether intervals that are had already reach from the pair's low end to its high one."""
    return reach(pair[0], have) >= pair[1]


def reach(low, have):
    """How far intervals (low, high) that join one another go up from a forcing amplitude."""
    after = {Fraction(a): Fraction(b) for a, b in have}
    while low in after:
        low = after[low]
    return low


def check_first(certificate, records, sample=20, seed=0):
    """Assert that the intervals join from 0 on and, in one of them, that pieces cover and a sample of pairs is apart.

    sample : pieces of each manifold that are flown; None: all of them, in all intervals, which is the whole proof.
    Raises NotProved. Returns how far the intervals reach, at most the `low` of the certificate, and how many pairs of
    pieces shared a phase.
    """
    osc, low, chance = oscillator(certificate), Fraction(certificate["low"]), Random(seed)
    top = reach(Fraction(0), [record[:2] for record in records])
    if top < max(Fraction(record[1]) for record in records):
        raise NotProved(f"the intervals leave a hole above {float(top)}")
    if top > low:
        raise NotProved(f"the intervals go beyond {float(low)}")
    return top, sum(
        _apart(osc, one, sample, chance) for one in (records if sample is None else [chance.choice(records)])
    )


def _apart(osc, record, sample, chance):
    here, both = setting(osc, Fraction(record[0]), Fraction(record[1])), []
    for (side, _), text in zip(sides(here), record[2:4], strict=True):
        ends = pieces(side, text)
        covers(side, ends)
        chosen = ends if sample is None else chance.sample(ends, min(sample, len(ends)))
        both.append([piece(one) for one in falling([flown(side, *one) for one in chosen])])
    unstable, stable = both
    apart = [least for one in unstable for _, least in shared(one, stable, period(osc.omega), here.spread)]
    if apart and not min(apart) > 0:
        raise NotProved(f"the manifolds may meet at a mu from {record[0]} to {record[1]}: gap {float(min(apart)):.1e}")
    return len(apart)
