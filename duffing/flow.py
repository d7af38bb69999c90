"""Solutions of the equation of motion: chooses the integrator, and is what the other modules call."""

import numpy as np

from . import checks
from .integrators import rk4

METHODS = ("auto", "rk4", "friction")
POLICIES = ("raise", "nan")  # where a member of a family has no answer
RK4_OPTIONS = ("steps_per_period", "threads")
FRICTION_OPTIONS = ("rtol", "atol", "max_steps", "switch", "threads")


def integrate(osc, state, t, tangents=0, method="auto", **options):
    """Carry the family from its states at t[0] through the times t, with 0, 1 or 2 tangent vectors.

    osc : Duffing, a family of N members
    state : (2,) for all members or (2, *family)
    t : (n,) times for all members or (n, N), one column a member
    method : "rk4", the paper's algorithm (option steps_per_period=500); "friction", the adaptive integrator of order
        eight, in friction time unless the damping is smooth in v (p = 1, 3, 5 ...); "auto" is "friction"
    options : of the integrator: of rk4 steps_per_period, else rtol=1e-10, atol=1e-12, max_steps, switch; threads

    Returns a `Solution`. Raises ValueError for invalid input, DivergedError or ConvergenceError for no answer.
    """
    checks.model(osc)
    checks.choice("method", method, METHODS)
    if method == "rk4":
        integrator, allowed = rk4, RK4_OPTIONS
    else:  # imported when it is called for: all figures of the paper but Fig. 2 are drawn without it
        from .integrators.friction_time import adaptive as integrator

        allowed = FRICTION_OPTIONS
    for name in options:
        checks.choice(f"an option of method {method!r}", name, allowed)
    return integrator.integrate(osc, state, t, tangents=tangents, **options)


def trajectory(osc, state, t, method="auto", on_failure="raise", **options):
    """States at the increasing times t: array (2, len(t), *family) of x and v; the state given is the one at t[0].

    state : (2,) for all members or (2, *family)
    on_failure : "raise", or "nan": members that diverge or do not converge are NaN, and one warning says so
    method, options, errors : as for `duffing.flow.integrate`
    """
    checks.model(osc)
    t = checks.times(t)
    state = checks.state(state, osc.shape)

    def states(members):
        return integrate(osc.members(members), state[:, members], t, 0, method, **options).states

    return answered(states, osc, (2, t.size), on_failure).reshape(2, t.size, *osc.shape)


def answered(function, osc, rows, on_failure):
    """function(members) for all N members of a family: array (*rows, N); on_failure : "raise", or "nan".

    function : takes a slice or an index array (n,) of members, returns an array (*rows, n) or raises a DuffingError
    """
    if checks.choice("on_failure", on_failure, POLICIES) == "raise":
        return function(slice(None))
    from .sweep.failures import answers  # when it is asked for

    return answers(function, osc, rows)


def stroboscopic_times(osc, periods, transient=0, phase=0.0):
    """Times (periods + 1, N) at which each member's forcing has the phase, from the end of the transient on.

    transient, periods : whole numbers of forcing periods; phase : omega t modulo 2 pi (radian)
    """
    cycles = checks.count("transient", transient, least=0) + np.arange(checks.count("periods", periods) + 1)
    phase = checks.number("phase", phase)
    return (phase + 2 * np.pi * cycles)[:, None] / osc.columns()[3]
