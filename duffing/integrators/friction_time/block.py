"""Trajectories side by side: what a block of lanes holds, row by row.

Quantity Q of lane l of the block `a` is a[Q + l]. A loop over the lanes of a row uses the processor's vector units;
what a lane computes depends on nothing in the others.
"""

WIDTH = 32  # lanes: enough to hide the latencies of the processor, few enough that a block fits its first-level cache

# The state: friction time and time since START, position, w (velocity's substitute), two tangent vectors (xi, eta).
S, X, W, T, XI1, ETA1, XI2, ETA2, STATE = (WIDTH * row for row in range(9))
# In the same order: what a step leads to, its slopes, the slopes at the stages of a step.
NEW, RATE, SLOPES, _END = STATE, 2 * STATE, 3 * STATE, 15 * STATE

# The parameters in the order of Duffing.columns(), then m, n and the time where T = 0.
PARAMETERS = 9
ALPHA, P, MU, OMEGA, DELTA, GAMMA, M, N, START, _END = (_END + WIDTH * row for row in range(PARAMETERS + 1))
# Of the present stage, for the tangents: dt/dsigma dF/dx, and alpha dS/dsigma.
SPRING, DAMPER, _END = (_END + WIDTH * row for row in range(3))
# The step in sigma to be tried, the one that the tolerance alone allows, that of a creep in time (0: not creeping).
H, MOVE, CREEP, _END = (_END + WIDTH * row for row in range(4))
# The time to reach, and the sign of time.
TARGET, SIGN, _END = (_END + WIDTH * row for row in range(3))
# A landing's bracket of lengths, FAR = 0 if there is none; whether the last step was rejected (0 or 1); the logarithm
# by which errors have grown backward on a slow branch; what befell the lane in its last step.
NEAR, FAR, REJECTED, GAIN, EVENT, _END = (_END + WIDTH * row for row in range(6))
# The tangents' frame since the last target: log R11, log R22, R12 / R11.
LOG1, LOG2, SHEAR, _END = (_END + WIDTH * row for row in range(4))
# Steps and passages through zero force while creeping since the last target, force evaluations in all.
STEPS, PASSAGES, EVALUATIONS, _END = (_END + WIDTH * row for row in range(4))
# Whose trajectory it is (-1: nobody's), and which interval of it.
MEMBER, INTERVAL, BLOCK = (_END + WIDTH * row for row in range(3))
