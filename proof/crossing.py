"""A set of solutions is followed to its first crossing of v = 0 beyond the well, x > sqrt(-delta / gamma)."""

from dataclasses import dataclass, replace
from fractions import Fraction

from flint import arb, arb_mat, arb_poly

from .lohner import enclose, growth, step
from .oscillator import ZERO, NotProved, around, ball, drive, force, stiffness, taylor
from .rational import fraction

LONGEST = Fraction(40)  # half periods that a flight may take
LITTLE = 1e-14  # of v: a set that is no wider changes its sign in one step


@dataclass(frozen=True)
class Crossing:
    """Where a set crosses v = 0: time, x, the force F, and the derivative of (x, v) by r0 at the crossing time."""

    t: arb
    x: arb
    F: arb
    derivative: arb_mat


def time_step(x):
    """The step in half periods at a distance |x|: a Picard enclosure wants h |Df| < 0.5."""
    return Fraction(1, 8) if x < 0.15 else Fraction(1, 16) if x < 0.5 else Fraction(1, 32)


def advance(osc, now, orders, longest):
    """One step of at most `longest` half periods, halved where the enclosure fails."""
    part = min(time_step(abs(now.m[0, 0])), longest)
    field = osc
    if osc.p == 2 and not osc.sign:
        field, change = _known_sign(osc, now)
        part = min(part, change)
    for halved in range(6 if field is osc else 12):
        field, length = (field if halved < 6 else osc), part / 2 ** (halved % 6)
        try:
            h = ball(length) * arb.pi() / ball(osc.omega)
            after, held = step(field, now, h, orders, (now.turn + length, now.late))
            if field is not osc:
                _keeps_its_sign(field, now, after, held)
            return after, held
        except NotProved as failure:
            why = failure
    raise why


def _known_sign(osc, now):
    """For p = 2: (oscillator with the sign of v, half periods until just before v changes it).

    Where v is about to change its sign, the oscillator as it is and the time until it has. Both times are guesses.
    """
    x, v, mu = now.box()
    F, wide = force(osc, x, v, mu, now.phase(osc)).mid(), v.rad() + LITTLE
    known = replace(osc, sign=1 if v.mid() > 0 else -1)
    if v.contains(0) or (v.mid() * F < 0 and v.abs_lower() < 4 * wide):
        known, late = osc, 1.2 * (v.abs_upper() + LITTLE) / abs(F)
    elif v.mid() * F < 0:
        late = _newton(known, now) - 2.5 * wide / abs(F)
    else:
        return known, LONGEST
    part = (late * ball(osc.omega) / arb.pi()).mid() * 2**64
    return known, Fraction(int(fraction(part)), 2**64) if 1 < part < 2**70 else LONGEST


def _keeps_its_sign(osc, now, after, held):
    """Assert that v has the oscillator's sign on a step: everywhere, or at its end while F has one sign everywhere."""
    if osc.sign * held.v > 0:
        return
    F = force(osc, held.x, held.v, now.box()[2], _phases(osc, now, after))
    if F.contains(0) or not osc.sign * after.box()[1] > 0:
        raise NotProved(f"v keeps its sign: v = {held.v.str(5)}, F = {F.str(5)}")


def to_phase(osc, now, turn, orders, most=None):
    """The set at the phase turn * pi; asserted, where `most` is given, that |x| is less than it on the way."""
    while now.turn < turn:
        now, held = advance(osc, now, orders, turn - now.turn)
        if most is not None and not abs(held.x) < most:
            raise NotProved(f"|x| < {most.str(5)} near the saddle orbit: x = {held.x.str(5)}")
    return now


def to_crossing(osc, now, orders):
    """(Crossing of the whole, of the middle): the first one of v = 0 with x beyond the well, x > minus that before it.

    Asserted: on every step v > 0 or x is within the wells; from the first step where that fails F < 0, so that v falls
    and the zero is one. Raises NotProved.
    """
    well, beyond, falling = osc.well, replace(osc, sign=1), False
    while now.turn < LONGEST:
        if now.box()[0] > well and now.box()[1] > 0:
            osc = beyond  # v > 0 from here to the crossing
        after, held = advance(osc, now, orders, LONGEST)
        if not held.x > -well:
            raise NotProved(f"a solution may go over to the left: x = {held.x.str(5)}")
        falling = falling or not (held.v > 0 or held.x < well)
        if falling:
            if not force(osc, held.x, held.v, now.box()[2], _phases(osc, now, after)) < 0:
                raise NotProved(f"F < 0 before the crossing, at x = {held.x.str(5)}, v = {held.v.str(5)}")
            late = _newton(osc, now)
            if 0 < late <= ball(after.turn - now.turn) * arb.pi() / ball(osc.omega):
                landed, _ = step(osc, now, late, orders, (now.turn, late))
                crossings = _land(osc, landed, 0), _land(osc, landed, 1)
                if not crossings[0].x > well:
                    raise NotProved(f"the crossing is beyond the well: x = {crossings[0].x.str(5)}")
                return crossings
        now = after
    raise NotProved("no crossing of v = 0 in forty half periods")


def _phases(osc, now, after):
    return now.phase(osc).union(after.phase(osc))


def _newton(osc, now):
    """The time until the middle solution crosses, nearly: a point, not proved and not in need of it."""
    x, v, mu = (now.m[i, 0] for i in range(3))
    coefficients, _ = taylor(osc, x, v, mu, drive(osc, now.phase(osc).mid(), 20), 20)
    series = arb_poly([c.mid() for c in coefficients]).derivative()
    slope, late = series.derivative(), arb(0)
    for _ in range(8):
        late = (late - series(late) / slope(late)).mid()
    return late


def _land(osc, now, part):
    """v is nearly zero: the crossing lies within beta of now, and there is one."""
    x, v, mu = now.box(part)
    at = force(osc, x, v, mu, now.phase(osc)).abs_lower()
    beta = (v.abs_upper() / at * 1.05).upper() + 1e-60
    for _ in range(6):
        held = enclose(osc, (x, v, mu), now.phase(osc), around(beta))
        fall = force(osc, held.x, held.v, mu, now.phase(osc) + ball(osc.omega) * around(beta))
        if fall < 0 and beta * fall.abs_lower() > v.abs_upper():
            break
        beta = 2 * beta
    else:
        raise NotProved(f"one crossing within beta = {beta.str(5)}: v = {v.str(5)}, F = {fall.str(5)}")
    tau = -v / fall
    pull, damping = stiffness(osc, held.x, held.v)
    phases = now.phase(osc) + ball(osc.omega) * tau.union(ZERO)
    rate = arb_mat([[0, 1, 0], [-pull, -damping, phases.cos()], [0, 0, 0]])
    derivative = now.derivative() + tau * rate * growth(osc, held, beta) * now.derivative()
    t = now.phase(osc) / ball(osc.omega) + tau
    x = x + tau * v.union(arb(0))
    return Crossing(t, x, force(osc, x, arb(0), mu, ball(osc.omega) * t), derivative)
