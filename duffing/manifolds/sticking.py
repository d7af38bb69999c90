"""Where the saddle orbit sticks: the frontier of the Melnikov argument at small exponents (p < 1/2).

At weak forcing and p < 1/2 friction wins over inertia: the velocity relaxes to the slow branch alpha sign(v) |v|^p = F
and passes through zero on it, together with the force F. Friction time diverges there, a tangent direction is
annihilated, the stroboscopic map is not invertible, and the saddle orbit has no W^S in the usual sense. Stronger
forcing lets the velocity overshoot, and the orbit is hyperbolic again. For p > 1/2 inertia wins near v = 0 and none of
this occurs.
"""

import numpy as np

from ..errors import ConvergenceError, NoSaddleOrbitError
from ..oscillator import Duffing
from .saddle import at_rest, names, unit_members, units
from .shooting import central_orbit

_DOUBLINGS, _HALVINGS = 20, 17


def saddle_friction_time(osc):
    """Friction time S = integral of p |v|^(p-1) dt that the orbit near x = 0 spends in one forcing period, (*family).

    The product of its multipliers is exp(-alpha S); S is infinite where it sticks. Unit: velocity^(p-1) time.
    Raises ValueError unless delta < 0 < gamma; NoSaddleOrbitError where Newton's method does not find the orbit.
    """
    unit = unit_members(osc)
    total = _friction_time(unit).reshape(osc.shape)
    length, velocity, _ = units(osc)
    return (total * length * velocity ** (osc.p - 2))[()]


def sticking_amplitude(osc):
    """The forcing mu below which the saddle orbit sticks, (*family), to a relative 1e-4; osc.mu is not used.

    Zero for p > 1/2 and for alpha = 0, where it sticks at no mu. Found by bisection on whether S is infinite. Raises
    ValueError unless delta < 0 < gamma, and for p = 1/2, where friction and inertia scale alike and S diverges too
    gradually for that; NoSaddleOrbitError where Newton's method does not find the orbit; ConvergenceError where it
    sticks at every forcing tried.
    """
    unit = unit_members(osc)
    columns = unit.columns()
    if np.any(unit.p == 0.5):
        raise ValueError(
            f"p = {osc.p}: must not be 1/2, the marginal case, for the amplitude below which the orbit sticks"
        )
    able = (unit.p < 0.5) & (unit.alpha > 0)
    result, part = np.zeros(unit.mu.size), columns[:, able]

    def sticks(mu):
        return np.isinf(_friction_time(Duffing(*part[:2], mu, *part[3:])))

    # Where the cubic force is negligible, (x, mu) ~ alpha^(1/(1-p)) takes alpha out of the equation.
    low, high = np.zeros_like(part[0]), 2 * part[0] ** (1 / (1 - part[1]))
    for _ in range(_DOUBLINGS):
        if not able.any() or not (stuck := sticks(high)).any():
            break
        low, high = np.where(stuck, high, low), np.where(stuck, 2 * high, high)
    else:
        raise ConvergenceError(f"alpha = {osc.alpha}, p = {osc.p}: the orbit sticks at every forcing tried")
    for _ in range(_HALVINGS if able.any() else 0):
        middle = (low + high) / 2
        stuck = sticks(middle)
        low, high = np.where(stuck, middle, low), np.where(stuck, high, middle)
    result[able] = high
    return (result.reshape(osc.shape) * units(osc)[2])[()]


def _friction_time(unit):
    orbit, found = central_orbit(unit)
    if not found.all():
        raise NoSaddleOrbitError(f"Newton's method finds no orbit near x = 0 for {names(unit, np.argmin(found))}")
    return np.where(at_rest(unit), np.inf, 2 * orbit.friction_time.sum(axis=0))
