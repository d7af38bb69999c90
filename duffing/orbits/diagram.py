"""The bifurcation diagram by brute force: late stroboscopic points against the forcing, from sweeps and from starts.

What attracts depends on where the motion comes from. A sweep carries the last state on to the next mu, as an experiment
would, and follows one attractor until it ends; upwards and downwards it need not see the same one. Fresh starts at
every mu see whatever attracts any of them.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .. import checks
from ..oscillator import FIELDS
from ..poincare import poincare_section


class Diagram(NamedTuple):
    """Stroboscopic points at phase 0 against mu.

    mu : (n,) forcing amplitudes, as given
    forward, backward : (2, kept, *family, n) x and v of the sweep that carries its state upwards, and of the one that
        starts at the last mu and carries it downwards
    scattered : (2, kept, *family, n, starts) from each start anew at every mu
    """

    mu: np.ndarray
    forward: np.ndarray
    backward: np.ndarray
    scattered: np.ndarray


def bifurcation_diagram(
    osc, mu, starts, transient=200, kept=40, executor=None, progress=None, checkpoint=None, **options
):
    """The Diagram of the family `osc` (its own mu is not used) over the forcings mu.

    mu : (n,) increasing
    starts : (2, m) x and v; the first of them also begins both sweeps
    transient, kept : forcing periods thrown away and, after them, kept, at every mu
    executor, progress, checkpoint : as for `duffing.blocks.over_blocks`, which carries the fresh starts; the sweeps in
        mu go on from one forcing to the next and cannot be cut
    options, errors : method and options as for `duffing.flow.integrate`
    """
    mu = checks.times(mu, "mu")
    starts, family = checks.starts(starts), checks.model(osc).shape
    run = {"periods": checks.count("kept", kept), "transient": transient, **options}
    forward, backward = _sweeps(osc, mu, starts[:, 0], run)
    grid = _expanded(osc, 2, mu=np.broadcast_to(mu[:, None], (*family, mu.size, starts.shape[1])))
    state = np.broadcast_to(starts.reshape(2, *[1] * (len(family) + 1), -1), (2, *grid.shape))
    parts = {"executor": executor, "progress": progress, "checkpoint": checkpoint}
    return Diagram(mu, forward, backward, poincare_section(grid, state, **run, **parts))


def _sweeps(osc, mu, start, run):
    # Both directions are members of one family, so that they run side by side.
    n, family = mu.size, osc.shape
    state = np.broadcast_to(start.reshape(2, *[1] * (len(family) + 1)), (2, *family, 2))
    points = np.empty((2, run["periods"], *family, 2, n))
    for k in range(n):
        pair = _expanded(osc, 1, mu=np.broadcast_to(mu[[k, n - 1 - k]], (*family, 2)))
        points[..., k] = poincare_section(pair, state, **run)
        state = points[:, -1, ..., k]
    return points[..., 0, :], points[..., 1, ::-1]


def _expanded(osc, axes, mu):
    """The family with `axes` more axes at its end and the forcing mu."""
    values = {name: np.asarray(getattr(osc, name)) for name in FIELDS}
    wider = {name: value.reshape(*value.shape, *[1] * axes) for name, value in values.items() if value.ndim}
    return replace(osc, **(wider | {"mu": mu}))
