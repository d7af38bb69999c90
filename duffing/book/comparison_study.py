"""What the chapter on the contradiction compares between exponents p: at equal forcing, at equal multiples of mu_c, and
at equal energy taken by the damping."""

from dataclasses import replace

import numpy as np

from .. import checks, paper
from ..lyapunov import lyapunov_spectrum
from ..melnikov import critical_amplitude
from . import small_p
from .comparison import Wandering, wandering
from .remember import remembered
from .transient_study import between, integrator

P = (0.1, 0.5, 1.0, 2.0)
MU_EQUAL = 0.268  # just above the onset of lasting chaos at p = 0.1; at the other exponents chaos is transient there
ENERGY_EQUAL = 0.22  # energy taken in a period; every exponent reaches it while it wanders
CHAOTIC = 0.05  # an exponent above this is called chaotic; regular motion has a negative one
RATIOS = (1.85, 2.45, 3.30, 5.60)  # each in the middle of the chaos of one of the exponents P
MU = {
    0.1: (0.264, 0.266, 0.268, 0.270, 0.272, 0.274, 0.277, 0.280, 0.285),
    0.5: (0.246, 0.250, 0.254, 0.257, 0.259, 0.262, 0.265, 0.268, 0.272),
    1.0: (0.210, 0.225, 0.230, 0.235, 0.240, 0.245, 0.250, 0.255, 0.260, 0.264, 0.268, 0.272),
    2.0: (0.220, 0.225, 0.230, 0.235, 0.240, 0.245, 0.250, 0.255, 0.260, 0.264, 0.268),
}  # forcings at which starts wander long enough
GRID = {0.1: (8, 5), 0.5: (8, 6), 1.0: (32, 16), 2.0: (16, 10)}  # columns and rows of starts: more where fewer wander


@remembered
def compared(p, mu=None, columns=None, rows=None, periods=240, osc=paper.OSCILLATOR):
    """The Wandering at the exponent p for a tuple of forcings (default MU[p]): mu (n,), mu / mu_c (n,), Wandering.

    columns, rows : of the grid of starts `between` the wells (default GRID[p])
    """
    mu = np.array(MU[p] if mu is None else mu)
    family = replace(osc, p=p, mu=mu)
    starts = between(columns or GRID[p][0], rows or GRID[p][1])
    ratio = mu / critical_amplitude(replace(osc, p=p))
    return mu, ratio, Wandering(*wandering(family, starts, periods, **integrator(p)))


@remembered
def chaotic_share(mu, p, columns=8, rows=5, periods=199, osc=paper.OSCILLATOR):
    """Share (n,) of the starts with lambda_1 > CHAOTIC over the paper's time, forty periods left out, for each mu."""
    state = small_p.starts(columns, rows)
    family = replace(osc, p=p, mu=np.repeat(np.array(mu)[:, None], state.shape[1], axis=1))
    start = np.repeat(state[:, None], len(mu), axis=1)
    spectrum = lyapunov_spectrum(family, start, periods, 40, k=1, **integrator(p))
    return np.mean(spectrum.exponents[0] > CHAOTIC, axis=1)


def at_equal_ratio(ratios=RATIOS, p=P, osc=paper.OSCILLATOR, **sizes):
    """Chaotic shares (len(ratios), len(p)) at the forcings ratio times mu_c; sizes : as for `chaotic_share`."""
    mu = [np.array(ratios) * critical_amplitude(replace(osc, p=exponent)) for exponent in p]
    return np.transpose([chaotic_share(part, exponent, **sizes) for part, exponent in zip(mu, p, strict=True)])


def at_equal(value, x, y, error, within):
    """y at x = value and one standard error, from the straight line of least squares, weighted by the errors, through
    the points nearer than `within`; points without a finite error do not count.

    Raises ValueError where fewer than three points are left.
    """
    x, y, error = (np.asarray(part, dtype=float) for part in (x, y, error))
    within = checks.positive("within", within)
    usable = np.isfinite(x) & np.isfinite(y) & np.isfinite(error) & (np.abs(x - value) < within)
    if usable.sum() < 3:
        raise ValueError(f"within = {within}: must leave at least three points, leaves {usable.sum()}")
    design = np.array([np.ones(usable.sum()), x[usable] - value]).T / error[usable, None]
    covariance = np.linalg.inv(design.T @ design)
    return float(covariance[0] @ design.T @ (y[usable] / error[usable])), float(np.sqrt(covariance[0, 0]))
