"""Follow trajectories side by side: explicit steps in friction time, each lane its own; creeps in turn.

A block of lanes goes on by one attempted step of all its lanes at a time. Length, error and acceptance are each lane's
own, by selection instead of branches. What needs more (an arrival, a creep, vectors that collapse) is done for one
lane between two steps; a lane whose trajectory has ended takes up the next. Whether it steps or creeps decides what a
result costs, not what it is: both keep the same tolerance.
"""

import math

from ..compiled import compiled
from ..vectors import stack
from .block import (
    ALPHA,
    BLOCK,
    CREEP,
    ETA1,
    ETA2,
    EVALUATIONS,
    EVENT,
    FAR,
    GAIN,
    INTERVAL,
    LOG1,
    LOG2,
    MEMBER,
    MOVE,
    NEW,
    OMEGA,
    PARAMETERS,
    PASSAGES,
    REJECTED,
    SHEAR,
    SIGN,
    SLOPES,
    START,
    STATE,
    STEPS,
    TARGET,
    WIDTH,
    XI1,
    XI2,
    H,
    M,
    N,
    P,
    S,
    T,
    W,
    X,
)
from .dop853 import advance
from .equations import LINEAR, ONE_POWER, TWO_POWERS, force, powers, rate, variable, velocity
from .event_location import land
from .radau import at_rest, creep
from .step_control import ARRIVES, COLLAPSES, CREEPS, DONE, GOING, NO_CROSSING, STUCK, TOO_MANY_STEPS, judge, not_beyond
from .tangent_frame import log_area, orthonormalise

# What is told of each interval: position, velocity, time, friction time, the frame, its first vector's angle, passages.
RESULTS = AT_X, AT_V, AT_T, AT_S, R11, R22, R12, ANGLE, ANNIHILATIONS = range(9)

_LEAVE = 1 / 3  # a creep ends at this part of the relaxation times a step with which it begins
_CREEP_STEP = 1 / 16  # of a forcing period at most, so that no passage of the force through zero is overlooked


@compiled
def follow(parameters, states, times, component, beyond, tangents, control, results, status, evaluations):
    """Carry each member from states (N, 2) through the times (N, n), status (N,).

    component : T, or W for the first crossing of v = 0 with x > beyond before the time times[:, 1]
    tangents : 0, 1 or 2 of them
    control : rtol, atol, bound on the steps of an interval, relaxation times a step above which a creep begins
    results : (N, n - 1, 9), in the order of RESULTS; evaluations : (N,) of the force
    """
    a, kind, waiting, flying = stack(BLOCK), LINEAR, 0, min(status.size, WIDTH)
    for l in range(flying):
        a[MEMBER + l] = -1.0
    while True:
        l = 0
        while l < flying:
            if a[MEMBER + l] >= 0.0 and a[EVENT + l] != GOING:
                _serve(a, l, times, component, beyond, tangents, control, results, status, evaluations)
            if a[MEMBER + l] >= 0.0:
                l += 1
            elif waiting < status.size:
                kind = max(kind, _board(a, l, waiting, parameters, states))
                _depart(a, l, 0, times, component, tangents)
                waiting += 1
                l += 1
            else:  # nobody waits: the last lane moves here, so that the block gets smaller
                flying -= 1
                for row in range(0, BLOCK, WIDTH):
                    a[row + l] = a[row + flying]
        if flying == 0:
            break
        eights = (flying + 7) // 8
        advance(a, eights, tangents, kind)
        judge(a, eights, component, tangents, control, kind)


@compiled
def _board(a, l, member, parameters, states):
    """Member's parameters, start, identity as tangents and a careful first step; returns the lane's kind."""
    for k in range(PARAMETERS):
        a[ALPHA + k * WIDTH + l] = parameters[member, k]
    x, v = states[member]
    if a[P + l] > 1.0 and at_rest(a, l, x, force(a, l, x, 0.0), v):
        a[M + l], a[N + l] = 1.0, a[P + l]  # at rest without force w would stay what it is for ever: take v itself
    a[X + l], a[W + l] = x, variable(a, l, v)
    a[XI1 + l], a[ETA1 + l], a[XI2 + l], a[ETA2 + l] = 1.0, 0.0, 0.0, 1.0
    a[MEMBER + l], a[EVALUATIONS + l], a[MOVE + l], a[CREEP + l] = member, 0.0, 0.05 / a[OMEGA + l], 0.0
    return TWO_POWERS if a[N + l] != 1.0 else ONE_POWER if a[M + l] != 1.0 else LINEAR


@compiled
def _depart(a, l, interval, times, component, tangents):
    """Make the lane ready for its next interval."""
    before, after = times[int(a[MEMBER + l]), interval : interval + 2]
    a[INTERVAL + l], a[START + l], a[TARGET + l] = interval, before, after - before
    a[SIGN + l] = 1.0 if after > before else -1.0
    for row in (S, T, LOG1, LOG2, SHEAR, STEPS, PASSAGES, FAR, REJECTED, GAIN):
        a[row + l] = 0.0
    a[MOVE + l] = a[SIGN + l] * abs(a[MOVE + l])
    a[H + l] = not_beyond(a, l, component, 0.0, a[MOVE + l])
    rate(a, l, tangents)
    a[EVALUATIONS + l] += 1.0


@compiled
def _serve(a, l, times, component, beyond, tangents, control, results, status, evaluations):
    """Do what the lane's event asks for, until it is ready for a step again or its trajectory has ended."""
    event = int(a[EVENT + l])
    if event == ARRIVES:
        if not land(a, l, component, tangents):
            return
        # A turning point that was not asked for is a state like any other.
        event = DONE if component == T or a[X + l] > beyond else GOING
    elif event == COLLAPSES:
        orthonormalise(a, l, tangents, log_area(a, l, tangents))
        rate(a, l, tangents)
        event = GOING
    elif event == CREEPS:
        a[CREEP + l] = max(a[MOVE + l] * a[SLOPES + T + l], 1e-6 / a[OMEGA + l])  # the first can underflow
        event = _creep_on(a, l, component, beyond, tangents, control)
    while event != GOING:
        member, interval = int(a[MEMBER + l]), int(a[INTERVAL + l])
        if event == DONE:
            orthonormalise(a, l, tangents, log_area(a, l, tangents))
            _tell(a, l, results[member, interval])
        if event != DONE or interval + 2 == times.shape[1]:
            status[member], evaluations[member], a[MEMBER + l] = event, int(a[EVALUATIONS + l]), -1.0
            return
        _depart(a, l, interval + 1, times, component, tangents)
        event = _creep_on(a, l, component, beyond, tangents, control) if a[CREEP + l] > 0.0 else GOING


@compiled
def _tell(a, l, result):
    """Write the results of an interval."""
    result[AT_X], result[AT_V], result[AT_T], result[AT_S] = a[X + l], velocity(a, l, a[W + l]), a[T + l], a[S + l]
    result[R11], result[R22], result[R12] = a[LOG1 + l], a[LOG2 + l], a[SHEAR + l]
    result[ANGLE], result[ANNIHILATIONS] = math.atan2(a[ETA1 + l], a[XI1 + l]), a[PASSAGES + l]


@compiled
def _creep_on(a, l, component, beyond, tangents, control):
    """Implicit steps until the target or a failure, or (GOING) until a step is short enough for the explicit method."""
    rtol, atol, most_steps, switch = control
    Y = powers(a, l, a[W + l], TWO_POWERS)[1] * a[W + l]
    orthonormalise(a, l, tangents, log_area(a, l, tangents))
    while a[STEPS + l] < most_steps:
        a[STEPS + l] += 1.0
        left = a[TARGET + l] - a[T + l]
        h = min(a[CREEP + l], left, _CREEP_STEP * 2 * math.pi / a[OMEGA + l])
        resting = at_rest(a, l, a[X + l], force(a, l, a[X + l], a[T + l]), Y)
        end, e, passages, evaluations = creep(a, l, Y, h, tangents, rtol, atol)
        a[EVALUATIONS + l] += evaluations
        if a[P + l] > 0.5 and resting:
            passages = 0
        if passages < 0 or (passages > 0 and a[P + l] > 0.5):
            e = math.inf  # a turn, or a passage in finite friction time: for explicit steps to resolve
        if e <= 1.0:
            if passages > 0 and component == W and a[NEW + X + l] > beyond:
                return STUCK
            a[PASSAGES + l] += passages
            Y, a[NEW + W + l] = end, math.copysign(abs(end) ** (1 / a[N + l]), end)
            relaxed = a[ALPHA + l] * (a[NEW + S + l] - a[S + l])
            for row in range(0, STATE, WIDTH):
                a[row + l] = a[NEW + row + l]
            orthonormalise(a, l, tangents, -relaxed)
            factor = min(4.0, 0.9 * e ** (-1 / 6)) if e > 0 else 4.0
            a[CREEP + l] = h * factor if factor < 1 else max(a[CREEP + l], h * factor)  # h may have been cut
        else:
            a[CREEP + l] = h * (max(0.2, 0.9 * e ** (-1 / 6)) if e < 1e300 else 0.2)
        if h == left and e <= 1.0:
            if component == W:
                return NO_CROSSING
            a[T + l] = a[TARGET + l]
            return DONE
        speed, power = powers(a, l, a[W + l], TWO_POWERS)
        phi = a[M + l] * speed
        if a[CREEP + l] * a[ALPHA + l] * a[N + l] * power < _LEAVE * switch * phi and not resting:
            a[MOVE + l], a[CREEP + l] = a[CREEP + l] / phi * (a[M + l] + phi), 0.0
            a[H + l] = a[MOVE + l]
            rate(a, l, tangents)
            return GOING
    return TOO_MANY_STEPS
