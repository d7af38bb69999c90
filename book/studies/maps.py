"""lambda_1 over a plane of parameters: the whole of Fig. 3 and Fig. 4 as one image each."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import checks, paper
from duffing.lyapunov import lyapunov_spectrum
from duffing.manifolds.tangency import homoclinic_tangency, with_tangency
from duffing.melnikov import critical_amplitude

from ..remember import remembered

TOLERANCE = {"rtol": 1e-6, "atol": 1e-8}  # a pixel's statistical error is larger by orders
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

    For p < 1 in friction time, else by the paper's own steps, which are accurate there.
    """
    checks.choice("field", field, ("p", "omega"))
    checks.count("pixels", pixels, least=2)
    values = np.linspace(checks.positive("first", first), checks.positive("last", last), pixels)
    mu = checks.positive("top", top) * (np.arange(1, pixels + 1) / pixels)
    exponent = np.empty((pixels, pixels))
    p = values if field == "p" else np.full(pixels, float(osc.p))
    for smooth, method in ((False, TOLERANCE), (True, {"method": "rk4"})):
        columns = (p >= 1) == smooth
        if columns.any():
            family = replace(osc, **{field: values[columns]}, mu=mu[:, None])
            spectrum = lyapunov_spectrum(family, paper.START, periods, transient, k=1, **method, **sweep)
            exponent[:, columns] = spectrum.exponents[0]
    return Plane(values, mu, exponent)


@remembered
def thresholds(field, first, last, points=120, crosses=9, osc=paper.OSCILLATOR):
    """What is drawn on a plane: (values, mu_c) of Eq. 13 and (values, mu_t) of the tangency where it has an answer."""
    checks.choice("field", field, ("p", "omega"))
    line, few = np.linspace(first, last, points), np.linspace(first, last, crosses)
    mu_c = critical_amplitude(replace(osc, **{field: line}))
    fixed = {"alpha": osc.alpha, "delta": osc.delta, "gamma": osc.gamma}
    if field == "p":
        few = np.array(with_tangency(tuple(few), omega=osc.omega, **fixed))
    else:
        few = np.array([omega for omega in few if with_tangency((osc.p,), omega=omega, **fixed)])
    mu_t = homoclinic_tangency(replace(osc, **{field: few})) if few.size else few
    return (line, mu_c), (few, mu_t)
