"""Lohner's method with derivatives: a whole set of solutions is carried over a time step, wrapped in no box.

A set holds states (x, v, mu), the forcing amplitude as a third variable with mu' = 0:

    { m + C r0 + Q r },    derivative by r0 in C + Q S,

m a point, C exact, r0 the set's parameters in balls (they never change), Q a rotation, r and S what errors have
gathered. A step replaces the flow by its Taylor polynomial at m and the derivative A over the set (mean value):

    Q' r' = (y - m') + A Q r + (A C - C') r0,    Q' S' = A Q S + (A C - C'),    m' = mid y, C' = mid A C,

with Q' turned along the longer column of A Q, so that the errors are stretched but not wrapped [Lohner]. r0 and r have
two columns: the whole set, and a small part of it about its middle that is carried along with less error.
"""

from dataclasses import dataclass
from fractions import Fraction

from flint import arb, arb_mat, arb_poly

from .oscillator import ZERO, NotProved, around, ball, drive, force, stiffness, taylor

IDENTITY = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
BOTH = arb_mat([[1, 1]])


@dataclass(frozen=True)
class Enclosure:
    """Contains every solution of a set over a span of time."""

    x: arb
    v: arb


@dataclass(frozen=True)
class SolutionSet:
    """States {m + C r0 + Q r} at the phase turn * pi + omega * late, with their derivatives by r0 in C + Q S."""

    m: arb_mat
    C: arb_mat
    r0: arb_mat
    Q: arb_mat
    r: arb_mat
    S: arb_mat
    turn: Fraction
    late: arb = ZERO

    def box(self, part=0):
        """(x, v, mu) in balls, of the whole (part 0) or of the middle (1)."""
        boxes = self.C * self.r0 + self.Q * self.r
        return [self.m[i, 0] + boxes[i, part] for i in range(3)]

    def derivative(self):
        """d(x, v, mu) / d r0, a matrix of balls."""
        return self.C + self.Q * self.S

    def phase(self, osc):
        """omega t in a ball."""
        return ball(self.turn) * arb.pi() + ball(osc.omega) * self.late


def solution_set(point, whole, middle, C, error, derivative_error, turn=0):
    """{point + C r0 + error}, r0 in `whole`, its part with r0 in `middle`; derivative by r0 in C + derivative_error."""
    r0 = arb_mat([list(pair) for pair in zip(whole, middle, strict=True)])
    r = arb_mat([[value, value] for value in error])
    m, Q = arb_mat([[value] for value in point]), arb_mat(IDENTITY)
    return SolutionSet(m, C, r0, Q, r, derivative_error, Fraction(turn))


def enclose(osc, box, phase, span):
    """Picard: if the box B holds X + span f(B), every solution from X stays in X + span f(B) over the span."""
    x, v, mu = box
    phases = phase + ball(osc.omega) * span
    near_x, near_v = x, v
    for _ in range(20):
        next_x, next_v = x + span * near_v, v + span * force(osc, near_x, near_v, mu, phases)
        if near_x.contains(next_x) and near_v.contains(next_v):
            return Enclosure(next_x, next_v)
        near_x, near_v = (
            arb(new.mid(), 1.1 * new.rad() + 1e-20) for new in (near_x.union(next_x), near_v.union(next_v))
        )
    raise NotProved(f"first-order enclosure at x = {x.str(5)}, v = {v.str(5)} over the time {span.str(5)}")


def growth(osc, held, length):
    """A matrix holding the derivative of the flow over a length of time within an enclosure (Gronwall)."""
    pull, damping = stiffness(osc, held.x, held.v)
    norm = (abs(pull) + abs(damping) + 1).max(arb(1)).upper()
    wide = around(((norm * length).exp() - 1).upper())
    return arb_mat([[1 + wide, wide, wide], [wide, 1 + wide, wide], [0, 0, 1]])


def dropped(osc, held, length):
    """How far state and derivative at most go wrong where a step leaves out the friction alpha v |v| (Gronwall).

    As a step does on which v may change its sign: there the friction is no polynomial, and small.
    """
    (pull, damping), most = stiffness(osc, held.x, held.v), held.v.abs_upper()
    grown = length * ((abs(pull) + damping.abs_upper() + 1).upper() * length).exp()
    return tuple(
        around((bound * grown).upper()) for bound in (damping.abs_upper() * most, damping.abs_upper() + 2 * pull.rad())
    )


def step(osc, start, h, orders, late=None):
    """The set after the time h, and the enclosure on the way. late: the time of an h that is no part of pi.

    h : the time step as ball; orders : (of the point's Taylor polynomial, of its derivatives').
    """
    order, tangents = orders
    box, phase = start.box(), start.phase(osc)
    length = h.upper()
    span = arb(length / 2, (length / 2).upper())
    held = enclose(osc, box, phase, span)
    left = dropped(osc, held, length) if osc.p == 2 and not osc.sign else (ZERO, ZERO)
    x, v, mu = (start.m[i, 0] for i in range(3))
    now, meanwhile = drive(osc, phase, order), drive(osc, phase + ball(osc.omega) * span, order + 1)
    remainder, slopes = taylor(osc, held.x, held.v, box[2], meanwhile, order + 1, tangents + 1)
    point, _ = taylor(osc, x, v, mu, now, order)
    y = _sum(point, remainder[order + 1], h)
    _, columns = taylor(osc, *box, now, tangents, tangents)
    tail = arb_mat([[b[tangents + 1] for b in slopes], [0, 0, 0], [0, 0, 0]]) * growth(osc, held, length)
    rows = [_sum(b, tail[0, j], h) for j, b in enumerate(columns)]
    A = arb_mat([[row[i] + left[1] for row in rows] for i in (0, 1)] + [[0, 0, 1]])
    return _transport(start, A, arb_mat([[y[0] + left[0]], [y[1] + left[0]], [mu]]), late), held


def _sum(coefficients, last, h):
    """(x, v) from Taylor coefficients of x and the coefficient of the remainder."""
    series = arb_poly([*coefficients, last])
    return series(h), series.derivative()(h)


def _transport(start, A, y, moved):
    turn, late = moved
    AC, AQ = A * start.C, A * start.Q
    C, m = AC.mid(), y.mid()
    sizes = [(abs(AQ[0, j].mid()) + abs(AQ[1, j].mid())) * (start.r[j, 0].rad() + 1e-40) for j in (0, 1)]
    j = 0 if sizes[0] > sizes[1] else 1
    a, b = AQ[0, j].mid(), AQ[1, j].mid()
    size = (a * a + b * b).sqrt().mid()
    c, s = (a / size).mid(), (b / size).mid()
    Q = arb_mat([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    square = c * c + s * s
    inverse = arb_mat([[c / square, s / square, 0], [-s / square, c / square, 0], [0, 0, 1]])
    K, D, new = inverse * AQ, inverse * (AC - C), inverse * (y - m) * BOTH
    return SolutionSet(m, C, start.r0, Q, new + K * start.r + D * start.r0, K * start.S + D, turn, late)
