"""What becomes of an attempted step: accepted or not, the next one's length, and whether the lane needs more.

Everything is each lane's own and chosen by selection instead of branches, so that all lanes are judged at once.
"""

import math

import numpy as np
from numba import njit

from ..compiled import compiled
from ..vectors import widest_vectors
from .block import (
    ALPHA,
    EVALUATIONS,
    EVENT,
    FAR,
    GAIN,
    GAMMA,
    MOVE,
    NEW,
    RATE,
    REJECTED,
    SIGN,
    SLOPES,
    STATE,
    STEPS,
    TARGET,
    WIDTH,
    H,
    M,
    N,
    P,
    S,
    T,
    W,
    X,
)
from .dop853 import error
from .equations import LINEAR, TWO_POWERS, stiffness
from .event_location import crosses
from .radau import SLOW, at_rest
from .tangent_frame import collapses

# What befalls a lane in a step (0: nothing), and how a trajectory ends: a status.
GOING, DONE, DIVERGED, TOO_MANY_STEPS, PAST_UNKNOWN, STUCK, NO_CROSSING, ARRIVES, CREEPS, COLLAPSES = range(10)
_ESCAPED = 1e30  # |x| that only solutions reach which become infinite in finite time,
_OVERFLOWS = 1e150  # and without a cubic force or p > 1, which alone do that: its square is still a number
# An explicit step is at most this part of the linearised motion's fastest time: the tangent's error is then some
# 1e-9 a step even where the state itself (at rest, creeping) would allow any step.
_FRESH = 0.7


@njit(forceinline=True)
def not_beyond(a, l, component, t, h):
    """The step h, cut at the target where sigma is time."""
    left = a[TARGET + l] - t
    return left if (component == T) & (a[M + l] == 1.0) & (abs(left) < abs(h)) else h


@njit(forceinline=True)
def _judge_lane(a, l, component, tangents, control, kind):
    """Accept the step to NEW or not (REJECTED), choose the next one, and say what more there is to do (EVENT)."""
    rtol, atol, most_steps, switch = control
    h, x, t = a[H + l], a[NEW + X + l], a[NEW + T + l]
    e = error(a, l, rtol, atol, kind)
    fits = e <= 1.0
    arrives = (fits & crosses(a, l, component)) | (a[FAR + l] != 0.0)
    relaxation = a[ALPHA + l] * a[RATE + S + l]  # per sigma
    fastest = np.sqrt(abs(stiffness(a, l, x))) * a[RATE + T + l] + relaxation
    factor = 0.9 / np.sqrt(np.sqrt(np.sqrt(e)))
    most = 1.0 if a[REJECTED + l] != 0.0 else 6.0
    grown, fresh = abs(h) * (factor if factor < most else most), _FRESH / fastest
    length = grown if grown < fresh else fresh
    length = a[SIGN + l] * (length if fits else abs(h) * (factor if factor > 0.2 else 0.2))  # 0.2 if e is no number
    cut = not_beyond(a, l, component, t if fits else a[T + l], length)
    a[MOVE + l], a[H + l] = a[MOVE + l] if arrives else length, h if arrives else cut
    a[REJECTED + l] = 0.0 if fits else 1.0
    a[STEPS + l] += 1.0
    a[EVALUATIONS + l] += 12.0

    event = COLLAPSES if (tangents == 2) & collapses(a, l) else GOING
    if kind != LINEAR:  # what befalls only where the damping is stiff
        event = _stiff_event(a, l, h, relaxation, rtol, switch, fits, event)
    event = NO_CROSSING if (component == W) & (abs(t) > abs(a[TARGET + l])) else event
    tame = (a[GAMMA + l] == 0.0) & (a[P + l] <= 1.0)
    event = event if abs(x) < (_OVERFLOWS if tame else _ESCAPED) else DIVERGED
    event = event if fits else GOING
    goes_on = (event == GOING) | (event == COLLAPSES)  # where a solution blows up the frame may collapse at every step
    event = TOO_MANY_STEPS if goes_on & (a[STEPS + l] >= most_steps) else event
    a[EVENT + l] = ARRIVES if arrives else event


@njit(forceinline=True)
def _stiff_event(a, l, h, relaxation, rtol, switch, fits, event):
    """CREEPS or PAST_UNKNOWN where p < 1 and the motion rests or relaxes fast, else the event as it is."""
    x, w, m, n = a[NEW + X + l], a[NEW + W + l], a[M + l], a[N + l]
    resting = at_rest(a, l, x, m * a[RATE + W + l], m * a[RATE + S + l] * w / n)  # phi = 0 there
    slow = abs(a[RATE + W + l]) < SLOW * relaxation * abs(w) / n
    forward, sticky = a[SIGN + l] > 0.0, a[P + l] < 1.0
    # Backward, the slow branch repels. What stays on it that long has amplified its error beyond use.
    gain = a[GAIN + l] + relaxation * abs(h) if slow else 0.0
    a[GAIN + l] = gain if fits else a[GAIN + l]
    event = CREEPS if sticky & forward & ((slow & (relaxation * abs(h) > switch)) | resting) else event
    lost = (gain > max(3.0, math.log(1e-4 / rtol))) | resting
    return PAST_UNKNOWN if sticky & (a[SIGN + l] < 0.0) & lost else event


@compiled
def judge(a, eights, component, tangents, control, kind):
    """Of each lane: is its step to NEW accepted, which is the next, what more is to do; accepted ends are taken."""
    widest_vectors()
    if kind == LINEAR:
        for l in range(8 * eights):
            _judge_lane(a, l, component, tangents, control, LINEAR)
    else:
        for l in range(8 * eights):
            _judge_lane(a, l, component, tangents, control, TWO_POWERS)
    for row in range(0, STATE - (2 - tangents) * 2 * WIDTH, WIDTH):
        for l in range(8 * eights):
            taken = (a[REJECTED + l] == 0.0) & (a[EVENT + l] != ARRIVES)
            # Read first, choose then: a choice between two reads is a branch, which vector units do not have.
            state, new, slope, rate = a[row + l], a[NEW + row + l], a[SLOPES + row + l], a[RATE + row + l]
            a[row + l], a[SLOPES + row + l] = new if taken else state, rate if taken else slope
