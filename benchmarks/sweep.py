"""Side by side: one forcing period of the paper's sweep of lambda_1, by this package's kernel and by others.

    python benchmarks/sweep.py

Everyone advances the state and one tangent vector for the paper's start and parameters, on one thread. The answers are
compared before any time counts; rounds are interleaved, so that a busy machine slows everyone. What is printed are
times per trajectory and period relative to the kernel's: the median of the rounds, and their range. No other use is
made of them. The compared schemes:

- plain: the same Runge-Kutta scheme as a scalar numba loop, one trajectory after another, the C library's pow
- numpy: the same scheme over all members at once in NumPy
- DOP853, LSODA: SciPy's adaptive solvers at 1e-8 on a few members. Where a solver stops early, at the singular tangent
  of p < 1, that is said; so is a growth that differs, which for p < 1 is the error of the paper's step, not SciPy's
"""

import math
import statistics
import time
import warnings

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp

from duffing.oscillator import Duffing
from duffing.rk4 import integrate

START = (0.45, 0.1)
STEPS = 500
ROUNDS = 5


def kernel(osc, periods):
    """Ends (x, v, log growth) (3, N) by the package."""
    orbit = integrate(osc, START, osc.period * np.arange(periods + 1), tangents=1, threads=1)
    return np.array([*orbit.states[:, -1], orbit.growth[0].sum(axis=0)])


@njit(error_model="numpy")
def _slope(alpha, p, mu, omega, t, x, v, xi, eta):
    power = abs(v) ** (p - 1.0) if p != 1.0 else 1.0
    a = mu * math.cos(omega * t) + x - x * x * x - alpha * power * v
    return v, a, eta, (1.0 - 3.0 * x * x) * xi - alpha * p * power * eta


@njit(error_model="numpy")
def _plain(alpha, p, mu, omega, x, v, periods, steps):
    h = 2.0 * math.pi / omega / steps
    xi, eta, growth = 1.0, 0.0, 0.0
    for n in range(periods * steps):
        t = (n % steps) * h
        a1, b1, c1, d1 = _slope(alpha, p, mu, omega, t, x, v, xi, eta)
        m = h / 2.0
        a2, b2, c2, d2 = _slope(alpha, p, mu, omega, t + m, x + m * a1, v + m * b1, xi + m * c1, eta + m * d1)
        a3, b3, c3, d3 = _slope(alpha, p, mu, omega, t + m, x + m * a2, v + m * b2, xi + m * c2, eta + m * d2)
        a4, b4, c4, d4 = _slope(alpha, p, mu, omega, t + h, x + h * a3, v + h * b3, xi + h * c3, eta + h * d3)
        x += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
        v += h / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4)
        xi += h / 6.0 * (c1 + 2.0 * c2 + 2.0 * c3 + c4)
        eta += h / 6.0 * (d1 + 2.0 * d2 + 2.0 * d3 + d4)
        if (n + 1) % steps == 0:
            length = math.hypot(xi, eta)
            xi, eta, growth = xi / length, eta / length, growth + math.log(length)
    return x, v, growth


def plain(osc, periods):
    """The scalar loop over the members."""
    return np.array([_plain(osc.alpha, osc.p, mu, osc.omega, *START, periods, STEPS) for mu in osc.mu]).T


def _field(osc, t, y):
    x, v, xi, eta = y
    power = np.abs(v) ** (osc.p - 1) if osc.p != 1 else 1.0
    a = osc.mu * np.cos(osc.omega * t) + x - x**3 - osc.alpha * power * v
    return np.array([v, a, eta, (1 - 3 * x**2) * xi - osc.alpha * osc.p * power * eta])


def numpy(osc, periods):
    """The same scheme over all members in NumPy."""
    y = np.repeat(np.array([*START, 1.0, 0.0])[:, None], osc.mu.size, axis=1)
    h, growth = osc.period / STEPS, 0.0
    for n in range(periods * STEPS):
        t = (n % STEPS) * h
        k1 = _field(osc, t, y)
        k2 = _field(osc, t + h / 2, y + h / 2 * k1)
        k3 = _field(osc, t + h / 2, y + h / 2 * k2)
        k4 = _field(osc, t + h, y + h * k3)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        if (n + 1) % STEPS == 0:
            length = np.hypot(y[2], y[3])
            y[2:] /= length
            growth = growth + np.log(length)
    return np.array([y[0], y[1], growth])


def scipy(method):
    """SciPy's solve_ivp on the same equations, one member after another; None where it gives up."""

    def run(osc, periods):
        ends = []
        for mu in osc.mu:
            member = Duffing(alpha=osc.alpha, p=osc.p, mu=mu)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # its own words on giving up; success is asked for below
                y = solve_ivp(
                    lambda t, y, m=member: _field(m, t, y),
                    (0, periods * osc.period), (*START, 1.0, 0.0), method, rtol=1e-8, atol=1e-8,
                )  # the columns stay together  # fmt: skip
            if not y.success:
                return None
            ends.append((*y.y[:2, -1], math.log(math.hypot(*y.y[2:, -1]))))
        return np.array(ends).T

    return run


def timed(run, osc, periods):
    """(result, CPU seconds per trajectory and period)."""
    start = time.process_time()
    result = run(osc, periods)
    return result, (time.process_time() - start) / (osc.mu.size * periods)


def main():
    # (scheme, members, periods, tolerance of x, v and of the growth after one period): round-off for the same scheme,
    # the error of the paper's step for SciPy. Few members and periods for the slow: times are per member and period.
    schemes = {
        "kernel": (kernel, 128, 40, 0.0),
        "plain": (plain, 128, 4, 1e-9),
        "numpy": (numpy, 128, 2, 1e-9),
        "DOP853": (scipy("DOP853"), 2, 2, 1e-3),
        "LSODA": (scipy("LSODA"), 2, 2, 1e-3),
    }
    for p in (0.1, 1.0):
        print(f"p = {p}: time per trajectory and period, kernel = 1; median of {ROUNDS} rounds (least to greatest)")
        families = {n: Duffing(p=p, mu=np.linspace(0.2, 0.3, n)) for n in {s[1] for s in schemes.values()}}
        known, remarks, rounds = {}, {}, {name: [] for name in schemes}
        for name, (run, members, _, tolerance) in schemes.items():
            answer, expected = run(families[members], 1), kernel(families[members], 1)
            if answer is None:
                known[name] = "gives up in the first period"
                continue
            off = np.abs(answer - expected).max(axis=1)
            if off[:2].max() > tolerance:
                known[name] = f"x, v differ by {off[:2].max():.1g} after one period: not timed"
            elif off[2] > tolerance:
                remarks[name] = f"   log growth differs by {off[2]:.1g} after one period"
        for _ in range(ROUNDS):
            base = None
            for name, (run, members, periods, _) in schemes.items():
                if name not in known:
                    answer, seconds = timed(run, families[members], periods)
                    base = base or seconds
                    rounds[name].append(seconds / base)
                    if answer is None:
                        known[name] = f"gives up within {periods} periods"
        for name in schemes:
            r = rounds[name]
            result = known.get(name) or f"{statistics.median(r):8.1f} ({min(r):.1f} to {max(r):.1f})"
            print(f"  {name:8}", result + remarks.get(name, ""))


if __name__ == "__main__":
    main()
