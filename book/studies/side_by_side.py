"""Every number of the paper beside the book's: by the paper's algorithm, and without its error.

A row is (quantity, the paper's value, the same algorithm, the adaptive integrator or a formula, its error, key of the
claim). None stands where there is no such value.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from duffing import Duffing, critical_amplitude, homoclinic_tangency, paper

from ..remember import remembered
from . import inference, missing_parameters, reproduction, small_p


class Row(NamedTuple):
    """quantity, in words; paper, what is printed; same, the paper's algorithm here; exact and its error; claim"""

    quantity: str
    paper: str
    same: float | None
    exact: float | None
    error: float | None
    claim: str


@remembered
def rows():
    """The rows, for the adopted pair of alpha and omega."""
    osc = paper.OSCILLATOR
    grid, small = reproduction.exponent_curve(paper.P_SMALL)
    _, linear = reproduction.exponent_curve(paper.P_LINEAR)
    chaos = small_p.chaos()
    orbit = small_p.attracting_orbits((paper.MU_REGULAR,)).exponents[0, 0]
    motion = reproduction.motion(paper.MU_REGULAR)
    jumps = motion.t[1:][np.diff(np.sign(motion.path[0])) != 0]
    late = motion.part(paper.SETTLED, paper.END, osc.period)[0][0]
    evidence = missing_parameters.evidence((osc.alpha,), (osc.omega,))
    transient = inference.probabilities(evidence)["transient"][0]
    found = [
        Row("depth of the wells, −V(±1)", "¼ (Fig. 1a)", None, float(-Duffing().potential(1.0)), 0.0, "saddle"),
        Row("λ₁ at p = 0.1, μ = 0.27", "0.175", _at(grid, small, 0.27), chaos.mean, chaos.error, "lambda-027"),
        Row("λ₁ at p = 0.1, μ = 0.25", "−0.023", _at(grid, small, 0.25), float(orbit), 1e-4, "lambda-025"),
        Row("onset of λ₁ > 0.1 at p = 0.1", "≈ 0.27", _first(grid, small), None, 0.001, "just-after"),
        Row("onset of λ₁ > 0.1 at p = 1", "circle of Fig. 3b", _first(grid, linear), None, 0.001, "agreement"),
        Row("largest λ₁ at p = 0.1", "Fig. 4a", float(small[grid > 0.1].max()), None, chaos.spread, "larger-lambda"),
        Row("largest λ₁ at p = 1", "Fig. 4b", float(linear[grid > 0.1].max()), None, chaos.spread, "larger-lambda"),
        Row("last jump between the wells at μ = 0.25", "t < 1200", float(jumps[-1]), None, None, "fig-5b-transient"),
        Row("probability of a transient that ends before 1200", "seen", float(transient), None, None, "t-1200"),
        Row(
            "half the range of x at μ = 0.25, late",
            "“much smaller”",
            float(np.ptp(late) / 2),
            None,
            None,
            "fig-5b-steady",
        ),
    ]
    for p in (paper.P_SMALL, paper.P_LINEAR):
        one = replace(osc, p=p)
        mu_c, mu_t = float(critical_amplitude(one)), float(homoclinic_tangency(one))
        name = f"μ_c at p = {p:g} (Eq. 13), and the homoclinic tangency"
        found.append(Row(name, "line of Fig. 3b", mu_c, mu_t, 1e-7 * mu_t, "eq-13"))
    return found


def _at(grid, exponent, mu):
    return float(exponent[np.argmin(np.abs(grid - mu))])


def _first(grid, exponent):
    chaotic = (exponent > paper.THRESHOLD) & (grid > 0.1)  # the false positives of weak forcing left out
    return float(grid[np.argmax(chaotic)])
