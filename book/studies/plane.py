"""Where chaos between the wells lasts, over the plane of parameters: its three borders, computed, and brute force."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import checks
from duffing.errors import ConvergenceError
from duffing.flow import integrate
from duffing.lyapunov import lyapunov_spectrum
from duffing.melnikov import critical_amplitude
from duffing.oscillator import Duffing
from duffing.transients.crisis import beyond, crisis_above, large_saddle, saddles
from duffing.transients.lifetimes import lifetimes

from ..paper import LIKELY
from ..remember import remembered
from .accuracy import CURVES, integrator
from .cascade import CHAOTIC, cascade, small_folds
from .transients import starts_between_wells

# Pairs (alpha, omega): the likely ones, the adopted one first, and three more of the plane, less likely by the text.
PAIRS = (*((pair.alpha, pair.omega) for pair in LIKELY), (0.14, 1.05), (0.16, 1.175), (0.05, 1.3))
EXPONENTS = (0.1, 1.0)
STEPS = 128  # Runge-Kutta steps a period where the damping is smooth: of chaos only the attractor is meant
BELOW = 0.05  # under the fold, where the search for a crisis begins
POINTS = 200  # on a fundamental domain of W^U


def oscillators(alpha, omega, p, mu):
    """A family (n,) of the arguments, which broadcast."""
    return Duffing(*(np.ravel(part) for part in np.broadcast_arrays(alpha, p, mu, omega)))


class Borders(NamedTuple):
    """The borders of lasting chaos between the wells for n oscillators, forcing amplitudes (n,).

    critical : mu_c of Eq. 13; fold : the end of the small orbits in the wells; inside : the accumulation of the
    doublings of the large in-well orbit; crisis : chaos reaches the basin of the large orbit
    """

    critical: np.ndarray
    fold: np.ndarray
    inside: np.ndarray
    crisis: np.ndarray


@remembered
def borders(alpha, omega, p, points=POINTS, steps=4):
    """The Borders of the oscillators with one p; alpha and omega broadcast. steps : of bisection, from 0.02.

    The crisis is looked for from BELOW the fold on, infinite if it is not met within 0.3.
    """
    fold = small_folds(alpha, omega, p)
    alpha, omega = (np.ravel(part) for part in np.broadcast_arrays(alpha, omega))
    family = oscillators(alpha, omega, p, fold - BELOW)
    starts = np.array([_first_saddle(family.members(k)) for k in range(fold.size)]).T
    found = crisis_above(family, starts[0], starts[1:], steps=steps, points=points, **integrator(p, CURVES, 200))
    inside = cascade(tuple(alpha), tuple(omega), p).accumulation
    return Borders(critical_amplitude(family), fold, inside, found)


@remembered
def leaks_at_fold(alpha, omega, p, points=POINTS):
    """Whether chaos has reached the large orbit's basin already where the small orbits end: boolean (n,), the sign of
    fold - crisis. Where there is no large saddle orbit yet there is nothing to reach. p : one number."""
    fold = small_folds(alpha, omega, p)
    family = oscillators(alpha, omega, p, fold)
    found, outer = np.zeros(fold.size, dtype=bool), np.empty((2, fold.size))
    exists = np.ones(fold.size, dtype=bool)
    for k in range(fold.size):
        try:
            outer[:, k] = large_saddle(family.members(k))
        except ConvergenceError:
            exists[k] = False
    some = np.flatnonzero(exists)
    if some.size:
        part = family.members(some)
        found[some] = beyond(part, saddles(part, outer[:, some]), points=points, **integrator(p, CURVES, 200))
    return found


@remembered
def apex(alpha, p, reach=0.04, halvings=4, points=POINTS):
    """The frequencies (n,) at which fold and crisis change places, for alphas (n,) and one p, by bisection between
    1.1 - alpha - reach and 1.1 - alpha + reach: right within reach / 2^halvings.

    Raises ConvergenceError naming the first alpha for which they do not change places there.
    """
    alpha = np.array(alpha, dtype=float)
    low, high = 1.1 - alpha - reach, 1.1 - alpha + reach
    ends = [leaks_at_fold(tuple(alpha), tuple(end), p, points) for end in (low, high)]
    wrong = ~(ends[0] & ~ends[1])
    if wrong.any():
        raise ConvergenceError(f"alpha = {alpha[wrong][0]:g}, p = {p:g}: fold and crisis keep their order")
    for _ in range(checks.count("halvings", halvings)):
        middle = (low + high) / 2
        leaks = leaks_at_fold(tuple(alpha), tuple(middle), p, points)
        low, high = np.where(leaks, middle, low), np.where(leaks, high, middle)
    return (low + high) / 2


class Lasting(NamedTuple):
    """What initial conditions between the wells do after many periods, for n oscillators.

    across (n,) : share of them in chaos that crosses x = 0; inside (n,) : in chaos within one well
    exponent, error (n,) : the mean of lambda_1 over the former and one standard error of it, nan where there are none
    """

    across: np.ndarray
    inside: np.ndarray
    exponent: np.ndarray
    error: np.ndarray


@remembered
def lasting(alpha, omega, p, mu, columns=4, rows=2, periods=800, last=150):
    """The Lasting of columns x rows initial conditions: lambda_1 over the `last` periods after `periods` of those that
    have not settled by then. alpha, omega and mu broadcast; p : one number."""
    osc, state = oscillators(alpha, omega, p, mu), 1.2 * starts_between_wells(columns, rows)
    n, m = osc.columns().shape[1], state.shape[1]
    wide, options = osc.repeated(m), integrator(p, steps_per_period=STEPS)
    lived = lifetimes(wide, np.tile(state, n), periods, **options)
    exponent, crosses = np.full(n * m, np.nan), np.zeros(n * m, dtype=bool)
    left = np.flatnonzero(~lived.settled)
    if left.size:
        part = wide.members(left)
        end = lived.end[:, left]
        exponent[left] = lyapunov_spectrum(part, end, last, 0, k=1, history=False, **options).exponents[0]
        t = np.arange(40 * 16 + 1)[:, None] / 16 * part.period
        x = integrate(part, end, t, **options).states[0]
        crosses[left] = (x.min(axis=0) < 0) & (x.max(axis=0) > 0)
    chaotic = (np.nan_to_num(exponent, nan=-1.0) > 2 * CHAOTIC).reshape(n, m)
    crosses, exponent = crosses.reshape(n, m) & chaotic, exponent.reshape(n, m)
    return Lasting(crosses.mean(axis=1), (chaotic & ~crosses).mean(axis=1), *_mean(exponent, crosses))


@remembered
def region(field, values, mu, p, alpha=0.1, omega=1.0, **sizes):
    """The Lasting over a plane, parts (len(mu), len(values)): of the field "alpha" or "omega" and mu."""
    checks.choice("field", field, ("alpha", "omega"))
    other = {"alpha": alpha, "omega": omega}
    grid = [part.ravel() for part in np.meshgrid(values, mu)]
    other[field] = tuple(grid[0])
    found = lasting(other["alpha"], other["omega"], p, tuple(grid[1]), **sizes)
    return Lasting(*(part.reshape(len(mu), len(values)) for part in found))


def agreement(grid, mu, across, values, found):
    """How brute force and the borders agree: of the cells with lasting chaos, the part between the borders (within one
    cell's height); of the cells between them, the part with lasting chaos.

    grid (n,), mu (m,), across (m, n) : of a `region`; values (k,) : of the lines; found : their Borders
    """
    columns = (np.array(grid) >= min(values)) & (np.array(grid) <= max(values))
    x = np.array(grid)[columns]
    fold, inside, crisis = (np.interp(x, values, line) for line in (found.fold, found.inside, found.crisis))
    lower, rows = np.maximum(fold, inside), np.array(mu)[:, None]
    chaotic, height = across[:, columns] > 0, rows[1, 0] - rows[0, 0]
    near = (rows > lower - height) & (rows < crisis + height)
    within = (rows > lower) & (rows < crisis)
    return float(near[chaotic].mean()), float(chaotic[within].mean())


class Compared(NamedTuple):
    """lambda_1 of lasting chaos at p = 0.1 against p = 1 under one pair (alpha, omega).

    forcings : at which half of the initial conditions or more are chaotic at both; smaller : at how many of these
    lambda_1 is smaller at p = 0.1; difference, error : its mean there, p = 0.1 less p = 1; first : of each p, the least
    forcing with such chaos, and its multiple of mu_c, nan where there is none
    """

    forcings: int
    smaller: int
    difference: float
    error: float
    first: np.ndarray


@remembered
def compared(pair, mu, **sizes):
    """The Compared of a pair over the forcings mu; sizes : as for `lasting`."""
    alpha, omega = pair
    found = [lasting(alpha, omega, p, tuple(mu), **sizes) for p in EXPONENTS]
    chaotic = [one.across >= 0.5 for one in found]
    both = chaotic[0] & chaotic[1]
    first = np.full((2, 2), np.nan)
    for k, (p, one) in enumerate(zip(EXPONENTS, chaotic, strict=True)):
        if one.any():
            start = np.array(mu)[one][0]
            first[k] = start, start / critical_amplitude(Duffing(alpha=alpha, p=p, omega=omega))
    if not both.any():
        return Compared(0, 0, np.nan, np.nan, first)
    change = (found[0].exponent - found[1].exponent)[both]
    error = change.std(ddof=1) / np.sqrt(change.size) if change.size > 1 else np.inf
    return Compared(int(both.sum()), int((change < 0).sum()), float(change.mean()), float(error), first)


def _first_saddle(osc, step=0.02, tries=25):
    """The least forcing, from that of the oscillator on, with a large saddle orbit, and its state: three numbers.

    Raises ConvergenceError where there is none.
    """
    for number in range(tries):
        one = replace(osc, mu=osc.mu + number * step)
        try:
            return one.mu, *large_saddle(one)
        except ConvergenceError:
            continue
    raise ConvergenceError(f"mu = {osc.mu:g} to {one.mu:g}: no large saddle orbit was found")


def _mean(value, chosen):
    """Mean (n,) over the chosen of each row and one standard error; nan where none is, infinite for one."""
    count = chosen.sum(axis=1)
    safe = np.maximum(count, 1)
    mean = np.where(chosen, value, 0.0).sum(axis=1) / safe
    off = np.where(chosen, value - mean[:, None], 0.0)
    error = np.sqrt((off**2).sum(axis=1) / np.maximum(count - 1, 1) / safe)
    return np.where(count > 0, mean, np.nan), np.where(count > 1, error, np.where(count > 0, np.inf, np.nan))
