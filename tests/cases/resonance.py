"""Cases of the figures of the resonances, compared as those of `bifurcations`."""

import numpy as np

from book.figures import resonance as figures
from book.studies import bifurcations as study
from book.studies import resonance
from book.studies.followed import amplitude, at_exponent

from .bifurcations import P, near_curves, packed, packed_marks, resampled, unpacked, unpacked_marks
from .case import Case


def _responses():
    data = {}
    for p in P:
        chosen = at_exponent(resonance.response(0.12), p)
        data |= packed(chosen, amplitude, (study.IN_WELL,), f"{p:g}")
        data[f"marks {p:g}"] = packed_marks(chosen)
    return data


def _draw_responses(data):
    cases = {p: (unpacked(data, f"{p:g}"), unpacked_marks(data[f"marks {p:g}"])) for p in P}
    return figures.responses({0.12: cases, 0.03: {}}, omega_range=(0.5, 2.2))


def _large():
    data = {}
    for p in P:
        chosen = at_exponent(resonance.large_response(0.3), p)
        data |= packed(chosen, amplitude, (study.LARGE,), f"{p:g}")
        least = resonance.least_forcing()[p]
        data[f"least|{p:g}"] = resampled(least.omega, least.mu, np.zeros(least.mu.size))
    return data


def _draw_large(data):
    cases = {p: (unpacked(data, f"{p:g}"), []) for p in P}
    least = {p: data[f"least|{p:g}"][:2] for p in P}
    return figures.large_orbit(0.3, cases, least, omega_range=(0.5, 2.2))


CASES = {
    "response": Case(_responses, _draw_responses, near_curves),
    "large_response": Case(_large, _draw_large, near_curves),
}
