"""What becomes of an attempted step: accepted or not, the next one's length, and whether the lane needs more.

Everything is each lane's own and chosen by selection instead of branches, so that all lanes are judged at once.
"""

import math

from vectorized.compiled import inlined, inner
from vectorized.memory import widest_vectors
from vectorized.vectors import root, where
from .block import (
    ALPHA, EVALUATIONS, FAR, GAIN, GAMMA, LAST, MOVE, NEW, NOW, OSC, OUTCOME, OWNER, PACE, REJECTED, SIGN, SLOPES, STEP,
    STEPS, TARGET, H, M, N, P, S, T, W, X, eights,
)  # rows: some lines of names instead of a page  # fmt: skip
from .dop853 import error
from .equations import SMOOTH, TWO_POWERS, stiffness
from .event_location import reaches
from .radau import SLOW, at_rest
from .tangent_frame import collapses

# What befalls a lane in a step (0: nothing), and how a trajectory ends: a status.
GOING, DONE, DIVERGED, TOO_MANY_STEPS, PAST_UNKNOWN, STUCK, NO_CROSSING, ARRIVES, CREEPS, COLLAPSES = range(10)
_ESCAPED = 1e30  # |x| that only solutions reach which become infinite in finite time,
_OVERFLOWS = 1e150  # and without a cubic force or p > 1, which alone do that: its square is still a number
# An explicit step is at most this part of the linearised motion's fastest time: the tangent's error is then some
# 1e-9 a step even where the state itself (at rest, creeping) would allow any step.
_FRESH = 0.7


@inlined
def not_beyond(osc, owner, l, event, t, h):
    """The step h, cut at the target where sigma is time."""
    left = owner[TARGET, l] - t
    return where((event == T) & (osc[M, l] == 1.0) & (abs(left) < abs(h)), left, h)


@inlined
def _accept_lanes(now, new, slopes, osc, step, owner, c, event, tangents, control, kind):
    """Accept the steps to NEW or not (REJECTED), choose the next ones, and say what more there is to do (OUTCOME)."""
    rtol, atol, most_steps, switch = control
    h, x, t, rate = step[H, c], new[X, c], new[T, c], slopes[LAST]
    e = error(now, new, slopes, osc, step, c, rtol, atol, kind)
    fits = e <= 1.0
    arrives = (fits & reaches(now, new, owner, c, event)) | (step[FAR, c] != 0.0)
    relaxation = osc[ALPHA, c] * rate[S, c]  # per sigma
    fastest = root(abs(stiffness(osc, c, x))) * rate[T, c] + relaxation
    factor = 0.9 / root(root(root(e)))
    growth = where(step[REJECTED, c] != 0.0, 1.0, 6.0)
    grown, fresh = abs(h) * where(factor < growth, factor, growth), _FRESH / fastest
    length = where(grown < fresh, grown, fresh)
    length = owner[SIGN, c] * where(fits, length, abs(h) * where(factor > 0.2, factor, 0.2))  # 0.2 if e is no number
    reached = where(fits, t, now[T, c])  # of a step that is not accepted, t may be no number
    cut = not_beyond(osc, owner, c, event, reached, length)
    step[MOVE, c], step[H, c] = where(arrives, step[MOVE, c], length), where(arrives, h, cut)
    step[REJECTED, c] = where(fits, 0.0, 1.0)
    step[STEPS, c] = step[STEPS, c] + 1.0
    owner[EVALUATIONS, c] = owner[EVALUATIONS, c] + 12.0

    outcome = where((tangents == 2) & collapses(new, c), COLLAPSES, GOING)
    if kind != SMOOTH:  # what befalls only where the damping is stiff
        outcome = _stiff_outcome(new, rate, osc, step, owner, c, h, relaxation, rtol, switch, fits, outcome)
    outcome = where((event == W) & (abs(t) > abs(owner[TARGET, c])), NO_CROSSING, outcome)
    tame = (osc[GAMMA, c] == 0.0) & (osc[P, c] <= 1.0)
    outcome = where(abs(x) < where(tame, _OVERFLOWS, _ESCAPED), outcome, DIVERGED)
    outcome = where(fits, outcome, GOING)
    # Where a solution blows up the frame may collapse at every step.
    goes_on = (outcome == GOING) | (outcome == COLLAPSES)
    most = most_steps + owner[PACE, c] * abs(reached)
    outcome = where(goes_on & (step[STEPS, c] >= most), TOO_MANY_STEPS, outcome)
    step[OUTCOME, c] = where(arrives, ARRIVES, outcome)


@inlined
def _stiff_outcome(new, rate, osc, step, owner, c, h, relaxation, rtol, switch, fits, outcome):
    """CREEPS or PAST_UNKNOWN where p < 1 and the motion rests or relaxes fast, else the outcome as it is."""
    x, w, m, n = new[X, c], new[W, c], osc[M, c], osc[N, c]
    resting = at_rest(osc, c, x, m * rate[W, c], m * rate[S, c] * w / n)  # phi = 0 there
    slow = abs(rate[W, c]) < SLOW * relaxation * abs(w) / n
    forward, backward, sticky = owner[SIGN, c] > 0.0, owner[SIGN, c] < 0.0, osc[P, c] < 1.0
    # Backward, the slow branch repels. What stays on it that long has amplified its error beyond use.
    gain = where(slow, step[GAIN, c] + relaxation * abs(h), 0.0)
    step[GAIN, c] = where(fits, gain, step[GAIN, c])
    outcome = where(sticky & forward & ((slow & (relaxation * abs(h) > switch)) | resting), CREEPS, outcome)
    lost = (gain > max(3.0, math.log(1e-4 / rtol))) | resting
    return where(sticky & backward & lost, PAST_UNKNOWN, outcome)


@inner
def accept_steps(block, number, event, tangents, control, kind):
    """Of each lane: is its step to NEW accepted, which is the next, what more is to do; accepted ends become NOW."""
    widest_vectors()
    now, new, slopes, osc = eights(block, NOW), eights(block, NEW), eights(block, SLOPES), eights(block, OSC)
    step, owner, first, last = eights(block, STEP), eights(block, OWNER), slopes[0], slopes[LAST]
    if kind == SMOOTH:
        for c in range(number):
            _accept_lanes(now, new, slopes, osc, step, owner, c, event, tangents, control, SMOOTH)
    else:
        for c in range(number):
            _accept_lanes(now, new, slopes, osc, step, owner, c, event, tangents, control, TWO_POWERS)
    for c in range(number):
        taken = (step[REJECTED, c] == 0.0) & (step[OUTCOME, c] != ARRIVES)
        for row in range(4 + 2 * tangents):
            now[row, c] = where(taken, new[row, c], now[row, c])
            first[row, c] = where(taken, last[row, c], first[row, c])
