"""The paper's sweep of lambda_1: Runge-Kutta with 500 steps a period, state and one tangent, many mu, on one thread.

Everybody starts as the paper does, and is compared after three forcing periods. Who has the same scheme must give the
answer of the textbook's NumPy loop; solvers with a tolerance of their own, the flow's as the package knows it at 1e-13.
"""

import numpy as np

from duffing import paper
from duffing.integrators import rk4
from duffing.integrators.friction_time import adaptive as friction

from . import peers, rewrites
from .harness import Contestant, agreement, compare
from .rewrites import COMPARED

PERIODS = 30  # of the fast, so that what a call costs once does not count
# Of (x, v, growth): round-off magnified by three periods of chaos, and a tolerance of 1e-8 a step magnified likewise.
SAME_SCHEME = (1e-9, 1e-9, 1e-6)
SAME_FLOW = (1e-5, 1e-5, 1e-3)
SOLVER = "SciPy solve_ivp"


def family(p, size):
    """The paper's oscillator at `size` amplitudes, in and around the chaos of its Fig. 4."""
    return type(paper.OSCILLATOR)(alpha=paper.OSCILLATOR.alpha, p=p, mu=np.linspace(0.2, 0.3, size))


def kernel(osc, periods):
    """The package's; the answer is that after the first COMPARED periods."""
    t = osc.period * np.arange(periods + 1)

    def run():
        orbit = rk4.integrate(osc, rewrites.START, t, tangents=1, threads=1)
        return np.array([*orbit.states[:, COMPARED], orbit.growth[0, :COMPARED].sum(axis=0)])

    return run


def flow(osc):
    """(x, v, growth) after COMPARED periods without the error of the paper's step."""
    t = osc.period * np.arange(COMPARED + 1)
    orbit = friction.integrate(osc, rewrites.START, t, tangents=1, rtol=1e-13, atol=1e-15)
    return np.array([*orbit.states[:, -1], orbit.growth[0].sum(axis=0)])


def contestants(p, size):
    """(the kernel, all others). The slow have fewer members and periods: time counts for a trajectory and period."""

    def enter(name, prepare, members, periods, expected, tolerance):
        osc = family(p, members)
        check = lazily(lambda: expected(osc), tolerance)
        return Contestant(name, lambda: prepare(osc, periods), members * periods, check)

    def scheme(name, prepare, members, periods=COMPARED, direction=(1.0, 0.0)):
        def expected(osc):
            return rewrites.numpy(osc, COMPARED, direction)()

        return enter(name, prepare, members, periods, expected, SAME_SCHEME)

    def solver(name, prepare, members):
        return enter(name, prepare, members, COMPARED, flow, SAME_FLOW)

    others = [
        *(solver(f"{SOLVER}, {method}", peers.scipy(method), 2) for method in ("LSODA", "DOP853")),
        scheme("pynamicalsys, rk4", peers.pynamicalsys, 8, direction=peers.pynamicalsys_direction()),
        solver("jitcode_lyap, dopri5", peers.jitcode, 8),
        scheme("NumPy, all members at once", rewrites.numpy, size),
        scheme("diffrax, constant step, jit", peers.diffrax, size, 2 * COMPARED),
        scheme("numba, plain scalar loop", rewrites.scalar, max(size // 8, 1), 2 * COMPARED),
        solver("heyoka, batch mode", peers.heyoka, size),
        scheme("C over lanes, gcc with libmvec", rewrites.lanes_in_c, size, PERIODS),
    ]
    return scheme("kernel", kernel, size, PERIODS), others


def lazily(expected, tolerance):
    """An `agreement` with what expected() returns; it is computed when it is first asked for."""
    known = []

    def check(answer):
        if not known:
            known.append(agreement(expected(), tolerance))
        return known[0](answer)

    return check


def measure(p, rounds, size=512):
    """Results of `compare` for one p: ratios to the kernel's time for a trajectory and period."""
    return compare(*contestants(p, size), rounds)
