"""Other people's software on the same work: each function prepares and returns run().

What can be prepared is prepared: compiling is not timed. The answer is some last rows of (x, v, growth) (3, N) after
all the periods, unless it says otherwise.
"""

import math
from functools import cache

import numpy as np
from scipy.integrate import solve_ivp

from .rewrites import COMPARED, START, STEPS

SEED = 13  # of pynamicalsys's first tangent


def slopes(osc, mu):
    """(right side for the state, right side for state and tangent) of one member, in Python's own numbers."""
    alpha, p, omega = float(osc.alpha), float(osc.p), float(osc.omega)

    def state(t, y):
        x, v = y.tolist()
        power = 1.0 if p == 1.0 or v == 0.0 else abs(v) ** (p - 1.0)
        return v, mu * math.cos(omega * t) + x - x**3 - alpha * power * v

    def both(t, y):
        x, v, xi, eta = y.tolist()
        power = 1.0 if p == 1.0 or v == 0.0 else abs(v) ** (p - 1.0)
        a = mu * math.cos(omega * t) + x - x**3 - alpha * power * v
        return v, a, eta, (1.0 - 3.0 * x**2) * xi - alpha * p * power * eta

    return state, both


def scipy(method, rtol=1e-8, atol=None, tangent=True):
    """SciPy's solve_ivp, one member after another, never renormalised; tangent=False : no growth is returned."""

    def prepare(osc, periods):
        span, start = (0, periods * osc.period), (*START, 1.0, 0.0) if tangent else START

        def run():
            ends = []
            for mu in osc.mu.tolist():
                slope = slopes(osc, mu)[tangent]
                flight = solve_ivp(slope, span, start, method, rtol=rtol, atol=rtol if atol is None else atol)
                if not flight.success:
                    raise ArithmeticError(f"gives up after {flight.t[-1] / osc.period:.2f} periods, {flight.message}")
                y = flight.y[:, -1]
                ends.append((*y[:2], math.log(math.hypot(*y[2:]))) if tangent else y)
            return np.array(ends).T

        return run

    return prepare


def pynamicalsys_direction():
    """The tangent that pynamicalsys starts with: it draws from the legacy stream."""
    direction = 2 * np.random.RandomState(SEED).rand(2) - 1
    return direction / np.hypot(*direction)


@cache
def _pynamicalsys():
    """The system, with its compiled code: half a minute, so it is kept for every p."""
    from numba import njit
    from pynamicalsys import ContinuousDynamicalSystem

    @njit
    def motion(t, u, q):
        power = 1.0 if q[2] == 1.0 else abs(u[1]) ** (q[2] - 1.0)
        return np.array([u[1], q[0] * np.cos(q[3] * t) + u[0] - u[0] ** 3 - q[1] * power * u[1]])

    @njit
    def jacobian(t, u, q):
        power = 1.0 if q[2] == 1.0 else abs(u[1]) ** (q[2] - 1.0)
        return np.array([[0.0, 1.0], [1.0 - 3.0 * u[0] ** 2, -q[1] * q[2] * power]])

    return ContinuousDynamicalSystem(
        equations_of_motion=motion, jacobian=jacobian, system_dimension=2, number_of_parameters=4
    )


def pynamicalsys(osc, periods):
    """Its maximum Lyapunov exponent with rk4 at the same step; it returns no state. From `pynamicalsys_direction`."""
    system, total = _pynamicalsys(), periods * osc.period
    system.integrator("rk4", time_step=osc.period / STEPS)

    def run():
        q = [[mu, osc.alpha, osc.p, osc.omega] for mu in osc.mu]
        options = {"num_exponents": 1, "endpoint": False, "seed": SEED}
        return np.array([[total * system.lyapunov(START, total, parameters=row, **options) for row in q]])

    return run


def diffrax(osc, periods):
    """The same scheme under jit: diffeqsolve with a constant step for each period, all members as one array.

    (vmap over the members is slower.) The answer is that after the first COMPARED periods.
    """
    import diffrax as dfx
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    half, none = np.array([0.5]), np.zeros(4)
    table = dfx.ButcherTableau(
        a_lower=(half, np.array([0.0, 0.5]), np.array([0.0, 0.0, 1.0])),
        b_sol=np.array([1, 2, 2, 1]) / 6,
        b_error=none,
        c=np.array([0.5, 0.5, 1.0]),
    )

    class RungeKutta4(dfx.AbstractERK):
        tableau = table
        interpolation_cls = dfx.ThirdOrderHermitePolynomialInterpolation.from_k

        def order(self, terms):
            return 4

    def slope(t, y, mu):
        x, v, xi, eta = y
        power = jnp.abs(v) ** (osc.p - 1) if osc.p != 1 else 1.0
        a = mu * jnp.cos(osc.omega * t) + x - x**3 - osc.alpha * power * v
        return jnp.stack([v, a, eta, (1 - 3 * x**2) * xi - osc.alpha * osc.p * power * eta])

    def period(y, mu):
        y = dfx.diffeqsolve(
            dfx.ODETerm(slope),
            RungeKutta4(),
            0.0,
            osc.period,
            osc.period / STEPS,
            y,
            mu,
            stepsize_controller=dfx.ConstantStepSize(),
            saveat=dfx.SaveAt(t1=True),
            max_steps=STEPS + 2,
        ).ys[0]
        length = jnp.hypot(y[2], y[3])
        return y.at[2:].divide(length), jnp.log(length)

    @jax.jit
    def flight(mu):
        start = jnp.repeat(jnp.array([*START, 1.0, 0.0])[:, None], osc.mu.size, axis=1)
        y, growth = jax.lax.scan(lambda y, _: period(y, mu), start, None, COMPARED)
        after, _ = jax.lax.scan(lambda y, _: period(y, mu), y, None, periods - COMPARED)
        return jnp.stack([y[0], y[1], growth.sum(axis=0)]), after

    mu = jnp.asarray(osc.mu)
    return lambda: np.asarray(jax.block_until_ready(flight(mu))[0])


def jitcode(osc, periods):
    """jitcode_lyap, compiled C, with dopri5 at 1e-8, one member after another; from the tangent (1, 0)."""
    import symengine
    from jitcode import UnsuccessfulIntegration, jitcode_lyap, t, y

    mu = symengine.Symbol("mu")
    power = (y(1) ** 2) ** ((osc.p - 1) / 2) if osc.p != 1 else 1
    motion = [y(1), mu * symengine.cos(osc.omega * t) + y(0) - y(0) ** 3 - osc.alpha * power * y(1)]
    system = jitcode_lyap(motion, n_lyap=1, control_pars=[mu], verbose=False)
    system.compile_C()
    system.set_integrator("dopri5", rtol=1e-8, atol=1e-8)

    def run():
        ends = []
        for value in osc.mu:
            system.set_parameters(value)
            system.set_initial_value(np.array(START), 0.0)
            system._y[2:] = 1.0, 0.0  # instead of a random direction; there is no public way
            growth = 0.0
            for k in range(1, periods + 1):
                try:
                    state, rates, _ = system.integrate(k * osc.period)
                except UnsuccessfulIntegration:
                    raise ArithmeticError(f"gives up in period {k}, the step size becomes too small") from None
                growth += rates[0] * osc.period
            ends.append((*state, growth))
        return np.array(ends).T

    return run


def heyoka(osc, periods, tol=0.0, tangent=True):
    """Taylor's method in batch mode with the first-order variational equation; from the tangent (1, 0).

    tol : 0 stands for the machine's precision; tangent=False : the state alone, growth is then not returned
    """
    import heyoka as hy

    x, v = hy.make_vars("x", "v")
    power = (v * v) ** ((osc.p - 1) / 2) if osc.p != 1 else 1.0
    acceleration = hy.par[0] * hy.cos(osc.omega * hy.time) + x - x**3 - osc.alpha * power * v
    system = [(x, v), (v, acceleration)]
    batch = 2 * hy.recommended_simd_size()  # twice as many, or vectors of 512 bits, are no faster
    rows = 4 if tangent else 2
    integrator = hy.taylor_adaptive_batch(
        hy.var_ode_sys(system, [x]) if tangent else system,
        np.zeros((2, batch)),
        pars=np.zeros((1, batch)),
        tol=tol,
    )
    blocks = np.resize(osc.mu, (-(-osc.mu.size // batch), batch))
    start = np.repeat(np.array([*START, 1.0, 0.0])[:rows, None], batch, axis=1)

    def run():
        ends = []
        for mu in blocks:
            integrator.set_time(0.0)
            integrator.state[:], integrator.pars[0] = start, mu
            integrator.propagate_until(periods * osc.period)
            if any(str(result[0]) != "taylor_outcome.time_limit" for result in integrator.propagate_res):
                share = np.min(integrator.time) / osc.period
                raise ArithmeticError(f"stops after {share:.2f} periods, {integrator.propagate_res[0][0]}")
            ends.append(integrator.state.copy())
        y = np.concatenate(ends, axis=1)[:, : osc.mu.size]
        return np.array([*y[:2], np.log(np.hypot(*y[2:]))]) if tangent else y

    return run
