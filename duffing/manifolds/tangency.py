"""Where the manifolds of the saddle orbit touch: their splitting on the section v = 0, x > 0, and its first zero.

W^U (followed forward) and W^S (backward) first cross v = 0 near the outermost point of the right loop; each crossing
has a position and a phase. The difference of the two positions at equal phase is the splitting. To first order in alpha
and mu it is the Melnikov function M(t0), omega t0 = phase, divided by dH0/dx at the outermost point. A crossing counts
beyond the bottom of the well only, so that no turning point of the slow departure from the saddle orbit is mistaken.

For p < 1/2 W^S cannot be followed backward through a creep; `threshold` finds it forward, and the tangency with it.
"""

from dataclasses import replace

import numpy as np

from .. import checks
from ..errors import ConvergenceError
from ..flow import answered
from ..integrators.friction_time.turning_points import to_turning_point
from ..melnikov import critical_amplitude, forcing_integral
from . import threshold
from .curves import DISTANCE, STABLE, UNSTABLE, launch
from .passage import forward_frame
from .saddle import saddle_frame

METHODS = ("auto", "manifolds", "threshold")

_LAUNCHES = 32  # of W^U, all round, to make sure that the splitting found is the greatest
_ATTEMPTS = 60  # each of them, or the next, halves the bracket
_TOLERANCE = 1e-9  # relative, of the tangency
_LEAST = 1e-7  # of mu, dimensionless: the splitting, of the order of mu, is known to some 1e-14


def splitting(osc, phase, method="auto", on_failure="raise"):
    """x_u - x_s where W^U and W^S first cross v = 0 at the phase, on the right loop (x > 0): positive once they cross.

    osc : Duffing, a single oscillator or a family, delta < 0 < gamma
    phase : omega t modulo 2 pi of the crossing (radian), a number or (n,)
    method : "manifolds" follows W^S backward; "threshold" finds x_s forward, as what parts the orbits that fall back
        into the well from those that go over the hump; "auto" is "threshold" for members with p < 1/2 and damping
    on_failure : "raise", or "nan": members without an answer at one of the phases are NaN, and one warning says so

    Returns (*family) or (n, *family), a length. By symmetry the left loop has the same splitting half a period later.
    Raises ValueError for invalid input; NoSaddleOrbitError as `saddle_orbit` ("threshold": as `forward_frame`, which
    takes saddle orbits that stick); ConvergenceError where a manifold has no such crossing at a phase, or cannot be
    followed to it.
    """
    phase = np.asarray(checks.parameter("phase", phase))
    if phase.ndim > 1 or phase.size == 0:
        raise ValueError(f"phase has shape {phase.shape}: must be a number or a sequence of them")
    phases = np.mod(phase.ravel(), 2 * np.pi)

    def follow(part):
        frame = saddle_frame(part)
        return _split(frame, np.repeat(phases[:, None], frame.osc.mu.size, axis=1))[0]

    def part_orbits(part):
        return threshold.split(forward_frame(part), phases)

    def differences(members):
        part = osc.members(members)
        return _by_method(part, method, follow, part_orbits) * part.units()[0]

    checks.double_well(osc)
    checks.choice("method", method, METHODS)
    return answered(differences, osc, phases.shape, on_failure).reshape(phase.shape + osc.shape)[()]


def homoclinic_tangency(osc, method="auto", on_failure="raise"):
    """The forcing amplitude mu at which W^U and W^S first touch, (*family); osc.mu is not used.

    There the greatest splitting over all phases is zero. It is found to about 1e-9, relative (1e-14 / mu where mu, made
    dimensionless, is below 1e-5), starting from mu_c of Eq. 13. method, on_failure, errors : as for
    `splitting`.

    "manifolds": quasi-Newton steps of mu and of the phase, whose starting values are Melnikov's; then the splitting is
    computed all round to make sure that no other phase is ahead. "threshold": where the first orbit of W^U goes over
    the hump: the sign change nearest mu_c that the search meets; a smaller one is not excluded. No derivative is taken.
    Raises ConvergenceError also where mu is too small for doubles, and where the splitting jumps instead of vanishing.
    """

    def amplitudes(members):
        part = osc.members(members)
        unit = part.dimensionless().members()
        mu = np.array(critical_amplitude(unit))
        if np.any(mu < _LEAST):
            raise ConvergenceError(
                f"{unit.named(mu.argmin())}: mu = {mu.min():.1e} (dimensionless) at the tangency is too small for "
                "doubles"
            )
        return _by_method(replace(unit, mu=mu), method, _contact, threshold.tangency) * part.units()[2]

    checks.double_well(osc)
    checks.choice("method", method, METHODS)
    if not np.all(osc.columns()[0] > 0):
        raise ValueError(
            f"alpha = {osc.alpha}: must be > 0 for a tangency (at alpha = 0 the manifolds meet for every mu)"
        )
    return answered(amplitudes, osc, (), on_failure).reshape(osc.shape)[()]


def _by_method(osc, method, manifolds, forward):
    """Values (..., N) of the N members, each by the function of its method."""
    creeps = (osc.p < 0.5) & (osc.alpha > 0) if method == "auto" else np.full(osc.mu.size, method == "threshold")
    values = None
    for function, which in ((manifolds, ~creeps), (forward, creeps)):
        if which.any():
            part = function(osc.members(which))
            values = np.empty((*part.shape[:-1], osc.mu.size)) if values is None else values
            values[..., which] = part
    return values


def _contact(unit):
    """mu (N,) at which the greatest splitting is zero, near the family's own mu (N,)."""
    mu, phase = unit.mu, np.full(unit.mu.size, np.pi / 2)
    for _ in range(4):
        mu, phase = _touch(unit, mu, phase)
        height, ahead = _highest(saddle_frame(replace(unit, mu=mu)))
        behind = height < 1e-6 * mu
        if behind.all():
            return mu
        phase = np.where(behind, phase, ahead)
    raise ConvergenceError(f"mu = {mu}: other phases keep coming ahead in the search for the first tangency")


def _touch(unit, mu, phase):
    """mu and phase (N,) at which splitting and its slope are zero."""
    rate = _height(unit)  # d splitting / d mu, to begin with Melnikov's
    curvature = -rate * mu
    last = None
    for _ in range(30):
        value, slope = (a[0] for a in _split(saddle_frame(replace(unit, mu=mu)), phase[None]))
        if last is not None:
            # Secants. A step too small to measure a derivative leaves it alone.
            moved = np.abs(phase - last[1]) > 1e-6
            secant = (slope - last[3]) / np.where(moved, phase - last[1], 1)
            curvature = np.where(moved & (secant < curvature / 3) & (secant > 3 * curvature), secant, curvature)
        top = value - slope**2 / (2 * curvature)  # of the parabola through it
        if last is not None:
            moved = np.abs(mu - last[0]) > 1e-6 * mu
            secant = (top - last[2]) / np.where(moved, mu - last[0], 1)
            rate = np.where(moved & (secant > rate / 3) & (secant < 3 * rate), secant, rate)
        last = mu, phase, top, slope
        step = -top / rate
        mu, phase = mu + np.clip(step, -0.3 * mu, 0.3 * mu), phase - np.clip(slope / curvature, -0.5, 0.5)
        if np.all((np.abs(step) < _TOLERANCE * mu) & (np.abs(slope / curvature) < 1e-5)):
            return mu, phase
    raise ConvergenceError(f"mu = {mu}: the search for the tangency did not settle within 30 steps")


def _highest(frame):
    """Greatest splitting (N,) and its phase among launches of W^U all round: also where the phase at which it crosses
    goes back and forth along W^U, so that the splitting is no function of the phase."""
    size = frame.osc.mu.size
    member = np.tile(np.arange(size), _LAUNCHES)
    t = frame.osc.period[member] * np.repeat(np.arange(_LAUNCHES), size) / _LAUNCHES
    found = _follow(frame, UNSTABLE, t, member)[0]
    phase = frame.osc.omega[member] * found.t
    height = (found.x - _crossing(frame, STABLE, phase, member)[0]).reshape(_LAUNCHES, size)
    best = height.argmax(axis=0), np.arange(size)
    return height[best], phase.reshape(_LAUNCHES, size)[best]


def _split(frame, phase):
    """Splitting and its derivative by the phase, (n, N) each, at the phases (n, N)."""
    member = np.broadcast_to(np.arange(phase.shape[1]), phase.shape).ravel()
    unstable, stable = (_crossing(frame, kind, phase.ravel(), member) for kind in (UNSTABLE, STABLE))
    return (unstable - stable).reshape(2, *phase.shape)


def _crossing(frame, kind, phase, member):
    """Position x and dx / dphase, (2, n), of the first crossing of v = 0, x > 1 by W^U or W^S at the phases (n,).

    Newton's method for the time of the launch, kept within a bracket: the time of crossing grows with it by a period a
    period. What is left of the error in phase is taken out to first order.
    """
    omega, period = frame.osc.omega[member], frame.osc.period[member]
    # Along the unperturbed loop it takes log(4 / DISTANCE) to the outermost point.
    flight = np.log(4 / DISTANCE)
    t = phase / omega - (flight if kind == UNSTABLE else -flight)
    low, high = t - period, t + period
    goal, result = phase / omega, np.empty((2, phase.size))
    left, missed = np.arange(phase.size), np.full(phase.size, np.inf)
    for attempt in range(_ATTEMPTS):
        found, shift, delay = _follow(frame, kind, t[left], member[left])
        if attempt == 0:
            goal = goal + period * np.round((found.t - goal) / period)
        early = goal[left] - found.t
        slope = shift / np.where(delay == 0, 1, delay)
        result[:, left] = found.x + slope * early, slope / omega[left]
        low[left], high[left] = np.where(early > 0, t[left], low[left]), np.where(early > 0, high[left], t[left])
        newton = t[left] + early / np.where(delay > 0, delay, 1e-300)
        # Newton's steps alone can go to and fro between two points for ever.
        gains = (newton > low[left]) & (newton < high[left]) & (np.abs(early) < missed[left] / 2)
        done, missed[left] = np.abs(early * omega[left]) < 1e-6, np.abs(early)
        t[left] = np.where(gains, newton, (low[left] + high[left]) / 2)
        left = left[~done]
        if left.size == 0:
            return result
    raise ConvergenceError(
        f"{frame.osc.named(member[left[0]])}: {('W^U', 'W^S')[kind]} has no first crossing of v = 0, x > 1 "
        f"(dimensionless) at the phase {phase[left[0]]:g}"
    )


def _follow(frame, kind, t, member):
    """The crossing that follows from the launch at about the times t (n,): TurningPoint, dx / dt, dt_crossing / dt."""
    start, state, rate = launch(frame, kind, t, member)
    direction = 1 if kind == UNSTABLE else -1
    found = to_turning_point(frame.osc.members(member), state, start, direction=direction, beyond=1.0, derivatives=True)
    return found, (rate * found.dx).sum(axis=0), (rate * found.dt).sum(axis=0)


def _height(unit):
    """d splitting / d mu of the Melnikov function at its greatest: forcing integral over dH0/dx at x = sqrt(2)."""
    return forcing_integral(unit) / np.sqrt(2)
