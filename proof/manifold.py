"""The unstable manifold: a curve near the saddle orbit by cones, and a piece of it flown to its crossing of v = 0."""

from dataclasses import dataclass

from flint import arb, arb_mat

from .crossing import to_crossing, to_phase
from .lohner import solution_set
from .oscillator import NotProved, around
from .saddle import ORDERS, Saddle, columns


@dataclass(frozen=True)
class Curve:
    """The unstable manifold near the saddle orbit at phase 0, for each mu of the saddle's interval.

    The points z*(mu) + E (xi, h(xi)), |xi| <= r, with |h| <= L |xi| and |h'| <= L, E the saddle's frame; one turn of
    the half map takes xi to at most `factor` |xi|. rest : the interval's middle less the exact number that mu is.
    """

    osc: object
    saddle: Saddle
    rest: arb
    r: arb
    L: arb
    factor: arb


def local_curve(osc, base, rest, r):
    """The Curve of an oscillator with the Saddle `base`; r : exact ball; rest : where the middle of mu is. NotProved.

    With M the derivative of the half map over the box |xi|, |eta| <= r, [[a, b], [c, d]] in the frame: the cone
    |eta| <= L |xi| lies in the box, is mapped into itself and stretched: then the graph transform works.
    """
    start = _start(base, arb(0), (around(r), around(r), base.spread), (0, 0, 0), 0)
    end = to_phase(osc, start, 1, ORDERS, osc.well)
    M = base.frame.inv() * -columns(end.derivative(), 0, 2)
    a, b, c, d = (M[i, j].abs_upper() for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)))
    least = M[0, 0].abs_lower()
    L = arb(0)
    for _ in range(4):
        L = (1.01 * (c + d * L) / (least - b * L)).upper()
    for step, holds in (
        ("the cone is mapped into itself", c + d * L < L * (least - b * L)),
        ("vectors of the cone are stretched", least - b * L > 1),
        ("the cone lies in the box", L < 1),
        ("the half map exchanges the branches", M[0, 0] < 0 and base.frame[0, 0] > 0),
        ("graphs of the cone draw together", d + b * L < 1),
    ):
        if not holds:
            raise NotProved(f"{step}: |a| >= {least.str(4)}, b = {b.str(4)}, c = {c.str(4)}, d = {d.str(4)}")
    return Curve(osc, base, rest, r, L, (a + b * L).upper())


def _start(base, xi, whole, middle, turn):
    """The set z* + E (xi + r0[0], r0[1]) for mu + r0[2], r0 in `whole`, with its part in `middle`, at phase turn * pi.

    At phase pi the saddle orbit is at -z*, and what the half map does about it is the same.
    """
    sign, E = (1 - 2 * turn), base.frame
    z, slope = sign * base.z, sign * base.slope
    centre = z.mid() + E * arb_mat([[xi], [0]])
    m, drift = centre.mid(), slope - slope.mid()
    C = arb_mat([[E[0, 0], E[0, 1], slope[0, 0].mid()], [E[1, 0], E[1, 1], slope[1, 0].mid()], [0, 0, 1]])
    error = z - z.mid() + (centre - m) + drift * whole[2]
    derivative_error = arb_mat([[0, 0, drift[0, 0]], [0, 0, drift[1, 0]], [0, 0, 0]])
    point = (m[0, 0], m[1, 0], base.mu)
    return solution_set(point, whole, middle, C, (error[0, 0], error[1, 0], 0), derivative_error, turn)


@dataclass(frozen=True)
class Flight:
    """A piece of the manifold where it crosses v = 0.

    t, x : of the piece's middle at mu; time : of the whole; slope : dx/dt along the piece; rate : dt/dxi;
    by_mu : holds (x - x_m - S (t - t_m)) / (mu' - mu) at any mu' and point of the piece, with a slope S of the piece.
    """

    t: arb
    x: arb
    time: arb
    slope: arb
    by_mu: arb
    rate: arb


def fly(curve, low, high, turn=0, orders=(16, 10)):
    """The Flight of the piece low <= xi <= high (exact balls) from phase turn * pi, for each mu. Raises NotProved."""
    base = curve.saddle
    xi = ((low + high) / 2).mid()
    half, slack = around(max(high - xi, xi - low).upper()), (curve.L * high).upper()
    start = _start(base, xi, (half, around(slack), base.spread), (0, around(slack), curve.rest), turn)
    whole, middle = to_crossing(curve.osc, start, orders)
    V, tilt = whole.derivative, around(curve.L)
    u_x, u_v = (V[i, 0] + tilt * V[i, 1] for i in (0, 1))
    rate = -u_v / whole.F
    if not rate < 0:
        raise NotProved(f"the piece is no graph over the phase: dt/dxi = {rate.str(5)}")
    slope = -u_x * whole.F / u_v
    # by_mu from balls that vary by themselves: first mu at fixed xi, then xi at fixed mu, where the slope is another
    return Flight(middle.t, middle.x, whole.t, slope, V[0, 2] + slope * V[1, 2] / whole.F, rate)
