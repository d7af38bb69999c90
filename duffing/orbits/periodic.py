"""Periodic orbits by Newton's method on the stroboscopic map, and their Floquet multipliers.

The equation of motion does not change under (x, v, t) -> (-x, -v, t + pi/omega). So half a forcing period followed by
the change of sign is a map of the plane to itself, the *half map* N, and the stroboscopic map is N N. All orbits of
interest are fixed points of a power of N:

    N^k (state) = state,   k = `halves`:   x(t + k T/2) = (-1)^k x(t).

An even k = 2n gives the orbits of period n T, an odd one the symmetric orbits of period k T, each its own mirror image.
A symmetric orbit's multipliers over its period are the squares of those of N^k, which tell more: +1 is a fold, -1 the
breaking of the symmetry, where over the whole period both are +1.
"""

from typing import NamedTuple

import numpy as np

from .. import checks
from ..errors import ConvergenceError
from ..flow import integrate

_STEPS = 25
_LONGEST = 0.3  # a Newton step is cut to this length
_FAR = 5.0  # no orbit is looked for beyond, nor beyond twice the guess where that is farther


class Return(NamedTuple):
    """What N^k does to N states: image (2, N), derivative (2, 2, N) and log_area (N,), the logarithm of its
    determinant, -alpha times the friction time; -inf where a creep annihilates a tangent direction."""

    image: np.ndarray
    derivative: np.ndarray
    log_area: np.ndarray


class PeriodicOrbit(NamedTuple):
    """state (2, *family) : x and v at phase 0; multipliers (2, *family) : complex, those of N^k, the larger modulus
    first. The smaller one is exactly 0 where the orbit sticks: where it creeps through zero force, p <= 1/2."""

    state: np.ndarray
    multipliers: np.ndarray


def half_period_map(osc, state, halves=2, **options):
    """The map N^k, k = halves, at the states (2,) or (2, *family) at phase 0: a Return over N members.

    halves : a whole number >= 1, or (N,) of them; options : as for `duffing.flow.integrate`
    """
    state = checks.state(state, checks.model(osc).shape)
    halves = checks.counts("halves", halves, state.shape[1])
    period = np.broadcast_to(osc.period, osc.shape).ravel()
    t = np.array([np.zeros_like(period), halves * period / 2])
    orbit = integrate(osc, state, t, tangents=2, **options)
    sign = (-1) ** halves
    log_area = -osc.columns()[0] * np.where(osc.columns()[0] > 0, orbit.friction_time[0], 0.0)
    return Return(sign * orbit.states[:, 1], sign * orbit.propagators[:, :, 0], log_area)


def multipliers_of(found):
    """Multipliers (2, N) of a Return, complex, the larger modulus first; the smaller one by Liouville's theorem."""
    mean = (found.derivative[0, 0] + found.derivative[1, 1]) / 2
    area = np.exp(found.log_area)
    root = np.sqrt(mean**2 - area + 0j)
    larger = mean + np.where(mean >= 0, root, -root)
    # It is less than the larger one: zero where even that is no normal number any more.
    known = np.abs(larger) >= np.finfo(float).tiny
    return np.array([larger, np.divide(area, larger, out=np.zeros_like(larger), where=known)])


def periodic_orbit(osc, state, halves=2, **options):
    """The orbit with N^k (state) = state, k = halves, near the guess: a PeriodicOrbit, to the tolerance's accuracy.

    osc : Duffing, a single oscillator or a family; state : guesses (2,) or (2, *family) at phase 0
    options : as for `duffing.flow.integrate`

    Raises ValueError for invalid input, ConvergenceError naming the first member that Newton's method does not solve.
    """
    guess, flat = checks.state(state, checks.model(osc).shape), osc.members()
    state, found = _newton(flat, guess, halves, options)
    if not found.all():
        bad = np.argmin(found)
        raise ConvergenceError(
            f"{osc.named(bad)}: Newton's method finds no orbit with halves = {halves} from {guess[:, bad]}"
        )
    multipliers = multipliers_of(half_period_map(flat, state, halves, **options))
    return PeriodicOrbit(state.reshape(2, *osc.shape), multipliers.reshape(2, *osc.shape))


def periodic_orbits(osc, starts, halves=2, apart=1e-5, **options):
    """All different orbits that Newton's method reaches from the starts (2, M): a PeriodicOrbit with states (2, n).

    osc : a single oscillator. Points of the same orbit count once, by the one with the greatest x; an orbit that
    closes already after a part of `halves` does not count. Sorted by x. There may be none: n = 0. No search from a
    finite number of starts can promise to be complete.
    """
    starts, halves = checks.starts(starts), checks.count("halves", halves)
    checks.positive("apart", apart)
    state, found = _newton(checks.single(osc).repeated(starts.shape[1]), starts, halves, options)
    state = state[:, found]
    keep = []
    if not found.any():
        return PeriodicOrbit(np.empty((2, 0)), np.empty((2, 0), dtype=complex))
    for points in np.moveaxis(cycle(osc.repeated(found.sum()), state, halves, **options), -1, 0):
        parts = [k for k in range(1, halves) if halves % k == 0]
        if any(np.max(np.abs(points[:, k] - points[:, 0])) < apart for k in parts):
            continue
        own = points[:, :: 2 if halves % 2 == 0 else 1]  # an odd power of N is the mirror image's, if they differ
        top = own[:, np.argmax(own[0])]
        if all(np.max(np.abs(top - other)) > apart for other in keep):
            keep.append(top)
    chosen = np.array(sorted(keep, key=lambda point: point[0])).reshape(-1, 2).T
    if not keep:
        return PeriodicOrbit(chosen, np.empty((2, 0), dtype=complex))
    family = osc.repeated(len(keep))
    return PeriodicOrbit(chosen, multipliers_of(half_period_map(family, chosen, halves, **options)))


def cycle(osc, state, halves=2, **options):
    """Points N^j (state), j = 0 ... halves - 1, of each orbit: (2, halves, *family).

    For an odd number they are the orbit's stroboscopic points; for an even one those with even j are, and those with
    odd j are the points of its mirror image.
    """
    states = path(osc, state, halves, checks.count("halves", halves), **options)[:, :-1]
    signs = np.array([1, -1] * halves)[:halves]
    return states * signs.reshape(-1, *[1] * len(osc.shape))


def path(osc, state, halves=2, samples=200, **options):
    """The orbits through the states (2, *family) at phase 0, over `halves` half periods: (2, samples + 1, *family)."""
    state, halves = checks.state(state, checks.model(osc).shape), checks.count("halves", halves)
    period = np.broadcast_to(osc.period, osc.shape).ravel()
    t = np.linspace(np.zeros_like(period), halves * period / 2, checks.count("samples", samples) + 1)
    states = integrate(osc, state, t, **options).states
    return states.reshape(2, samples + 1, *osc.shape)


def _newton(osc, guess, halves, options):
    """Refined states (2, N) and whether each member converged; steps are cut to a length."""
    state, found, live = guess.copy(), np.zeros(guess.shape[1], dtype=bool), np.arange(guess.shape[1])
    far = np.maximum(_FAR, 2 * np.max(np.abs(guess), axis=0))
    for _ in range(_STEPS):
        image, derivative, _ = half_period_map(osc.members(live), state[:, live], halves, **options)
        step = _solve(derivative - np.eye(2)[:, :, None], state[:, live] - image)
        length = np.hypot(*step)
        state[:, live] += step * np.minimum(1, _LONGEST / np.maximum(length, _LONGEST))
        found[live[length < 1e-9]] = True
        live = live[(length >= 1e-9) & (np.max(np.abs(state[:, live]), axis=0) < far[live])]
        if live.size == 0:
            break
    return state, found


def _solve(matrix, right):
    """Solutions (2, N) of N systems of two equations; of a singular one, a step too long to be believed."""
    (a, b), (c, d) = matrix
    area = a * d - b * c
    area = np.where(np.abs(area) < 1e-300, 1e-300, area)
    return np.array([d * right[0] - b * right[1], a * right[1] - c * right[0]]) / area
