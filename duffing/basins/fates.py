"""What has become of starts after a number of periods, read off the last of them: no attractor need be known.

LEFT, RIGHT : x has kept its sign, the motion is in one well. LARGE : it crosses x = 0 and repeats itself each period,
to 0.05 in (x, v). IRREGULAR : it crosses x = 0 and does not: chaos, or a motion on its way. Unlike a label of
`attractors` a fate is no proof of where the start ends; it is what an experiment of that length would report.
"""

from dataclasses import replace

import numpy as np

from .. import checks
from ..blocks import block_for, over_blocks
from ..flow import integrate

LEFT, RIGHT, LARGE, IRREGULAR = range(4)
NAMES = ("left well", "right well", "large orbit", "irregular")
LOOKS = 8  # at the path in a period: between two of them the saddle stretches by little more than two
LAST = 4  # periods that are read, unless more are asked for
_REPEATS = 0.05  # distance in (x, v) of successive stroboscopic points of a motion that repeats itself


def classify(osc, states, periods=60, last=LAST, executor=None, progress=None, checkpoint=None, **options):
    """Fates (*family) of the states (2, *family) at phase 0 after so many forcing periods.

    osc : a family, or a single oscillator with states (2, *shape)
    last : periods at the end that are read. Chaos may stay in one well for a few: where it is likely, read more.
    executor, progress, checkpoint : as for `duffing.blocks.over_blocks`
    options, errors : method and options as for `duffing.flow.integrate`
    """
    last = checks.count("last", last)
    periods = checks.count("periods", periods, least=last + 1)
    states = checks.floats("states", states, "two finite numbers (x, v) each")
    if not checks.model(osc).shape and states.ndim > 1 and states.size:
        osc = replace(osc, mu=np.full(states.shape[1:], osc.mu))
    state, task = checks.state(states, osc.shape, "states"), {"periods": periods, "last": last, **options}
    run = {"executor": executor, "progress": progress, "checkpoint": checkpoint}
    return over_blocks(_fates, osc, state, task, block=block_for(periods, **options), **run)[0].reshape(osc.shape)


def _fates(osc, state, periods, last, **options):
    """What `classify` does with a block: array (1, n)."""
    t = np.append(0, periods - last + np.arange(last * LOOKS + 1) / LOOKS)[:, None] * osc.period
    if np.ptp(osc.period) == 0:
        t = t[:, 0]  # the same for all members, which the integrators need to check only once
    return classify_path(integrate(osc, state, t, **options).states[:, 1:], last)[None]


def classify_path(path, last=LAST):
    """Fates (n,) from the last periods of the paths (2, m, n), looked at LOOKS times a period."""
    x, points = path[0, -last * LOOKS - 1 :], path[:, -last * LOOKS - 1 :: LOOKS]
    repeats = np.hypot(*np.diff(points, axis=1)).max(axis=0) < _REPEATS
    crossing = np.where(repeats, LARGE, IRREGULAR)
    return np.where(np.all(x > 0, axis=0), RIGHT, np.where(np.all(x < 0, axis=0), LEFT, crossing))
