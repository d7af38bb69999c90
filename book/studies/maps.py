"""lambda_1 over a plane of parameters: the whole of Fig. 3 and Fig. 4 as one image each."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import checks, paper
from duffing.errors import ConvergenceError, NoSaddleOrbitError
from duffing.lyapunov import lyapunov_spectrum
from duffing.manifolds.tangency import homoclinic_tangency
from duffing.melnikov import critical_amplitude

from ..remember import remembered
from .accuracy import integrator

TRANSIENT, PERIODS = 60, 80


class Plane(NamedTuple):
    """values (n,) of the abscissa, mu (m,) of the ordinate, lambda_1 (m, n) per unit time."""

    values: np.ndarray
    mu: np.ndarray
    exponent: np.ndarray


@remembered
def exponent_plane(
    field, first, last, pixels=400, top=0.4, osc=paper.OSCILLATOR, transient=TRANSIENT, periods=PERIODS, **sweep
):
    """lambda_1 from the paper's start over the plane of a field ("p" or "omega") and mu: a Plane of pixels x pixels.

    first, last : middles of the first and last column; the rows' middles are top/pixels, 2 top/pixels ... top
    transient, periods : forcing periods thrown away and averaged over
    sweep : executor, progress and checkpoint as for `lyapunov_spectrum`

    Integrated as `accuracy` says.
    """
    checks.choice("field", field, ("p", "omega"))
    checks.count("pixels", pixels, least=2)
    values = np.linspace(checks.positive("first", first), checks.positive("last", last), pixels)
    mu = checks.positive("top", top) * (np.arange(1, pixels + 1) / pixels)
    exponent = np.empty((pixels, pixels))
    p = values if field == "p" else np.full(pixels, float(osc.p))
    for columns in (p < 1, p >= 1):
        if columns.any():
            family = replace(osc, **{field: values[columns]}, mu=mu[:, None])
            how = integrator(p[columns][0])
            spectrum = lyapunov_spectrum(family, paper.START, periods, transient, k=1, **how, **sweep)
            exponent[:, columns] = spectrum.exponents[0]
    return Plane(values, mu, exponent)


@remembered
def thresholds(field, first, last, points=120, crosses=9, osc=paper.OSCILLATOR):
    """What is drawn on a plane: (values, mu_c) of Eq. 13 and (values, mu_t) of the tangency where it has an answer."""
    checks.choice("field", field, ("p", "omega"))
    line, few = np.linspace(first, last, points), np.linspace(first, last, crosses)
    mu_c = critical_amplitude(replace(osc, **{field: line}))
    found = []
    for value in few:
        try:
            found.append((value, homoclinic_tangency(replace(osc, **{field: value}))))
        except (ConvergenceError, NoSaddleOrbitError):
            continue  # no cross there
    return (line, mu_c), tuple(np.array(found).reshape(-1, 2).T)
