"""What a force evaluation buys: the error of the state at a given time for several integrators, side by side."""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from duffing import checks
from duffing.integrators import rk4
from duffing.integrators.friction_time import adaptive as friction


class WorkPrecision(NamedTuple):
    """evaluations (n,) of the force and the error (n,) that they leave, max(|dx|, |dv|), for one integrator."""

    evaluations: np.ndarray
    error: np.ndarray


def reference_state(osc, state, end, rtol=1e-13, m=15.0):
    """(x, v) at t = end from (x, v) at t = 0, by SciPy's DOP853 in another formulation than the package's.

    The variable is w with v = sign(w) |w|^m and the pace dt/ds = m |w|^(m-1), for any m with m p > 1 and whatever p:
    smooth enough for the method at every crossing of v = 0. The last stretch, away from v = 0, runs in physical time.
    For one oscillator with p <= 1. Raises ValueError unless end > 0 and v is not within a thousandth of 0 there.
    """

    end = checks.positive("end", end)

    def slope(sigma, y):
        x, w, t = y
        phi = m * abs(w) ** (m - 1)
        damping = osc.alpha * np.sign(w) * abs(w) ** (m * osc.p)
        return np.array([phi * np.sign(w) * abs(w) ** m, osc.force(x, t) - damping, phi]) / (1 + phi)

    def arrived(sigma, y):
        return y[2] - end

    arrived.terminal = True
    start = [state[0], np.sign(state[1]) * abs(state[1]) ** (1 / m), 0.0]
    options = {"rtol": rtol, "atol": rtol / 10}
    flight = solve_ivp(slope, (0, 1e6), start, "DOP853", events=arrived, **options)
    x, w, t = flight.y[:, -2]  # the last point before the event, whose own location is less accurate than the steps
    v = np.sign(w) * abs(w) ** m
    last = solve_ivp(lambda t, y: (y[1], osc.acceleration(*y, t)), (t, end), (x, v), "DOP853", **options).y
    if np.min(np.abs(last[1])) < 1e-3 or np.ptp(np.sign(last[1])):
        raise ValueError(f"end = {end}: must be a time at which |v| is not small, v = {last[1, -1]:.1e} there")
    return last[:, -1]


def work_precision(osc, state, end, reference):
    """Error at t = end against the evaluations of the force, for each integrator: dict of WorkPrecision.

    Fixed-step Runge-Kutta from 100 steps a period, SciPy's explicit DOP853, LSODA and implicit Radau in physical time
    over a range of tolerances, and the package's adaptive integrator.
    """

    def by_scipy(method):
        def run(rtol):
            flight = solve_ivp(
                lambda t, y: (y[1], osc.acceleration(*y, t)), (0, end), state, method, rtol=rtol, atol=rtol / 100
            )
            return flight.nfev, flight.y[:, -1]

        return run

    def by_rk4(steps):
        path = rk4.integrate(osc, state, np.array([0.0, end]), steps_per_period=steps).states[:, -1, 0]
        return 4 * np.ceil(steps * end / osc.period - 1e-9), path

    def by_friction(rtol):
        orbit = friction.integrate(osc, state, np.array([0.0, end]), rtol=rtol, atol=rtol / 100)
        return orbit.evaluations[0], orbit.states[:, -1, 0]

    tolerances = 10.0 ** -np.arange(3, 13)
    runs = {
        "Runge-Kutta 4, fixed step": (by_rk4, (100, 300, 1000, 3000, 10000, 30000)),
        "SciPy DOP853": (by_scipy("DOP853"), tolerances),
        "SciPy LSODA": (by_scipy("LSODA"), tolerances),
        "SciPy Radau": (by_scipy("Radau"), tolerances[:7]),
        "friction time": (by_friction, 10.0 ** -np.arange(3, 14)),
    }
    table = {}
    for name, (run, settings) in runs.items():
        found = [run(setting) for setting in settings]
        error = [np.max(np.abs(end_state - reference)) for _, end_state in found]
        table[name] = WorkPrecision(np.array([evaluations for evaluations, _ in found]), np.array(error))
    return table


def evaluations_for(curve, error):
    """Evaluations from which on a WorkPrecision stays below the error, interpolated log-log; inf if it never does."""
    above = np.nonzero(curve.error >= error)[0]
    k = above[-1] + 1 if above.size else 0
    if k == curve.error.size:
        return np.inf
    if k == 0:
        return float(curve.evaluations[0])
    ends = np.log(curve.error[[k, k - 1]]), np.log(curve.evaluations[[k, k - 1]])
    return float(np.exp(np.interp(np.log(error), *ends)))
