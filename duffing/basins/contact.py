"""Whether the right branch of the unstable manifold of the saddle orbit meets the stable one, at whatever turn.

`tangency` compares the two manifolds where each first crosses v = 0. Here no section is chosen: W^S parts the orbits
that stay from those that go over, so that W^U has met it if some of its orbits go over to the other well and others do
not. One fundamental domain, the piece of W^U that the stroboscopic map carries on to the next, stands for the branch.

The fates of `fates` do not tell this. Just below the tangency orbits of W^U turn round the right well within W^S, some
of them for long, and pass by the saddle orbit again and again. It swings across x = 0, and they with it: their fate is
neither LEFT nor RIGHT, but they have not gone over.
"""

from dataclasses import replace

import numpy as np

from .. import checks
from ..errors import ConvergenceError
from ..manifolds.saddle import saddle_orbit
from .boundary import crossings, line_of_starts

_LAUNCH = 1e-7  # of the fundamental domain from the saddle orbit, in (x, v)
_LEAST = 1e-9  # width of the cells, of the fundamental domain


def homoclinic_strips(osc, periods=14, most=30_000, **options):
    """How many ends the strips have that go over, on a fundamental domain of the right branch of W^U: 0 before it has
    met W^S.

    An orbit has gone over once it has been left of the left well's middle, x = -sqrt(-delta/gamma).

    osc : a single oscillator, delta < 0 < gamma; periods : within which orbits may go over, two of them on the way out
    most : as for `crossings`; strips thinner than 1e-9 of the domain are not seen
    options : method and options as for `duffing.flow.integrate`; errors as for `saddle_orbit`
    """
    unit = checks.single(osc).dimensionless()  # the lengths of `crossings` are its own
    saddle = saddle_orbit(unit)
    ends = (saddle.state + _LAUNCH * stretch * saddle.unstable for stretch in (1.0, saddle.multipliers[0]))
    line = line_of_starts(unit, *ends, periods, **options)

    def follow(s):
        images, _ = line(s)
        return images, images[0].min(axis=0) < -1

    return crossings(follow, least=_LEAST, most=most).left.size


def first_contact(osc, low, high, halvings=8, **options):
    """The forcings (below, above) between which W^U and W^S first meet: orbits of W^U go over at the second only.

    osc.mu is not used; low, high : forcings that bracket it; halvings : of the bracket; options as `homoclinic_strips`
    Raises ConvergenceError where the manifolds meet at low or do not at high.
    """
    checks.single(osc)
    checks.count("halvings", halvings)
    low, high = checks.number("low", low), checks.number("high", high)
    for mu, met in ((low, False), (high, True)):
        if (homoclinic_strips(replace(osc, mu=mu), **options) > 0) != met:
            raise ConvergenceError(f"mu = {mu}: the manifolds {'do not meet' if met else 'meet'} there: no bracket")
    for _ in range(halvings):
        middle = (low + high) / 2
        if homoclinic_strips(replace(osc, mu=middle), **options):
            high = middle
        else:
            low = middle
    return np.array([low, high])
