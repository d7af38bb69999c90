"""No primary intersection: the pieces of both manifolds that share a phase are apart; those that are not are halved."""

from bisect import bisect_left

from .oscillator import NotProved
from .pieces import factor, first_pieces, flown, gap, piece
from .rational import period, point, read

FINEST = 2**12  # a piece is not halved below this many units


def attempt(task):
    """The record of a piece (setting, low, high), or what failed: for `map` over processes."""
    try:
        return flown(*task)
    except NotProved as failure:
        return str(failure)


def falling(records):
    """Records in the order of falling crossing times."""
    return sorted(records, key=lambda record: -read(record[5]).high)


def shared(unstable, stables, turn, spread):
    """(j, gap) of the stable pieces that share a phase with an unstable one, at any number of turns.

    stables : Pieces in the order of falling times.
    """
    longest = max(s.time.high - s.time.low for s in stables)
    starts = [-s.time.high for s in stables]  # rising
    first, last = (int((unstable.time.low + s.time.low) / turn.high) for s in (stables[-1], stables[0]))
    for k in range(first, last + 3):
        shift = turn * point(k)
        for j in range(bisect_left(starts, unstable.time.low - shift.high - longest), len(stables)):
            if starts[j] > unstable.time.high - shift.low:
                break
            apart = gap(unstable, stables[j], shift, spread)
            if apart is not None:
                yield j, apart


def domain(setting, width, each=map, tick=lambda: None):
    """Records of pieces that cover a fundamental domain of a manifold, halved until each is a graph over the phase."""
    return flown_or_halved(setting, first_pieces(read(factor(setting)).high, width), each, tick)


def flown_or_halved(setting, todo, each, tick):
    """Records of the pieces (turn, low, high), or of their halves where the whole could not be flown."""
    records = []
    while todo:
        halved = []
        for ends, result in zip(todo, each(attempt, [(setting, *ends) for ends in todo]), strict=True):
            tick()
            if isinstance(result, str):
                halved += _fine(ends, result)
            else:
                records.append(result)
        todo = halved
    return falling(records)


def halves(turn, low, high):
    """A piece in two."""
    middle = (low + high) // 2
    return [(turn, low, middle), (turn, middle, high)]


def _fine(ends, why):
    if ends[2] - ends[1] < 2 * FINEST:
        raise NotProved(f"a piece of relative width {(ends[2] - ends[1]) / ends[1]:.1e}: {why}")
    return halves(*ends)


def cover(setting, width=20, each=map, tick=lambda: None, most=5000):
    """Records (unstable, stable) whose pairs are all apart, and the least gap. Raises NotProved.

    width : the first pieces' ends differ by a part in it; most : pieces at the end.
    """
    sides = [setting, setting.reversed()]
    records = [domain(side, width, each, tick) for side in sides]
    turn = period(setting.osc.omega)
    while True:
        unstable, stable = ([piece(record) for record in side] for side in records)
        apart, close = [], [set(), set()]
        for i, u in enumerate(unstable):
            for j, least in shared(u, stable, turn, setting.spread):
                apart.append(least)
                if least <= 0:
                    s = stable[j]
                    coarser = u.slope.radius * u.time.radius >= s.slope.radius * s.time.radius
                    close[0 if coarser else 1].add(i if coarser else j)
        if not any(close):
            return records, min(apart)
        for side, which, rows in zip(sides, close, records, strict=True):
            why = f"{len(which)} pairs of pieces are not apart: gap {float(min(apart)):.1e}"
            if sum(map(len, records)) > most:
                raise NotProved(f"{most} pieces are not enough: {why}")
            todo = [half for i in which for half in _fine(tuple(rows[i][:3]), why)]
            kept = [row for i, row in enumerate(rows) if i not in which]
            rows[:] = falling(kept + flown_or_halved(side, todo, each, tick))
