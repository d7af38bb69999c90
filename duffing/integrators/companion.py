"""Growth of the distance of two neighbouring trajectories: the paper's way to lambda_1, by its own Runge-Kutta steps.

Neither trajectory is a tangent: what round-off and a finite distance make of the method is kept, since the paper's
exponents contain it.
"""

import numpy as np

from vectorized.vectors import EIGHT

from .. import checks
from .forcing import map_chunks
from .rk4 import LANES, advance, check_finite, checked


def two_trajectory_growth(osc, state, periods, d0=1e-8, steps_per_period=500, threads=None):
    """Log growth (periods, N), per forcing period, of the distance to a companion started at (x + d0, v) and t = 0.

    After each period the companion is put back to the distance d0 along the separation reached (Benettin et al. 1980).
    Where the two have become equal in every bit, the separation counts as one unit in the last place of the larger of
    |x|, |v|, so that the growth recorded is an upper bound, and the companion starts anew at (x + d0, v).

    osc, state, steps_per_period, threads as in `rk4.integrate`; raises ValueError for invalid input, also for a d0
    that (x, v) cannot show at some period, and DivergedError when a solution is not finite.
    """
    periods, d0 = checks.count("periods", periods), checks.positive("d0", d0)
    period = np.array([[0.0], [1.0]]) * np.ravel(np.broadcast_to(osc.period, osc.shape))
    columns, state, t, steps_per_period, threads = checked(osc, state, period, steps_per_period, threads)
    growth = np.empty((periods, columns.shape[1]))

    def run(members, padded, h, law, forcing):
        lanes, parameters = np.arange(len(padded)), np.ascontiguousarray(columns[:, padded])
        ends, nothing = np.empty((2, 2, 2, len(lanes))), (np.empty((0, 1, 0)), np.empty((0, 0, 0, 0)))
        start = np.array([[d0], [0.0]])
        pair = np.repeat(state[None, :, padded], 2, axis=0)
        for i in range(periods):
            pair[1] = pair[0] + start
            before = np.hypot(*(pair[1] - pair[0]))
            if not before.all():
                raise ValueError(f"d0 = {d0}: must be large enough to change {pair[0, :, before.argmin()]} as doubles")
            for each in range(2):
                advance(parameters, pair[each], h, *forcing, law, 0, lanes, ends[each], *nothing)
            check_finite(parameters, *ends)
            pair = np.ascontiguousarray(ends[:, :, 1])
            apart = pair[1] - pair[0]
            distance = np.hypot(*apart)
            merged = distance == 0
            distance = np.where(merged, np.spacing(np.abs(pair[0]).max(axis=0)), distance)
            growth[i, members] = np.log(distance / before)[: len(members)]
            start = np.where(merged, [[d0], [0.0]], apart * (d0 / distance))

    map_chunks(run, columns, t, steps_per_period, threads, LANES, EIGHT)
    return growth
