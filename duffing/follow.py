"""Follow one trajectory: explicit steps in friction time, implicit ones while it creeps, and its tangent frame.

Which of the two is taken decides what a result costs, not what it is: both keep the same tolerance.
"""

import math

from .compiled import compiled
from .creep import SLOW, at_rest, creep
from .dop853 import advance, error, land
from .friction_time import (
    ALPHA,
    ETA1,
    ETA2,
    OMEGA,
    XI1,
    XI2,
    M,
    N,
    P,
    S,
    T,
    W,
    X,
    force,
    powers,
    rate,
    stiffness,
)

DONE, DIVERGED, TOO_MANY_STEPS, PAST_UNKNOWN, STUCK, NO_CROSSING, _CREEPS, _MOVES = range(8)
# What a trajectory carries from one target to the next: explicit step in sigma, creep step in time (0: not creeping).
MOVE, CREEP = range(2)
# How it is followed: tolerances, bound on the steps to a target, relaxation times a step above which a creep begins.
RTOL, ATOL, MAX_STEPS, SWITCH = range(4)
# What is counted: force evaluations, passages through zero force while creeping, steps.
EVALUATIONS, PASSAGES, STEPS = range(3)
# Its tangent frame since the last target: log R11, log R22, R12 / R11.
LOG1, LOG2, SHEAR = range(3)

_ESCAPED = 1e30  # |x| that only solutions reach which become infinite in finite time
# An explicit step is at most this part of the linearised motion's fastest time: the tangent's error is then some
# 1e-9 a step even where the state itself (at rest, creeping) would allow any step.
_FRESH = 0.7
_LEAVE = 1 / 3  # a creep ends at this part of the relaxation times a step with which it begins
_CREEP_STEP = 1 / 16  # of a forcing period at most, so that no passage of the force through zero is overlooked


@compiled
def follow(q, y, component, target, limit, carry, tangents, control, frame, tally, K, new):
    """Carry y until time (component T) or w (component W) equals the target; carry[MOVE] has the sign of the time.

    For a turning point (component W, target 0) limit = (least x, longest time). Returns the status; y[S] and frame go
    on from what they were, the frame is orthonormal at the end.
    """
    tally[STEPS] = 0
    while True:
        if carry[CREEP] > 0.0:
            status = _creep_on(q, y, component, target, limit, carry, tangents, control, frame, tally, new)
        else:
            status = _move_on(q, y, component, target, limit, carry, tangents, control, frame, tally, K, new)
        if status < _CREEPS:
            orthonormalise(y, tangents, frame, _log_area(y, tangents))
            return status


@compiled
def _move_on(q, y, component, target, limit, carry, tangents, control, frame, tally, K, new):
    """Explicit steps until the target or a creep."""
    h, gain, rejected = carry[MOVE], 0.0, False
    rate(q, y, tangents, K, 0)
    tally[EVALUATIONS] += 1
    while tally[STEPS] < control[MAX_STEPS]:
        tally[STEPS] += 1
        if q[M] == 1.0 and component == T and abs(target - y[T]) < abs(h):
            carry[MOVE], h = h, target - y[T]
        advance(q, y, h, tangents, K, new)
        tally[EVALUATIONS] += 12
        e = error(q, y, new, h, K, control[RTOL], control[ATOL])
        if not e <= 1.0:
            h *= max(0.2, 0.9 * e**-0.125) if e < 1e300 else 0.2
            rejected = True
            continue
        exact = component == T and abs(new[T] - target) <= 4e-16 * max(1.0, abs(target))
        passed = abs(new[T]) > abs(target) if component == T else y[W] * new[W] < 0
        if exact or passed:
            behind, its_rate = new.copy(), K[12].copy()
            if exact:
                new[T] = target
            else:
                tally[EVALUATIONS] += land(q, y, h, tangents, component, target, K, new)
            if component == T or new[X] > limit[0]:
                y[:] = new
                carry[MOVE] = math.copysign(max(abs(h), abs(carry[MOVE])) if q[M] == 1.0 else abs(h), h)
                return DONE
            new[:], K[12] = behind, its_rate  # a turning point that was not asked for: on behind it
        for d in range(y.size):
            y[d], K[0, d] = new[d], K[12, d]
        relaxations = q[ALPHA] * K[0, S] * abs(h)
        fastest = math.sqrt(abs(stiffness(q, y[X]))) * K[0, T] + q[ALPHA] * K[0, S]
        h *= min(1.0 if rejected else 6.0, 0.9 * e**-0.125) if e > 0 else 6.0
        rejected = False
        h = math.copysign(min(abs(h), _FRESH / fastest), h)
        if not abs(y[X]) < _ESCAPED:
            return DIVERGED
        if component == W and abs(y[T]) > limit[1]:
            return NO_CROSSING
        if _collapses(y, tangents):
            orthonormalise(y, tangents, frame, _log_area(y, tangents))
            rate(q, y, tangents, K, 0)
        if q[P] >= 1.0:
            continue
        resting = at_rest(q, y[X], q[M] * K[0, W], q[M] * K[0, S] * y[W] / q[N])  # phi = 0 there
        slow = abs(K[0, W]) < SLOW * q[ALPHA] * K[0, S] * abs(y[W]) / q[N]
        if h > 0 and ((slow and relaxations > control[SWITCH]) or resting):
            carry[MOVE], carry[CREEP] = h, max(h * K[0, T], 1e-6 / q[OMEGA])  # the first can underflow
            return _CREEPS
        if h < 0:
            # Backward, the slow branch repels. What stays on it that long has amplified its error beyond use.
            gain = gain + relaxations if slow else 0.0
            if gain > max(3.0, math.log(1e-4 / control[RTOL])) or resting:
                return PAST_UNKNOWN
    return TOO_MANY_STEPS


@compiled
def _creep_on(q, y, component, target, limit, carry, tangents, control, frame, tally, new):
    """Implicit steps until the target, or until a step is short enough for the explicit method."""
    power = powers(q, y[W])[1]
    Y = power * y[W]
    orthonormalise(y, tangents, frame, _log_area(y, tangents))
    while tally[STEPS] < control[MAX_STEPS]:
        tally[STEPS] += 1
        left = (target if component == T else limit[1]) - y[T]
        h = min(carry[CREEP], left, _CREEP_STEP * 2 * math.pi / q[OMEGA])
        resting = at_rest(q, y[X], force(q, y[X], y[T]), Y)
        end, e, passages, evaluations = creep(q, y, Y, h, tangents, control[RTOL], control[ATOL], new)
        tally[EVALUATIONS] += evaluations
        if q[P] > 0.5 and resting:
            passages = 0
        if passages < 0 or (passages > 0 and q[P] > 0.5):
            e = math.inf  # a turn, or a passage in finite friction time: for explicit steps to resolve
        if e <= 1.0:
            if passages > 0 and component == W and new[X] > limit[0]:
                return STUCK
            tally[PASSAGES] += passages
            Y, new[W] = end, math.copysign(abs(end) ** (1 / q[N]), end)
            relaxed = q[ALPHA] * (new[S] - y[S])
            y[:] = new
            orthonormalise(y, tangents, frame, -relaxed)
            factor = min(4.0, 0.9 * e ** (-1 / 6)) if e > 0 else 4.0
            carry[CREEP] = h * factor if factor < 1 else max(carry[CREEP], h * factor)  # h may have been cut
        else:
            carry[CREEP] = h * (max(0.2, 0.9 * e ** (-1 / 6)) if e < 1e300 else 0.2)
        if h == left and e <= 1.0:
            if component == W:
                return NO_CROSSING
            y[T] = target
            return DONE
        phi, power = powers(q, y[W])
        if carry[CREEP] * q[ALPHA] * q[N] * power < _LEAVE * control[SWITCH] * phi and not resting:
            carry[MOVE], carry[CREEP] = carry[CREEP] / phi * (q[M] + phi), 0.0
            return _MOVES
    return TOO_MANY_STEPS


@compiled
def _collapses(y, tangents):
    """Whether the two tangent vectors have come so close to one direction that digits are about to be lost."""
    if tangents < 2:
        return False
    area = abs(y[XI1] * y[ETA2] - y[ETA1] * y[XI2])
    return area < 0.01 * math.hypot(y[XI1], y[ETA1]) * math.hypot(y[XI2], y[ETA2])


@compiled
def _log_area(y, tangents):
    """Logarithm of the area that both tangent vectors span, which stays positive."""
    area = y[XI1] * y[ETA2] - y[ETA1] * y[XI2] if tangents == 2 else 1.0
    return math.log(area) if area > 0.0 else -math.inf


@compiled
def orthonormalise(y, tangents, frame, log_area):
    """Gram and Schmidt: the tangent vectors in y become orthonormal, the factor R is multiplied onto the frame's."""
    if tangents == 0:
        return
    r11 = math.hypot(y[XI1], y[ETA1])
    r12 = (y[XI1] * y[XI2] + y[ETA1] * y[ETA2]) / r11
    if tangents == 2 and frame[LOG2] > -math.inf:
        frame[SHEAR] += r12 / r11 * math.exp(frame[LOG2] - frame[LOG1])
        frame[LOG2] += log_area - math.log(r11)
    frame[LOG1] += math.log(r11)
    y[XI1] /= r11
    y[ETA1] /= r11
    y[XI2], y[ETA2] = -y[ETA1], y[XI1]
