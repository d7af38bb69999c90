"""What every integrator returns."""

from typing import NamedTuple

import numpy as np


class Solution(NamedTuple):
    """Solutions of a family of N members at n times, with k tangent vectors carried along.

    states : (2, n, N) x and v at the times; states[:, 0] is the start
    growth : (k, n - 1, N) log of the diagonal of R: what each interval adds to the logarithms of the stretching
    propagators : (2, 2, n - 1, N) tangent map of each interval when k = 2, else None
    friction_time : (n - 1, N) friction time S = integral of p |v|^(p-1) dt spent in each interval, where it is measured
    annihilations : (n - 1, N) number of times that a creep through zero force destroyed a tangent direction
    evaluations : (N,) number of evaluations of the force, where it is counted
    """

    states: np.ndarray
    growth: np.ndarray
    propagators: np.ndarray | None = None
    friction_time: np.ndarray | None = None
    annihilations: np.ndarray | None = None
    evaluations: np.ndarray | None = None
