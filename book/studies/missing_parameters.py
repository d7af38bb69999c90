"""What the paper's algorithm gives for candidates of the missing alpha and omega, from an ensemble of nearby starts.

In chaos another machine's rounding is another sample of the motion. So each quantity that the text quotes is computed
from several initial conditions within `DISTANCE` of the paper's, and what comes out is a distribution.
"""

from typing import NamedTuple

import numpy as np

from duffing import Duffing, checks, critical_amplitude, paper
from duffing.blocks import block_for, over_blocks
from duffing.flow import integrate
from duffing.integrators.companion import two_trajectory_growth

from ..remember import remembered
from . import inference

DISTANCE, SEED = 1e-9, 1
STARTS = 24  # initial conditions of an ensemble
PARTS = 10  # of a forcing period, at which the state is looked at
SETTLED = 191  # forcing periods: omega t = 1200, rounded up
AVERAGES = ("from $t = 0$", "from $t = 1200$")
D0 = 1e-8  # the distance of the two trajectories
SMALL = 0.1  # amplitude of a motion that the authors would call "very small"
LONGEST = 6  # forcing periods of a motion that still counts as periodic
WEAK = (0.005, 0.01, 0.02, 0.03, 0.04)  # "mu close to 0"
FIGURE = tuple(np.round(np.arange(0.01, 0.4001, 0.01), 3))  # forcing amplitudes at which Fig. 4 is looked at
FINER = (0.005, 0.255, 0.265)  # besides, at p = 0.1: near 0 and below the onset
COARSE = tuple(np.round(np.arange(0.02, 0.4001, 0.02), 3))  # where of Fig. 3b only the onset is looked at
# Candidates. At larger alpha mu = 0.27 lies below mu_c at p = 0.1, whatever omega: chaos there is below the line.
ALPHAS, OMEGAS = (0.01, 0.20), (0.5, 1.8)
REACH = 10.0  # nats of log likelihood
CHAOTIC = 0.08  # nats per unit time: 0.12 in bits, and so in either unit ten kernels from the printed 0.175
P_LINE = (paper.P_SMALL, paper.P_LINEAR, 2.0)  # exponents at which Fig. 3b is looked at


class Runs(NamedTuple):
    """One row a member: exponent (2, ...), the averages of lambda_1 as in AVERAGES, per unit time; crossings (2, ...)
    of x = 0 and amplitude (2, ...), half the range of x, before and after t = 1200; aperiodic (...), the least
    distance of the last stroboscopic points to those of at most `LONGEST` periods before."""

    exponent: np.ndarray
    crossings: np.ndarray
    amplitude: np.ndarray
    aperiodic: np.ndarray


class Curve(NamedTuple):
    """Along a figure: mu (k,); exponent (k, n, m), lambda_1 from t = 0; moving (k, n, m), whether the late motion has
    an amplitude above `SMALL`."""

    mu: np.ndarray
    exponent: np.ndarray
    moving: np.ndarray


class Evidence(NamedTuple):
    """What m candidates give: alpha, omega (m,); chaotic and regular, their Runs (n, m) at mu = 0.27 and 0.25, p = 0.1;
    curves and critical, dicts p -> Curve and p -> mu_c (m,)."""

    alpha: np.ndarray
    omega: np.ndarray
    chaotic: Runs
    regular: Runs
    curves: dict
    critical: dict


def starts(n=STARTS, distance=DISTANCE, seed=SEED):
    """n initial conditions (2, n): the paper's, and others at random in the square of half side `distance` round it."""
    shift = np.random.default_rng(seed).uniform(-distance, distance, (2, checks.count("n", n)))
    shift[:, 0] = 0.0
    return np.array(paper.START)[:, None] + shift


def runs(alpha, omega, mu, p=paper.P_SMALL, n=STARTS, distance=DISTANCE, seed=SEED, **run):
    """The paper's algorithm for every candidate (m,), forcing amplitude (k,) and start (n): Runs with axes (k, n, m).

    run : executor, progress, checkpoint, threads as for `over_blocks`
    """
    osc, state = _family(alpha, omega, mu, p, n, distance, seed)
    options = {"threads": run.pop("threads")} if "threads" in run else {}
    block = block_for(2 * paper.PERIODS, "rk4")
    rows = over_blocks(_rows, osc, state.reshape(2, -1), options, block=block, **run).reshape(7, *osc.shape)
    return Runs(rows[0:2], rows[2:4], rows[4:6], rows[6])


def two_trajectories(alpha, omega, mu, n=STARTS, distance=DISTANCE, seed=SEED, **run):
    """lambda_1 from two trajectories: (2 averages, k, n, m); arguments as for `runs`, p = 0.1."""
    osc, state = _family(alpha, omega, mu, paper.P_SMALL, n, distance, seed)
    options = {"threads": run.pop("threads")} if "threads" in run else {}
    block = block_for(2 * paper.PERIODS, "rk4")
    return over_blocks(_companion_rows, osc, state.reshape(2, -1), options, block=block, **run).reshape(2, *osc.shape)


def quoted(alpha, omega, n=STARTS, **ensemble):
    """The motions whose exponents are printed: Runs (n, m) at mu = 0.27 and at mu = 0.25; ensemble : as for `runs`."""
    found = runs(alpha, omega, (paper.MU_CHAOTIC, paper.MU_REGULAR), n=n, **ensemble)
    return tuple(Runs(*(field[..., i, :, :] for field in found)) for i in range(2))


def evidence(alpha, omega, n=STARTS, few=2, known=None, **ensemble):
    """Everything that the statements of the text are held against, for the candidates alpha, omega (m,).

    n : starts at the two forcing amplitudes whose exponents are printed; few : elsewhere along the figures; known :
    what `quoted` has found already; ensemble : distance, seed and how it is run, as for `runs`
    """
    alpha, omega = np.broadcast_arrays(*(np.atleast_1d(np.asarray(each, dtype=float)) for each in (alpha, omega)))
    chaotic, regular = known or quoted(alpha, omega, n=n, **ensemble)
    curves = {}
    for p in P_LINE:
        mu = np.sort((*FIGURE, *FINER)) if p == paper.P_SMALL else FIGURE if p == paper.P_LINEAR else COARSE
        found = runs(alpha, omega, mu, p=p, n=few, **ensemble)
        curves[p] = Curve(np.array(mu), found.exponent[0], found.amplitude[1] > SMALL)
    critical = {p: critical_amplitude(Duffing(alpha=alpha, p=p, omega=omega)) for p in P_LINE}
    return Evidence(alpha, omega, chaotic, regular, curves, critical)


class Plane(NamedTuple):
    """alpha (a,), omega (w,): the candidates; exponent (a, w): the larger lambda_1 of two starts at mu = 0.27; ceiling
    (a, w): the log likelihood that a candidate can reach at most, -inf where 0.27 is not chaotic; kept (2, m): indices
    of those followed to the end; evidence: of those."""

    alpha: np.ndarray
    omega: np.ndarray
    exponent: np.ndarray
    ceiling: np.ndarray
    kept: np.ndarray
    evidence: Evidence


@remembered
def plane(alpha_step=0.01, omega_step=0.0125, alphas=ALPHAS, omegas=OMEGAS, n=STARTS, few=2, **ensemble):
    """The evidence over a plane of candidates, less and less of them: those that are chaotic at mu = 0.27 from one of
    two starts, and of these such as can come within `REACH` of the best by what the two printed motions allow.

    alphas, omegas : first and last; ensemble : as for `evidence`. Raises ValueError for a step that is not positive.
    """
    axes = []
    for name, (first, last), step in (("alpha_step", alphas, alpha_step), ("omega_step", omegas, omega_step)):
        axes.append(np.round(np.arange(first, last + checks.positive(name, step) / 2, step), 6))
    alpha, omega = (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))
    exponent = runs(alpha, omega, (paper.MU_CHAOTIC,), n=2, **ensemble).exponent[0, 0].max(axis=0)
    (chaotic,) = np.nonzero(exponent > CHAOTIC)
    if chaotic.size == 0:
        raise ValueError(f"alphas = {alphas}, omegas = {omegas}: no candidate of this plane is chaotic at mu = 0.27")
    motions, ceiling = quoted(alpha[chaotic], omega[chaotic], n=n, **ensemble), np.full(alpha.size, -np.inf)
    ceiling[chaotic] = inference.ceiling(*motions)
    near = ceiling[chaotic] > ceiling.max() - REACH
    kept = chaotic[near]
    known = tuple(Runs(*(field[..., near] for field in each)) for each in motions)
    found = evidence(alpha[kept], omega[kept], few=few, known=known, **ensemble)
    shape = tuple(axis.size for axis in axes)
    return Plane(*axes, exponent.reshape(shape), ceiling.reshape(shape), np.array(np.unravel_index(kept, shape)), found)


def laid_out(plane, values):
    """Values (m,) of the candidates that were followed to the end, over the plane: (a, w), nan elsewhere."""
    cells = np.full(plane.exponent.shape, np.nan)
    cells[tuple(plane.kept)] = values
    return cells


def part(plane, omegas):
    """The candidates of a plane whose omega is one of some values: a Plane, nothing is computed again."""
    columns = np.flatnonzero(np.isclose(plane.omega[:, None], np.array(omegas)).any(axis=1))
    inside = np.isin(plane.kept[1], columns)
    kept = np.array([plane.kept[0][inside], np.searchsorted(columns, plane.kept[1][inside])])
    found = plane.evidence
    motions = [Runs(*(field[..., inside] for field in each)) for each in (found.chaotic, found.regular)]
    curves = {p: Curve(c.mu, c.exponent[..., inside], c.moving[..., inside]) for p, c in found.curves.items()}
    critical = {p: each[inside] for p, each in found.critical.items()}
    evidence = Evidence(found.alpha[inside], found.omega[inside], *motions, curves, critical)
    cells = plane.exponent[:, columns], plane.ceiling[:, columns]
    return Plane(plane.alpha, plane.omega[columns], *cells, kept, evidence)


def neighbourhood(pair, half=(0.0025, 0.00625), size=16, n=8, seed=SEED, **run):
    """The evidence of `size` pairs at random within `half` of the pair's alpha and omega."""
    shift = np.random.default_rng(seed).uniform(-1, 1, (2, checks.count("size", size)))
    return evidence(pair.alpha + half[0] * shift[0], pair.omega + half[1] * shift[1], n=n, seed=seed, **run)


def _family(alpha, omega, mu, p, n, distance, seed):
    alpha, omega = np.broadcast_arrays(np.atleast_1d(alpha), np.atleast_1d(omega))
    mu = np.broadcast_to(np.reshape(mu, (-1, 1, 1)), (np.size(mu), n, alpha.size))
    osc = Duffing(alpha=alpha, p=p, omega=omega, mu=mu)
    return osc, np.broadcast_to(starts(n, distance, seed)[:, None, :, None], (2, *osc.shape))


def _rows(osc, state, threads=None):
    """The seven rows of `Runs` for the members: (7, N)."""
    t = (np.arange(PARTS * paper.PERIODS + 1) / PARTS)[:, None] * osc.period
    orbit = integrate(osc, state, t, tangents=1, method="rk4", threads=threads)
    x, cut = orbit.states[0], PARTS * SETTLED
    late = paper.PERIODS - SETTLED
    exponent = [_sum(orbit.growth[0]) / paper.PERIODS, _sum(orbit.growth[0, cut:]) / late]
    changed = (x[1:] > 0) != (x[:-1] > 0)
    crossings = [changed[:cut].sum(axis=0), changed[cut:].sum(axis=0)]
    amplitude = [np.ptp(x[: cut + 1], axis=0) / 2, np.ptp(x[cut:], axis=0) / 2]
    points = orbit.states[:, ::PARTS][:, SETTLED:]
    apart = [np.hypot(*(points[:, q:] - points[:, :-q])).max(axis=0) for q in range(1, LONGEST + 1)]
    return np.array([*(e / osc.period for e in exponent), *crossings, *amplitude, np.min(apart, axis=0)])


def _companion_rows(osc, state, threads=None):
    growth = two_trajectory_growth(osc, state, paper.PERIODS, d0=D0, threads=threads)
    late = paper.PERIODS - SETTLED
    return np.array([_sum(growth) / paper.PERIODS, _sum(growth[SETTLED:]) / late]) / osc.period


def _sum(growth):
    return np.cumsum(growth, axis=0)[-1]  # the order of a member's sum must not depend on its company
