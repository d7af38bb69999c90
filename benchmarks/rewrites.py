"""The paper's scheme, state and one tangent, written as others would: a NumPy loop, a scalar loop, C over lanes.

Each function prepares and returns run(), which goes through so many periods, the tangent made of length one after each.
Its answer is (x, v, growth) (3, N) after the first COMPARED of them, growth being the logarithm of the tangent's; from
there on chaos would magnify the round-off in which right answers differ.
"""

import ctypes
import math
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from numba import njit

START = (0.45, 0.1)
STEPS = 500
COMPARED = 3


def field(osc, t, y):
    """dy/dt of (x, v, xi, eta) for an oscillator or a family, in NumPy."""
    x, v, xi, eta = y
    power = np.abs(v) ** (osc.p - 1) if osc.p != 1 else 1.0
    a = osc.mu * np.cos(osc.omega * t) + x - x**3 - osc.alpha * power * v
    return np.array([v, a, eta, (1 - 3 * x**2) * xi - osc.alpha * osc.p * power * eta])


def numpy(osc, periods, direction=(1.0, 0.0), steps=STEPS):
    """All members at once; the first tangent has the direction given."""

    def run():
        y = np.repeat(np.array([*START, *direction])[:, None], osc.mu.size, axis=1)
        h, growth, answer = osc.period / steps, np.zeros(osc.mu.size), None
        for period in range(1, periods + 1):
            for n in range(steps):
                t = n * h
                k1 = field(osc, t, y)
                k2 = field(osc, t + h / 2, y + h / 2 * k1)
                k3 = field(osc, t + h / 2, y + h / 2 * k2)
                k4 = field(osc, t + h, y + h * k3)
                y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            length = np.hypot(y[2], y[3])
            y[2:] /= length
            growth = growth + np.log(length)
            if period == COMPARED:
                answer = np.array([y[0], y[1], growth])
        return answer

    return run


@njit(error_model="numpy")
def _slope(alpha, p, mu, omega, t, x, v, xi, eta):
    power = abs(v) ** (p - 1.0) if p != 1.0 else 1.0
    a = mu * math.cos(omega * t) + x - x * x * x - alpha * power * v
    return v, a, eta, (1.0 - 3.0 * x * x) * xi - alpha * p * power * eta


@njit(error_model="numpy")
def _plain(alpha, p, mu, omega, y, periods, steps):
    h = 2.0 * math.pi / omega / steps
    x, v, xi, eta, growth = y
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
    return x, v, xi, eta, growth


def scalar(osc, periods):
    """One member after another in compiled scalar code, with the C library's pow and cos."""

    def run():
        answer = []
        for mu in osc.mu:
            y = _plain(osc.alpha, osc.p, mu, osc.omega, (*START, 1.0, 0.0, 0.0), COMPARED, STEPS)
            answer.append((y[0], y[1], y[4]))
            _plain(osc.alpha, osc.p, mu, osc.omega, y, periods - COMPARED, STEPS)
        return np.array(answer).T

    return run


def lanes_in_c(osc, periods):
    """lanes.c, with the vector width that gcc may choose set to the widest; members a multiple of 64."""
    compiler = shutil.which("gcc")
    if compiler is None:
        raise ImportError("no gcc")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "lanes.so"
        flags = ["-O3", "-march=native", "-ffast-math", "-mprefer-vector-width=512", "-shared", "-fPIC", "-lm"]
        source = Path(__file__).with_name("lanes.c")
        subprocess.run([compiler, source, *flags, "-o", library], check=True, capture_output=True)
        sweep = ctypes.CDLL(str(library)).sweep
    array = np.ctypeslib.ndpointer(float, flags="C")
    sweep.argtypes = [*[ctypes.c_double] * 2, array, ctypes.c_double, array, *[ctypes.c_int] * 2, array, ctypes.c_int]
    cosines = np.cos(np.linspace(0, 2 * np.pi, 2 * STEPS + 1))

    def run():
        y = np.repeat(np.array([*START, 1.0, 0.0, 0.0])[:, None], osc.mu.size, axis=1)
        constants = osc.alpha, osc.p, osc.mu, osc.period / STEPS, cosines, STEPS
        sweep(*constants, COMPARED, y, osc.mu.size)
        answer = y[[0, 1, 4]]
        sweep(*constants, periods - COMPARED, y, osc.mu.size)
        return answer

    return run
