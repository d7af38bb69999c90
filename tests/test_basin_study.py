"""What the chapter on basins states: each number against another way to it."""

from dataclasses import replace

import numpy as np
import pytest

from duffing import ConvergenceError, Duffing, critical_amplitude, homoclinic_tangency
from duffing.attraction.basins import KINDS
from duffing.attraction.contact import first_contact, homoclinic_strips
from duffing.attraction.fates import IRREGULAR, LARGE, LEFT, RIGHT
from duffing.book import basin_study

RK4 = {"method": "rk4", "steps_per_period": 200}


def linear(ratio):
    return Duffing(mu=ratio * critical_amplitude(Duffing()))


def test_the_manifolds_have_met_above_the_primary_tangency_and_not_well_below_it():
    tangency = homoclinic_tangency(Duffing())
    assert homoclinic_strips(Duffing(mu=0.995 * tangency), **RK4) == 0
    assert homoclinic_strips(Duffing(mu=1.001 * tangency), **RK4) > 0


def test_the_first_contact_comes_before_the_primary_tangency():
    low, high = basin_study.contact(1.0, halvings=4)
    assert high - low == pytest.approx(1e-3 / 2**4)
    assert 0.9995 < low < high < homoclinic_tangency(Duffing()) / critical_amplitude(Duffing())


def test_the_accurate_integrator_sees_the_strips_between_first_contact_and_tangency_too():
    assert homoclinic_strips(linear(0.9995), most=1000, rtol=1e-10, atol=1e-12) == 0
    assert homoclinic_strips(linear(1.0002), periods=12, most=1500, rtol=1e-10, atol=1e-12) > 0


def test_a_bracket_that_holds_no_contact_is_refused():
    mu_c = critical_amplitude(Duffing())
    with pytest.raises(ConvergenceError, match="do not meet"):
        first_contact(Duffing(), 0.8 * mu_c, 0.9 * mu_c, **RK4)
    with pytest.raises(ConvergenceError, match="the manifolds meet"):
        first_contact(Duffing(), 1.05 * mu_c, 1.1 * mu_c, **RK4)


def test_dimension_leaves_one_at_the_tangency_for_linear_damping():
    values, errors, crossings = basin_study.line_dimensions(1.0, (0.9, 1.02, 2.0), most=15_000)
    assert abs(values[0] - 1) < max(3 * errors[0], 0.02)
    assert np.all(np.diff(values) > 0.2) and values[2] < 2
    assert np.all(np.diff(crossings) > 0)


def test_line_and_random_starts_agree_on_the_dimension():
    line, scatter, _ = basin_study.line_dimensions(1.0, (2.0,), most=30_000)
    random, error = basin_study.random_dimensions(1.0, (2.0,), starts=2**11)
    assert abs(line[0] - random[0]) < 3 * np.hypot(error[0], scatter[0]) + 0.01


def test_twice_the_steps_and_more_periods_leave_the_dimension():
    from duffing.attraction.boundary import boundary_dimension, crossings, line_of_starts

    found = [
        boundary_dimension(crossings(line_of_starts(linear(1.2), *basin_study.AXIS, n, **options), most=20_000))
        for n, options in ((24, {"method": "rk4", "steps_per_period": 96}), (36, RK4))
    ]
    assert found[0].value == pytest.approx(found[1].value, abs=0.03)


def test_pictures_resolve_every_start_and_their_kinds_are_named():
    found = basin_study.picture(1.0, 1.1, size=32)
    assert found.labels.shape == (32, 32)
    assert found.shares[-1] == 0
    assert [KINDS[k] for k in found.kinds] == [
        "left well", "left well, larger orbit", "right well", "right well, larger orbit", "unresolved",
    ]  # in the order of the attractors  # fmt: skip


def test_changes_with_the_step_die_out_below_the_tangency_and_not_far_above():
    below, above = basin_study.step_changes((0.9, 2.0), (32, 64, 128), size=48)
    assert below[1] < below[0] / 4 < 0.02
    assert above[1] > above[0] / 3 > 0.02


def test_the_section_shows_wells_chaos_and_the_large_orbit_at_small_p():
    fates = basin_study.section((0.20, 0.27), (-1.0, 1.1, 0.3), periods=60)
    assert fates.shape == (3, 2)
    np.testing.assert_array_equal(fates[:2, 0], [LEFT, RIGHT])
    assert IRREGULAR in fates[:, 1]
    osc = replace(basin_study.oscillator(0.1, mu=0.27), p=0.1)
    large = basin_study.fate(osc, (1.3, 1.38), 40, last=16, **basin_study.FRICTION_TIME)
    assert large == LARGE
