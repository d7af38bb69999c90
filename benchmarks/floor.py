"""The floor under the kernel: what its arithmetic alone would take at the speed of this machine's vector units.

One Runge-Kutta step of state and tangent is four powers |v|^(p-1) and the operations counted below. Each is timed by
itself in a loop that nothing else holds up, with vectors as wide as the kernel's; their sum
over the kernel's own time is the share that is floor.
"""

import statistics
import time

import numpy as np
from numba import njit

from duffing.integrators.powers import evaluate, power
from vectorized.memory import widest_vectors
from vectorized.vectors import fma

from .rewrites import STEPS
from .sweep import PERIODS, family, kernel

POWERS = 4
# Additions, products and fused multiply-adds of a step as in `duffing.integrators.rk4`. In each of four stages: 5 for
# the force, 4 for the slopes of v and eta; for sums and next arguments 4 in the first stage and 8 in each other; 2
# products with h. The middle stages share mu cos(omega t). With a power, alpha |v|^(p-1) and p times it are 2 more a
# stage.
OPERATIONS = {False: 4 * 9 + 4 + 3 * 8 + 2 - 1, True: 4 * 11 + 4 + 3 * 8 + 2 - 1}
_CHAIN = 16


# The sum, which is thrown away, may be added up in any order: so that the loop vectorises.
@njit(fastmath={"reassoc"}, error_model="numpy")
def _powers(v, law, repeats):
    widest_vectors()
    total = 0.0
    for _ in range(repeats):
        for l in range(v.size):
            total += evaluate(v[l], law)
    return total


@njit(fastmath={"reassoc"})
def _multiply_adds(v, repeats):
    widest_vectors()
    total = 0.0
    for _ in range(repeats):
        for l in range(v.size):
            a = v[l]
            for _ in range(_CHAIN):
                a = fma(a, 0.5, 1.0)
            total += a
    return total


def measure(p, rounds, size=512, repeats=200):
    """(share of the kernel's time that is floor, share that is powers), medians over interleaved rounds."""
    v, run = np.linspace(0.05, 1.0, 960), kernel(family(p, size), PERIODS)
    law = power(p - 1, 2.0**-50) if p != 1 else None
    steps, shares = size * PERIODS * STEPS, []
    for number in range(rounds + 1):
        own = _seconds(run) / steps
        each_fma = _seconds(lambda: _multiply_adds(v, repeats)) / (v.size * repeats * _CHAIN)
        each_power = 0.0 if law is None else _seconds(lambda: _powers(v, law, repeats)) / (v.size * repeats)
        if number > 0:  # the first round compiles
            powers = POWERS * each_power
            shares.append(((powers + OPERATIONS[law is not None] * each_fma) / own, powers / own))
    return tuple(map(statistics.median, zip(*shares, strict=True)))


def _seconds(run):
    start = time.process_time()
    run()
    return time.process_time() - start
