"""A block of lanes: trajectories side by side, and what is known of each, part by part and row by row.

Quantity Q of a part, in lane l, is lanes(block, PART)[Q, l], for eight lanes at once eights(block, PART)[Q, c]; a
function opens the parts that it reads and writes by name. What a lane computes depends on nothing in the others.

    part       shape         rows
    NOW        8             the state: friction time S and time T since START, position X, W (velocity's substitute),
                             two tangent vectors (xi, eta)
    NEW        8             the state that an attempted step leads to
    SLOPES     13 x 8        the slopes of the state per sigma at the stages of a step; 0 is NOW's, 12 is NEW's
    OSC        9             the parameters in the order of Duffing.columns(), then m, n and the time where T = 0
    LINEAR     2             of the present stage, for the tangents: dt/dsigma dF/dx, and alpha dS/dsigma
    STEP       9             the step, how it went, and what it is limited by
    FRAME      4             the tangents' frame and the passages through zero force since the last target
    OWNER      6             whose trajectory it is, and where it has to go
"""

import math

from vectorized.memory import views

WIDTH = 32  # lanes: enough to hide the latencies of the processor, few enough that a block fits its first-level cache

NOW, NEW, SLOPES, OSC, LINEAR, STEP, FRAME, OWNER = range(8)

S, X, W, T, XI1, ETA1, XI2, ETA2 = range(8)
LAST = 12  # stage of a step

PARAMETERS = 9
ALPHA, P, MU, OMEGA, DELTA, GAMMA, M, N, START = range(PARAMETERS)
SPRING, DAMPER = range(2)
# H: the step in sigma to be tried; MOVE: the one that the tolerance alone allows; CREEP: that of a creep in time, 0 if
# there is none; NEAR, FAR: bracket of the length of a step that ends on the target, FAR = 0 if there is none; REJECTED:
# whether the last step was (0 or 1); GAIN: the logarithm by which errors have grown backward on a slow branch; OUTCOME:
# what befell the lane in its last step; STEPS: since the last target.
H, MOVE, CREEP, NEAR, FAR, REJECTED, GAIN, OUTCOME, STEPS = range(9)
LOG1, LOG2, SHEAR, PASSAGES = range(4)  # log R11, log R22, R12 / R11, passages through zero force
# TARGET: the time to reach; SIGN: of time; MEMBER: -1 is nobody's; INTERVAL of it; EVALUATIONS: of the force in all;
# PACE: by how much the bound on the steps grows for each unit of time since the last target.
TARGET, SIGN, MEMBER, INTERVAL, EVALUATIONS, PACE = range(6)

PARTS = ((8,), (8,), (LAST + 1, 8), (9,), (2,), (9,), (4,), (6,))
BLOCK = WIDTH * sum(map(math.prod, PARTS))
lanes, eights = views(PARTS, WIDTH)
