"""The Poincare section: the stroboscopic map of one forcing period at a stated phase."""

import numpy as np

from . import checks
from .blocks import block_for, over_blocks
from .flow import integrate, stroboscopic_times


def poincare_section(
    osc, state, periods, transient=0, phase=0.0,
    executor=None, progress=None, checkpoint=None, on_failure="raise", **options,
):  # the problem, then how it is run  # fmt: skip
    """Stroboscopic points of orbits that start in `state` at t = 0: array (2, periods, *family) of x and v.

    periods, transient : numbers of points kept and, before them, thrown away; the point of number k = 1, 2, ... of
        all of them is the state at t = (phase + 2 pi k) / omega, so that with phase = 0 it is the k-th iterate
    phase : forcing phase omega t (radian) in [0, 2 pi)
    executor, progress, checkpoint, on_failure : as for `duffing.blocks.over_blocks`
    options, errors : method and options as for `duffing.flow.integrate`
    """
    state = checks.state(state, checks.model(osc).shape)
    phase = checks.number("phase", phase)
    if not 0 <= phase < 2 * np.pi:
        raise ValueError(f"phase = {phase}: must be in [0, 2 pi)")
    periods, transient = checks.count("periods", periods), checks.count("transient", transient, least=0)
    task = {"periods": periods, "transient": transient, "phase": phase, **options}
    run = {"executor": executor, "progress": progress, "checkpoint": checkpoint}
    run |= {"on_failure": on_failure, "rows": (2, periods)}
    points = over_blocks(_section, osc, state, task, block=block_for(transient + periods, **options), **run)
    return points.reshape(2, periods, *osc.shape)


def _section(osc, state, periods, transient, phase, **options):
    """The points of a block: (2, periods, n)."""
    t = stroboscopic_times(osc, periods, transient, phase)
    if np.any(t[0] > 0):  # the way from t = 0 to the first point before the section
        t = np.concatenate([np.zeros((1, t.shape[1])), t])
    return integrate(osc, state, t, 0, **options).states[:, -periods:]
