"""The sketch of why M measures a distance: computed sections against the Melnikov function and the splitting."""

from dataclasses import replace

import numpy as np
import pytest

from book.studies.melnikov_distance import at_outermost_point
from duffing import Duffing, critical_amplitude, melnikov_function, splitting


def oscillator(alpha):
    osc = Duffing(alpha=alpha, p=1.0, omega=1.0)
    return replace(osc, mu=2 * critical_amplitude(osc))


def test_the_gap_of_energy_and_the_distance_tend_to_the_melnikov_function_as_damping_and_forcing_vanish():
    rest = []
    for alpha in (0.08, 0.04):
        osc = oscillator(alpha)
        found, predicted = at_outermost_point(osc), melnikov_function(osc, np.pi / 2)
        slope = np.sqrt(2)  # of the energy, at the outermost point x = sqrt(2)
        rest.append([found.gap / predicted - 1, (found.ends[0, 0] - found.ends[0, 1]) * slope / predicted - 1])
    rest = np.abs(rest)
    assert np.all(rest[0] < 0.02)
    assert np.all(rest[1] < 0.6 * rest[0]), rest


@pytest.mark.parametrize("phase", [1.0, np.pi / 2])
def test_the_ends_are_as_far_apart_as_the_splitting_says(phase):
    osc = oscillator(0.05)
    found = at_outermost_point(osc, phase)
    # The package shoots to v = 0 at the phase; here the curves at that phase are cut.
    assert found.ends[0, 0] - found.ends[0, 1] == pytest.approx(float(splitting(osc, phase)), rel=1e-6)


def test_the_orbits_come_from_the_saddle_orbit_and_go_to_it():
    found = at_outermost_point(oscillator(0.05))
    assert abs(found.energies[0][0]) < 2e-3 > abs(found.energies[1][-1])
    assert found.energies[0][-1] - found.energies[1][0] == pytest.approx(found.gap, rel=0.02)
