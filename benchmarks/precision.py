"""Time to an error: how long each integrator takes for its best-suited tolerance, by the error that it leaves.

A family of amplitudes over two forcing periods. The error is that of a few members, max(|dx|, |dv|) or also of the
tangent's growth, against a reference which two methods share (`reference`). Solvers that go one by one do these few
members only. Each tolerance is one point of a curve time(error), interpolated at the errors asked for.
"""

import time
import warnings

import numpy as np

from book.studies.friction_time import WorkPrecision, evaluations_for, reference_state
from duffing import paper
from duffing.integrators import rk4
from duffing.integrators.friction_time import adaptive as friction

from . import peers, rewrites
from .harness import Result

PERIODS = 2
ERRORS = (1e-6, 1e-8, 1e-10)
OSC = paper.OSCILLATOR
MU = np.linspace(0.2, 0.3, 481)
# Members whose reference the other method can confirm: they do not creep, and are not at a turning point at the end.
CHECKED = [0, 192, 288, 432]
LONGER = 10  # times as long goes who has a constant step, so that what a call costs once does not count
STEPS = (500, 1000, 2000, 4000, 8000, 16000)
OURS = "friction time"


def family(p, members=slice(None)):
    """The members of the family, or those listed."""
    return type(OSC)(alpha=OSC.alpha, p=p, mu=MU[members])


def package(integrate, tangent, longer=1, **options):
    """Prepare a run of one of the package's integrators over the whole family, on one thread."""

    def prepare(osc, periods):
        t = periods * osc.period * np.arange(longer + 1)

        def run():
            orbit = integrate(osc, rewrites.START, t, tangents=int(tangent), threads=1, **options)
            return np.array([*orbit.states[:, 1], *orbit.growth[:, 0]])

        return run

    return prepare


def methods(p, tangent):
    """For each method (members, how much longer it goes, prepare(osc, periods) for each setting, coarse to fine)."""
    tight = 10.0 ** -np.arange(4, 14)

    def scipy(method, tolerances):
        return CHECKED, 1, [peers.scipy(method, rtol, rtol / 100, tangent) for rtol in tolerances]

    def heyoka(tol):
        return lambda osc, periods: peers.heyoka(osc, periods, tol, tangent)

    def lanes(steps):
        return package(rk4.integrate, tangent, LONGER, steps_per_period=steps)

    everyone = slice(None)
    entries = {OURS: (everyone, 1, [package(friction.integrate, tangent, rtol=r, atol=r / 100) for r in tight])}
    entries["SciPy DOP853"] = scipy("DOP853", tight[:-1])
    if p == 1:  # for p < 1 the error of constant steps is far above any asked for, and Taylor's series do not converge
        entries["Runge-Kutta 4 in lanes"] = everyone, LONGER, [lanes(n) for n in STEPS]
        entries["heyoka, batch mode"] = everyone, 1, [heyoka(tol) for tol in 10.0 ** -np.arange(4, 16, 2)]
    if not tangent:
        entries["SciPy LSODA"] = scipy("LSODA", tight[:-1])
        entries["SciPy Radau"] = scipy("Radau", tight[:6])
    return entries


def reference(p, tangent):
    """((x, v) or (x, v, growth) of the checked members, how far an independent method is from it).

    By the package at the tightest tolerance; confirmed by SciPy's DOP853, which steps in another variable for the state
    and, with the tangent (p = 1), integrates the equations as they stand.
    """
    few = family(p, CHECKED)
    expected = package(friction.integrate, tangent, rtol=1e-14, atol=1e-16)(few, PERIODS)()
    if tangent:
        other = peers.scipy("DOP853", 1e-13, 1e-15)(few, PERIODS)()
    else:
        alone = [type(OSC)(alpha=OSC.alpha, p=p, mu=mu) for mu in few.mu]
        other = np.array([reference_state(one, rewrites.START, PERIODS * OSC.period) for one in alone]).T
    return expected, float(np.abs(other - expected).max())


def measure(p, tangent, rounds, clock=time.process_time):
    """(Results for each error, ratios to friction time's; how far the reference is confirmed)."""
    expected, confirmed = reference(p, tangent)
    if confirmed > ERRORS[-1] / 2:
        raise ArithmeticError(f"p = {p}: two methods differ by {confirmed:.1g}, too much for a reference")
    curves, remarks = {}, {}
    for name, (members, longer, prepared) in methods(p, tangent).items():
        rows = slice(None) if members is CHECKED else CHECKED
        curves[name], remarks[name] = _points(family(p, members), rows, longer, prepared, expected)
    times = {name: [[] for _ in range(rounds)] for name in curves}
    for number in range(rounds):
        for name, points in curves.items():
            for _, run, work in points:
                start = clock()
                run()
                times[name][number].append((clock() - start) / work)
    results = {}
    for error in ERRORS:
        found = {
            name: [_time_for(error, points, seconds) for seconds in times[name]] for name, points in curves.items()
        }
        results[error] = [_result(name, found[name], found[OURS], remarks[name]) for name in found]
    return results, confirmed


def _points(osc, rows, longer, prepared, expected):
    """[(error, run, work)] for the settings that give an answer, and what became of one that does not."""
    points, remark = [], ""
    for prepare in prepared:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # what a solver complains of shows in its answer
                run = prepare(osc, PERIODS)
                error = float(np.abs(run()[:, rows] - expected).max())
        except ImportError as missing:
            return [], f"not installed ({missing.name})"
        except Exception as failure:  # whatever other software does on failing: it is told, and the rest goes on
            remark = f"fails: {' '.join(str(failure).split())[:120] or type(failure).__name__}"
        else:
            points.append((error, run, osc.mu.size * longer))
    return points, remark if not points else ""


def _time_for(error, points, seconds):
    if not points:
        return np.inf
    return evaluations_for(WorkPrecision(np.array(seconds), np.array([point[0] for point in points])), error)


def _result(name, times, ours, remark):
    if not np.isfinite(times).all():
        return Result(name, (), remark or "does not reach it")
    return Result(name, tuple(t / own for t, own in zip(times, ours, strict=True)), "")
