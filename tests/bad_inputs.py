"""What arguments of public functions cannot be, by the argument's name: each must be refused by that name."""

import math

import numpy as np

from duffing import Duffing

MASKED = np.ma.array([1.0, 2.0], mask=[False, True])
RAGGED = [[1.0, 2.0], [3.0]]
NOTHING = [None, "a word", math.nan, 1j, {}, object(), RAGGED, np.array(["a"]), [math.nan, 1.0], MASKED]
NUMBERS = [math.inf, -math.inf, *NOTHING]
COUNTS = [-1, 0.5, True, 10**400, np.timedelta64(3), *NUMBERS]
POSITIVE = [0, -1.0, [], np.array([1.0, 2.0]), *NUMBERS]
BAD = {
    "osc": [0.5, math.inf, [1.0], Duffing(delta=1.0).shape, Duffing, *NOTHING],
    "state": [1.0, [], (1.0, 2.0, 3.0), np.zeros((3, 2)), (math.inf, 0.0), *NOTHING],
    "t": NUMBERS,
    "on_failure": [0, "ignore", np.array(["nan", "raise"]), *NOTHING],
    "periods": [0, *COUNTS],
    "k": [0, 3, *COUNTS],
    "steps_per_period": [0, *COUNTS],
    # None: as many threads as there are processors, as many steps as the interval is long
    **{name: [0, *(bad for bad in COUNTS if bad is not None)] for name in ("threads", "max_steps")},
    "transient": COUNTS,
    "phase": NUMBERS,
    "t0": NUMBERS,
    "side": [0, 2, np.array([1, -1]), *NUMBERS],
    "method": [0, "rk5", np.array(["rk4", "auto"]), *NOTHING],
    **{name: POSITIVE for name in ("d0", "rtol", "atol")},
    "switch": [0.7, *POSITIVE],
    **{name: [-1.0, *NUMBERS] for name in ("alpha", "p", "omega")},
    **{name: NUMBERS for name in ("mu", "delta", "gamma")},
}
