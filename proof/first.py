"""No primary intersection for any forcing amplitude up to mu_low: (0, mu_low] in intervals, each proved by itself."""

from fractions import Fraction
from itertools import pairwise
from random import Random

from .check import covers, oscillator, separated, sides
from .cover import cover, halves
from .oscillator import NotProved
from .pieces import Setting, factor, first_pieces, flown
from .rational import read

WIDTH, MOST = 18, 1500  # of the first pieces, and how many pieces an interval may take


def intervals(low):
    """Pairs of forcing amplitudes that join from 0 to `low`; at the end each is a third of the last."""
    parts = [Fraction(n, 100) for n in (1, *range(2, 95, 3))] + [1 - Fraction(5, 100 * 3**k) for k in range(15)]
    ends = [Fraction(0), *(Fraction(round(low * part * 10**14), 10**14) for part in parts), low]
    return list(pairwise(ends))


def setting(osc, low, high):
    """The Setting of an interval: r shrinks towards the tangency, where the launch must be exact."""
    return Setting(osc, (low + high) / 2, (high - low) / 2, depth=10 if high - low > high / 1000 else 15)


def prove_interval(task):
    """The record of an interval (osc, low, high): ends, pieces of both manifolds, least gap. Raises NotProved."""
    osc, low, high = task
    here = setting(osc, low, high)
    try:
        both, least = cover(here, WIDTH, most=MOST)
    except NotProved as failure:
        raise NotProved(f"for mu from {float(low)} to {float(high)}: {failure}") from None
    texts = [halvings(side, rows) for (side, _), rows in zip(sides(here), both, strict=True)]
    return [str(low), str(high), *texts, f"{float(least):.2e}"]


def halvings(setting, records):
    """The pieces as text: of each of the first pieces 0 where it was taken whole, 1 and its halves' text where not."""
    taken = {tuple(record[:3]) for record in records}

    def text(ends):
        return "0" if ends in taken else "1" + "".join(map(text, halves(*ends)))

    return "".join(map(text, first_pieces(read(factor(setting)).high, WIDTH)))


def pieces(setting, text):
    """The pieces (turn, low, high) that a text of `halvings` means."""
    marks = iter(text)

    def parts(ends):
        return [ends] if next(marks) == "0" else [part for half in halves(*ends) for part in parts(half)]

    return [part for ends in first_pieces(read(factor(setting)).high, WIDTH) for part in parts(ends)]


def check_first(certificate, records, sample=10, seed=0):
    """Assert that the intervals join from 0 to mu_low and, in one of them, that pieces cover and a sample is apart.

    sample : pieces of each manifold that are flown; None: all of them, in all intervals, which is the whole proof.
    Raises NotProved. Returns how many pairs of pieces shared a phase.
    """
    osc, chance = oscillator(certificate), Random(seed)
    starts, stops = ([Fraction(record[i]) for record in records] for i in (0, 1))
    if [0, *stops] != [*starts, Fraction(certificate["low"])]:
        raise NotProved("the intervals do not join from 0 to mu_low")
    return sum(_pairs(osc, one, sample, chance) for one in (records if sample is None else [chance.choice(records)]))


def _pairs(osc, record, sample, chance):
    here, both = setting(osc, Fraction(record[0]), Fraction(record[1])), []
    for (side, _), text in zip(sides(here), record[2:4], strict=True):
        ends = pieces(side, text)
        covers(side, ends)
        chosen = ends if sample is None else chance.sample(ends, min(sample, len(ends)))
        both.append([flown(side, *one) for one in chosen])
    return len(separated(here, both))
