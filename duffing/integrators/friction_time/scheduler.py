"""Follow trajectories side by side: explicit steps in friction time, each lane its own; creeps in turn.

A block of lanes goes on by one attempted step of all its lanes at a time. Length, error and acceptance are each lane's
own, by selection instead of branches. What needs more (an arrival, a creep, vectors that collapse) is done for one
lane between two steps; a lane whose trajectory has ended takes up the next. Whether it steps or creeps decides what a
result costs, not what it is: both keep the same tolerance.
"""

import math

from numba import int64

from vectorized.compiled import announced, compiled, inner
from vectorized.memory import apart, stack
from .block import (
    ALPHA, BLOCK, CREEP, ETA1, ETA2, EVALUATIONS, FAR, FRAME, GAIN, INTERVAL, LOG1, LOG2, MEMBER, MOVE, NEW, NOW,
    OMEGA, OSC, OUTCOME, OWNER, PACE, PARAMETERS, PASSAGES, REJECTED, SHEAR, SIGN, SLOPES, START, STEP, STEPS, TARGET,
    WIDTH, XI1, XI2, H, M, N, P, S, T, W, X, lanes,
)  # rows: some lines of names instead of a page  # fmt: skip
from .dop853 import step
from .equations import ONE_POWER, SMOOTH, TWO_POWERS, first_slopes, force, powers, variable, velocity
from .event_location import locate_event
from .radau import at_rest, radau_step
from .step_control import (
    ARRIVES,
    COLLAPSES,
    CREEPS,
    DONE,
    GOING,
    NO_CROSSING,
    STUCK,
    TOO_MANY_STEPS,
    accept_steps,
    not_beyond,
)
from .tangent_frame import log_area, orthonormalise

# What is told of each interval: position, velocity, time, friction time, the frame, its first vector's angle, passages.
RESULTS = AT_X, AT_V, AT_T, AT_S, R11, R22, R12, ANGLE, ANNIHILATIONS = range(9)

_LEAVE = 1 / 3  # a creep ends at this part of the relaxation times a step with which it begins
_CREEP_STEP = 1 / 16  # of a forcing period at most, so that no passage of the force through zero is overlooked


@compiled
def run_lanes(parameters, states, times, pace, event, beyond, tangents, control, results, status, evaluations):
    """Carry each member from states (N, 2) through the times (N, n), status (N,).

    pace : (N,), by how much the bound on an interval's steps grows for each unit of time gone in it
    event : T, or W for the first crossing of v = 0 with x > beyond before the time times[:, 1]
    tangents : 0, 1 or 2 of them
    control : rtol, atol, bound on the steps where an interval begins, relaxation times a step above which a creep does
    results : (N, n - 1, 9), in the order of RESULTS; evaluations : (N,) of the force
    """
    block = stack(BLOCK)
    owner, outcome = lanes(block, OWNER), lanes(block, STEP)[OUTCOME]
    kind, waiting, used = SMOOTH, int64(0), min(status.size, WIDTH)
    for l in range(used):
        owner[MEMBER, l] = -1.0
    while True:
        l = int64(0)  # a variable: functions that are called with a constant are compiled for it
        while l < used:
            moved = False
            if owner[MEMBER, l] >= 0.0 and outcome[l] != GOING:
                moved = handle_event(block, l, times, event, beyond, tangents, control, results, status, evaluations)
            if owner[MEMBER, l] < 0.0 and waiting < status.size:
                kind = max(kind, load_member(block, l, waiting, parameters, states, pace))
                start_interval(block, l, int64(0), times, event)
                waiting, moved = waiting + 1, True
            if owner[MEMBER, l] >= 0.0:
                if moved:
                    first_slopes(block, l)
                l += 1
            else:  # nobody waits: the last lane moves here, so that the block gets smaller
                used -= 1
                for first in range(0, BLOCK, WIDTH):
                    block[first + l] = block[first + used]
        if used == 0:
            break
        number = (used + 7) // 8
        step(block, number, tangents, kind)
        accept_steps(block, number, event, tangents, control, kind)


announced(run_lanes, "the accurate integrator")


@inner
def load_member(block, l, member, parameters, states, pace):
    """Member's parameters, start, identity as tangents and a careful first step; returns the lane's kind."""
    apart()
    osc, now, step, owner = lanes(block, OSC), lanes(block, NOW), lanes(block, STEP), lanes(block, OWNER)
    for k in range(PARAMETERS):
        osc[k, l] = parameters[member, k]
    x, v = states[member, 0], states[member, 1]
    if osc[P, l] > 1.0 and at_rest(osc, l, x, force(osc, l, x, 0.0), v):
        osc[M, l], osc[N, l] = 1.0, osc[P, l]  # at rest without force w would stay what it is for ever: take v itself
    now[X, l], now[W, l] = x, variable(osc, l, v)
    now[XI1, l], now[ETA1, l], now[XI2, l], now[ETA2, l] = 1.0, 0.0, 0.0, 1.0
    step[MOVE, l], step[CREEP, l] = 0.05 / osc[OMEGA, l], 0.0
    owner[MEMBER, l], owner[EVALUATIONS, l], owner[PACE, l] = member, 0.0, pace[member]
    return TWO_POWERS if osc[N, l] != 1.0 else ONE_POWER if osc[M, l] != 1.0 else SMOOTH


@inner
def start_interval(block, l, interval, times, event):
    """The next time to reach; what is counted since the last begins anew."""
    apart()
    osc, now, step = lanes(block, OSC), lanes(block, NOW), lanes(block, STEP)
    frame, owner = lanes(block, FRAME), lanes(block, OWNER)
    member = int(owner[MEMBER, l])
    before, after = times[member, interval], times[member, interval + 1]
    owner[INTERVAL, l], osc[START, l], owner[TARGET, l] = interval, before, after - before
    owner[SIGN, l] = 1.0 if after > before else -1.0
    now[S, l] = now[T, l] = frame[LOG1, l] = frame[LOG2, l] = frame[SHEAR, l] = frame[PASSAGES, l] = 0.0
    step[FAR, l] = step[REJECTED, l] = step[GAIN, l] = step[STEPS, l] = step[OUTCOME, l] = 0.0
    step[MOVE, l] = owner[SIGN, l] * abs(step[MOVE, l])
    step[H, l] = not_beyond(osc, owner, l, event, 0.0, step[MOVE, l])
    owner[EVALUATIONS, l] += 1.0


@inner
def handle_event(block, l, times, event, beyond, tangents, control, results, status, evaluations):
    """Do what the lane's last step asks for, until it is ready for a step again or its trajectory has ended.

    Returns whether the lane has left the point at which its slopes are known.
    """
    apart()
    osc, now, step, owner = lanes(block, OSC), lanes(block, NOW), lanes(block, STEP), lanes(block, OWNER)
    outcome = int(step[OUTCOME, l])
    if outcome == ARRIVES:
        if not locate_event(block, l, event):
            return False
        # A turning point that was not asked for is a state like any other.
        outcome = DONE if event == T or now[X, l] > beyond else GOING
    elif outcome == COLLAPSES:
        orthonormalise(block, l, tangents, log_area(block, l, tangents))
        outcome = GOING
    elif outcome == CREEPS:
        step[CREEP, l] = max(
            step[MOVE, l] * lanes(block, SLOPES)[0, T, l], 1e-6 / osc[OMEGA, l]
        )  # the first can underflow
        outcome = creep(block, l, event, beyond, tangents, control)
    while outcome != GOING:
        member, interval = int(owner[MEMBER, l]), int(owner[INTERVAL, l])
        if outcome == DONE:
            orthonormalise(block, l, tangents, log_area(block, l, tangents))
            store(block, l, results[member, interval])
        if outcome != DONE or interval + 2 == times.shape[1]:
            status[member], evaluations[member], owner[MEMBER, l] = outcome, int(owner[EVALUATIONS, l]), -1.0
            return True
        start_interval(block, l, interval + 1, times, event)
        outcome = creep(block, l, event, beyond, tangents, control) if step[CREEP, l] > 0.0 else GOING
    return True


@inner
def store(block, l, result):
    """Write the results of an interval."""
    apart()
    now, frame = lanes(block, NOW), lanes(block, FRAME)
    result[AT_X], result[AT_V] = now[X, l], velocity(lanes(block, OSC), l, now[W, l])
    result[AT_T], result[AT_S] = now[T, l], now[S, l]
    result[R11], result[R22], result[R12] = frame[LOG1, l], frame[LOG2, l], frame[SHEAR, l]
    result[ANGLE], result[ANNIHILATIONS] = math.atan2(now[ETA1, l], now[XI1, l]), frame[PASSAGES, l]


@inner
def locate_rest(block, l, Y, h, rtol, atol):
    """Land where the damping force Y first passes through zero in a creep step of h, as `locate_event` does.

    By bisection: around Y = 0 the velocity is zero in doubles, and has no slope that would lead there.
    """
    apart()
    now, new, owner = lanes(block, NOW), lanes(block, NEW), lanes(block, OWNER)
    short, long = 0.0, h
    while long - short > 1e-12 * h:
        middle = 0.5 * (short + long)
        _, _, passages, evaluations = radau_step(block, l, Y, middle, 0, rtol, atol)
        owner[EVALUATIONS, l] += evaluations
        short, long = (short, middle) if passages > 0 else (middle, long)
    for row in (X, T, S):
        now[row, l] = new[row, l]
    now[W, l] = 0.0
    return DONE


@inner
def creep(block, l, event, beyond, tangents, control):
    """Implicit steps until the target or a failure, or (GOING) until a step is short enough for the explicit method."""
    apart()
    osc, now, new, step = lanes(block, OSC), lanes(block, NOW), lanes(block, NEW), lanes(block, STEP)
    frame, owner = lanes(block, FRAME), lanes(block, OWNER)
    rtol, atol, most_steps, switch = control
    alpha, p, m, n = osc[ALPHA, l], osc[P, l], osc[M, l], osc[N, l]
    Y = powers(osc, l, now[W, l], TWO_POWERS)[1] * now[W, l]
    orthonormalise(block, l, tangents, log_area(block, l, tangents))
    while step[STEPS, l] < most_steps + owner[PACE, l] * now[T, l]:
        step[STEPS, l] += 1.0
        left = owner[TARGET, l] - now[T, l]
        h = min(step[CREEP, l], left, _CREEP_STEP * 2 * math.pi / osc[OMEGA, l])
        resting = at_rest(osc, l, now[X, l], force(osc, l, now[X, l], now[T, l]), Y)
        end, e, passages, evaluations = radau_step(block, l, Y, h, tangents, rtol, atol)
        owner[EVALUATIONS, l] += evaluations
        if p > 0.5 and resting:
            passages = 0
        if passages < 0 or (passages > 0 and p > 0.5):
            e = math.inf  # a turn, or a passage in finite friction time: for explicit steps to resolve
        if e <= 1.0:
            if passages > 0 and event == W and new[X, l] > beyond:
                return STUCK if tangents > 0 else locate_rest(block, l, Y, h, rtol, atol)
            frame[PASSAGES, l] += passages
            Y, new[W, l] = end, math.copysign(abs(end) ** (1 / n), end)
            relaxed = alpha * (new[S, l] - now[S, l])
            for row in range(8):
                now[row, l] = new[row, l]
            orthonormalise(block, l, tangents, -relaxed)
            factor = min(4.0, 0.9 * e ** (-1 / 6)) if e > 0 else 4.0
            step[CREEP, l] = h * factor if factor < 1 else max(step[CREEP, l], h * factor)  # h may have been cut
        else:
            step[CREEP, l] = h * (max(0.2, 0.9 * e ** (-1 / 6)) if e < 1e300 else 0.2)
        if h == left and e <= 1.0:
            if event == W:
                return NO_CROSSING
            now[T, l] = owner[TARGET, l]
            return DONE
        speed, power = powers(osc, l, now[W, l], TWO_POWERS)
        phi = m * speed
        if step[CREEP, l] * alpha * n * power < _LEAVE * switch * phi and not resting:
            step[MOVE, l], step[CREEP, l] = step[CREEP, l] / phi * (m + phi), 0.0
            step[H, l] = step[MOVE, l]
            return GOING
    return TOO_MANY_STEPS
