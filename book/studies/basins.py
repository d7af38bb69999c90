"""What the chapter on basins computes: pictures, their dependence on the step, dimensions of the boundary, sections.

Sizes are arguments: the book takes what fits its time, `tools/maps.py` the full resolution.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from duffing import paper
from duffing.basins.attractors import find_attractors
from duffing.basins.basins import basins, changed
from duffing.basins.boundary import boundary_dimension, crossings, line_of_starts, neighbourhood
from duffing.basins.contact import first_contact
from duffing.basins.fates import classify
from duffing.basins.uncertainty import dimension, uncertain_starts
from duffing.errors import ConvergenceError
from duffing.manifolds.tangency import homoclinic_tangency
from duffing.melnikov import critical_amplitude

from ..remember import remembered
from .accuracy import integrator

FRAME = ((-1.7, 1.7), (-1.5, 1.5))  # x and v of the pictures
AXIS = ((-1.5, 0.0), (1.5, 0.0))  # the line v = 0 whose crossings with the boundary are counted
STEPS = 128  # Runge-Kutta steps a period for p >= 1
SECTION_PERIODS = 120
PICTURES = (0.9, 1.1, 2.0)  # mu / mu_c of the pictures at p = 1
ENLARGED = ((0.05, 0.6), (-1.05, -0.55))  # a part of FRAME in which the stripes at 1.1 are seen
RATIOS = {
    1.0: (0.5, 0.9, 0.99, 0.9995, 1.0005, 1.005, 1.01, 1.02, 1.1, 1.2, 1.5, 2.0),
    0.5: (0.9, 0.987, 0.994, 0.998, 1.003, 1.01, 1.02, 1.1, 1.2, 1.5),
    0.1: (0.9, 0.96, 0.98, 1.01, 1.1, 1.5),
}  # mu / mu_c at which the dimension of the boundary is computed
MOST = {
    1.0: (30_000,) * 12,
    0.5: (10_000,) * 2 + (40_000,) + (10_000,) * 7,  # just below the tangency it takes more
    0.1: (2000, 3000, 4000, 4000, 4000, 6000),
}  # starts that are followed at each of them
RANDOM = {1.0: (0.9, 1.1, 1.2, 2.0), 0.1: (1.1,)}  # and where by random starts


def oscillator(p, ratio=None, mu=None):
    """The paper's oscillator with exponent p at the forcing mu, or ratio times the critical amplitude."""
    osc = replace(paper.OSCILLATOR, p=p)
    return replace(osc, mu=float(ratio * critical_amplitude(osc)) if mu is None else mu)


@remembered
def picture(p, ratio=None, mu=None, size=512, periods=200, steps=STEPS, frame=FRAME, **sweep):
    """Basins of size x size starts in the frame (x, v), at ratio times mu_c or at mu; sweep : how, as for `basins`."""
    osc, options = oscillator(p, ratio, mu), integrator(p, steps_per_period=steps)
    x, v = (np.linspace(*ends, size) for ends in frame)
    # Starts of a coarser grid than by default: a small attractor that they miss is met by the picture's own starts.
    starts = np.reshape(np.meshgrid(x[:: size // 8], v[:: size // 8]), (2, -1))
    return basins(osc, x, v, find_attractors(osc, starts, periods=120, **options), periods, **sweep, **options)


def case(title, found, curves=()):
    """A panel of `figures.basin_pictures`: the Basins with the points of their periodic attractors, and curves."""
    points = [one.points for one in found.attractors if one.period]
    return title, found.x, found.v, found.kinds[found.labels], points, list(curves)


def unresolved(found):
    """The part of the starts of some Basins that nothing has captured, in per cent."""
    return 100 * float(found.shares[-1])


def attractor_rows(attractors):
    """Cells of a table of periodic attractors: name, half range of x, modulus of the multipliers, axes of the trap."""
    rows = []
    for one in attractors:
        axes = 1 / np.sqrt(np.linalg.eigvalsh(one.region.form))
        rows.append([one.name, *(f"{each:.3f}" for each in (one.amplitude, np.abs(one.multipliers).max(), *axes))])
    return rows


@remembered
def step_changes(ratios, steps=(32, 64, 128, 256), size=128):
    """The part of the labels that change when the step is halved, p = 1: array (len(ratios), len(steps) - 1)."""
    pictures = [[picture(1.0, ratio, size=size, steps=n) for n in steps] for ratio in ratios]
    return np.array([[changed(one, other) for one, other in pairwise(row)] for row in pictures])


@remembered
def strips(p, ratio, most=30_000):
    """The boundary's Crossings with AXIS, by Runge-Kutta steps: a smooth map down to rounding, which the finest strips
    need. Twice the steps or the periods shift a strip, but not the dimension. Below p = 1/2 in friction time: there
    the fixed steps invent thin strips, other ones with other steps, at forcings where the boundary is a curve."""
    rk4 = {"method": "rk4", "steps_per_period": 96 if p == 1 else 300}
    options = rk4 if p >= 0.5 else {"method": "friction", "rtol": 1e-9, "atol": 1e-11}
    return crossings(line_of_starts(oscillator(p, ratio), *AXIS, periods=24 if p == 1 else 16, **options), most=most)


@remembered
def line_dimensions(p, ratios, most=30_000):
    """D from the crossings with AXIS at each ratio mu/mu_c: (values, errors, numbers of crossings), each (n,).

    most : starts that are followed, for all ratios or for each. A few crossings that crowd look like a fractal until
    the cells are finer than the gaps between them: just below the tangency it takes more starts than above.
    """
    most = np.broadcast_to(most, len(ratios)).tolist()
    found = [strips(p, ratio, number) for ratio, number in zip(ratios, most, strict=True)]
    values, errors = np.array([boundary_dimension(one) for one in found]).T
    return values, errors, np.array([one.left.size for one in found])


def dimension_lines():
    """D along RATIOS: dict p -> (ratios, values, errors)."""
    return {p: (ratios, *line_dimensions(p, ratios, MOST[p])[:2]) for p, ratios in RATIOS.items()}


def dimension_random():
    """D by random starts at RANDOM: dict p -> (ratios, values, errors)."""
    sizes = {p: {} if p == 1 else {"starts": 2**9} for p in RANDOM}
    return {p: (ratios, *random_dimensions(p, ratios, **sizes[p])) for p, ratios in RANDOM.items()}


def with_error(curve, ratio, digits=2):
    """The D of a (ratios, values, errors) at a ratio and its error, as words."""
    k = curve[0].index(ratio)
    return f"{curve[1][k]:.{digits}f} ± {curve[2][k]:.{digits}f}"


@remembered
def tangency_ratio(p):
    """The first primary homoclinic tangency over mu_c."""
    osc = oscillator(p, 1.0)
    return float(homoclinic_tangency(osc) / osc.mu)


def below(p):
    """The Crossings at those of RATIOS that are less than the tangency: a list."""
    pairs = zip(RATIOS[p], MOST[p], strict=True)
    return [strips(p, ratio, most) for ratio, most in pairs if ratio < tangency_ratio(p)]


def least_gap(exponents=(1.0, 0.5)):
    """The least distance of two crossings below the tangency, in cells, over some exponents p."""
    return float(min(np.diff(one.left).min() / one.width for p in exponents for one in below(p)))


def uncertain_fraction(p, ratio, steps=2):
    """f(eps) on AXIS in so many steps a decade, from four cells to a hundredth: Crossings, eps (n,), f (n,)."""
    found = strips(p, ratio, 30_000)
    low = np.ceil(steps * np.log10(4 * found.width)) / steps
    eps = 10.0 ** np.arange(low, -1.9, 1 / steps)
    return found, eps, neighbourhood(found, eps)


def counted_dimension(distance, multiplier):
    """d with 4 sum over n >= ln(1/distance)/ln(multiplier) of multiplier^(-n d) = 1: the strips that excursions of n
    periods make near a tangency, at the relative distance in mu above it."""
    return float(brentq(lambda d: 4 * distance**d / (1 - multiplier**-d) - 1, 1e-6, 1.0))


@remembered
def random_dimensions(p, ratios, starts=2**12, eps=(1e-4, 3e-4, 1e-3, 3e-3, 1e-2), periods=20):
    """D from random starts in FRAME at each ratio: (values, errors), each (n,); nan where too few are uncertain."""
    found = []
    for ratio in ratios:
        osc = oscillator(p, ratio)

        def label(states, osc=osc):
            return classify(osc, states, periods, **integrator(p, steps_per_period=96))

        try:
            found.append(dimension(eps, uncertain_starts(label, FRAME, eps, starts), starts))
        except ConvergenceError:
            found.append((np.nan, np.nan))
    return tuple(np.array(found).T)


@remembered
def contact(p=1.0, low=0.999, high=1.002, halvings=8):
    """The ratios mu/mu_c (below, above) between which W^U and W^S first meet, at whatever turn."""
    osc = oscillator(p, 1.0)
    options = {"method": "rk4", "steps_per_period": 200}
    return first_contact(osc, low * osc.mu, high * osc.mu, halvings, **options) / osc.mu


@remembered
def section(mu, x, p=paper.P_SMALL, periods=SECTION_PERIODS):
    """Fates after so many periods of the starts (x, v = 0) at each mu: array (len(x), len(mu))."""
    x, mu = np.array(x), np.array(mu)
    states = np.array(np.broadcast_arrays(x[:, None], np.zeros(mu.size)))
    family = replace(paper.OSCILLATOR, p=p, mu=np.broadcast_to(mu, states.shape[1:]))
    return classify(family, states, periods, last=16, **integrator(p, steps_per_period=STEPS))
