"""Where the saddle orbit sticks: the frontier of the Melnikov argument at small exponents (p < 1/2).

At weak forcing and p < 1/2 friction wins over inertia: the velocity relaxes to the slow branch alpha sign(v) |v|^p = F
and passes through zero on it, together with the force F. Friction time diverges there, a tangent direction is
annihilated, the stroboscopic map is not invertible, and the saddle orbit has no W^S in the usual sense. Stronger
forcing lets the velocity overshoot, and the orbit is hyperbolic again. For p > 1/2 inertia wins near v = 0 and none of
this occurs.
"""

from dataclasses import replace

import numpy as np

from .. import checks
from ..errors import ConvergenceError, NoSaddleOrbitError
from .saddle import at_rest
from .shooting import central_orbit

_DOUBLINGS, _HALVINGS = 20, 17


def sticking_amplitude(osc):
    """The forcing mu below which the saddle orbit sticks, (*family), to a relative 1e-4; osc.mu is not used.

    Zero for p > 1/2 and for alpha = 0, where it sticks at no mu. Found by bisection on whether S is infinite. Raises
    ValueError unless delta < 0 < gamma, and for p = 1/2, where friction and inertia scale alike and S diverges too
    gradually for that; NoSaddleOrbitError where Newton's method does not find the orbit; ConvergenceError where it
    sticks at every forcing tried.
    """
    unit = checks.model(osc).dimensionless().members()
    if np.any(unit.p == 0.5):
        raise ValueError(
            f"p = {osc.p}: must not be 1/2, the marginal case, for the amplitude below which the orbit sticks"
        )
    able = (unit.p < 0.5) & (unit.alpha > 0)
    result = np.zeros(able.shape)
    if able.any():
        result[able] = _frontier(unit.members(able))
    return (result.reshape(osc.shape) * osc.units()[2])[()]


def _frontier(unit):
    def sticks(mu):
        return np.isinf(_friction_time(replace(unit, mu=mu)))

    # Where the cubic force is negligible, (x, mu) ~ alpha^(1/(1-p)) takes alpha out of the equation.
    low, high = np.zeros_like(unit.alpha), 2 * unit.alpha ** (1 / (1 - unit.p))
    for _ in range(_DOUBLINGS):
        if not (stuck := sticks(high)).any():
            break
        low, high = np.where(stuck, high, low), np.where(stuck, 2 * high, high)
    else:
        raise ConvergenceError(f"{unit.named()}: the orbit sticks at every forcing tried")
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        stuck = sticks(middle)
        low, high = np.where(stuck, middle, low), np.where(stuck, high, middle)
    return high


def _friction_time(unit):
    orbit, found = central_orbit(unit)
    if not found.all():
        raise NoSaddleOrbitError(f"Newton's method finds no orbit near x = 0 for {unit.named(np.argmin(found))}")
    return np.where(at_rest(unit), np.inf, 2 * orbit.friction_time.sum(axis=0))
