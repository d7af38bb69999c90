"""What the chapter on basins states: each number against another way to it."""

from dataclasses import replace

import numpy as np
import pytest

from book.studies import basins as basin_study
from book.studies.accuracy import STATISTICS
from duffing import ConvergenceError, Duffing, critical_amplitude, homoclinic_tangency, saddle_orbit
from duffing.basins.basins import KINDS
from duffing.basins.boundary import boundary_dimension, crossings, line_of_starts
from duffing.basins.contact import first_contact, homoclinic_strips
from duffing.basins.fates import IRREGULAR, LARGE, LEFT, RIGHT, classify

RK4 = {"method": "rk4", "steps_per_period": 200}


def linear(ratio):
    return Duffing(mu=ratio * critical_amplitude(Duffing()))


def test_the_manifolds_have_met_above_the_primary_tangency_and_not_well_below_it():
    tangency = homoclinic_tangency(Duffing())
    assert homoclinic_strips(Duffing(mu=0.995 * tangency), **RK4) == 0
    assert homoclinic_strips(Duffing(mu=1.001 * tangency), **RK4) > 0


def test_strips_do_not_depend_on_the_unit_of_length():
    """A found failure: cells of wells a hundredth as wide were hardly ever halved, and most strips not seen."""
    ours, small = Duffing(mu=0.1), Duffing(mu=0.1 / 128, gamma=2.0**14)
    assert small.dimensionless() == ours
    assert homoclinic_strips(small, **RK4) == homoclinic_strips(ours, **RK4) > 100


def test_manifolds_first_meet_at_the_primary_tangency():
    low, high = basin_study.contact(1.0)
    assert high - low == pytest.approx(3e-3 / 2**8)
    assert low < basin_study.tangency_ratio(1.0) < high


def test_orbits_that_linger_below_the_tangency_are_no_contact():
    """Their fates differ after 14 periods, at one of the forcings after 40 too; none of them goes over."""
    for ratio, after in ((0.999467, 40), (0.9998, 14), (0.99999, 14)):
        osc = Duffing(mu=ratio * homoclinic_tangency(Duffing()))
        saddle = saddle_orbit(osc)
        ends = (saddle.state + 1e-7 * stretch * saddle.unstable for stretch in (1.0, saddle.multipliers[0]))
        line = line_of_starts(osc, *ends, after, **RK4)
        found = crossings(line, least=1e-9, most=30_000)
        assert set(line(np.append(found.left, found.right))[1]) == {RIGHT, IRREGULAR}
        assert [homoclinic_strips(osc, periods, **RK4) for periods in (14, 40)] == [0, 0]


def test_strips_above_the_tangency_do_not_depend_on_the_periods():
    for ratio in (1.00001, 1.0002, 1.001):
        osc = Duffing(mu=ratio * homoclinic_tangency(Duffing()))
        few, more = (homoclinic_strips(osc, periods, **RK4) for periods in (14, 30))
        assert few == more > 0


def test_crossings_next_to_the_tangency_part_the_wells_however_long_they_are_followed():
    for ratio in (0.9995, 1.0005):
        found = basin_study.strips(1.0, ratio)
        rk4 = {"method": "rk4", "steps_per_period": 96}
        line = line_of_starts(linear(ratio), *basin_study.AXIS, 60, **rk4)
        left, right = line(found.left)[1], line(found.right)[1]
        assert set(left) == set(right) == {LEFT, RIGHT} and np.all(left != right)
        assert crossings(line, most=30_000).left == pytest.approx(found.left, abs=found.width)


def test_the_accurate_integrator_sees_the_strips_on_the_same_side_of_the_tangency():
    tangency = homoclinic_tangency(Duffing())
    before, after = (
        homoclinic_strips(Duffing(mu=ratio * tangency), most=1500, rtol=1e-10, atol=1e-12) for ratio in (0.9995, 1.0005)
    )
    assert before == 0 < after


def test_a_bracket_that_holds_no_contact_is_refused():
    mu_c = critical_amplitude(Duffing())
    with pytest.raises(ConvergenceError, match="do not meet"):
        first_contact(Duffing(), 0.8 * mu_c, 0.9 * mu_c, **RK4)
    with pytest.raises(ConvergenceError, match="the manifolds meet"):
        first_contact(Duffing(), 1.05 * mu_c, 1.1 * mu_c, **RK4)


def test_dimension_leaves_one_at_the_tangency_for_linear_damping():
    ratios = (0.9995, 1.0005, 2.0)
    values, errors, number = basin_study.line_dimensions(1.0, ratios, most=30_000)
    assert ratios[0] < homoclinic_tangency(Duffing()) / critical_amplitude(Duffing()) < ratios[1]
    assert abs(values[0] - 1) <= errors[0] + 1e-12 < 0.02  # rounding: the error itself is none where no strip is left
    assert values[1] - 1 > 3 * errors[1] > 0
    assert np.all(np.diff(values) > 0.15) and values[2] < 2
    assert np.all(np.diff(number) > 0)


def test_crowding_crossings_below_the_tangency_have_dimension_one_when_the_cells_part_them():
    values, errors, number = basin_study.line_dimensions(0.5, (0.994, 0.994), most=(10_000, 40_000))
    assert number[0] == number[1]  # four times the starts find no strip more
    assert abs(values[1] - 1) <= errors[1] + 1e-12 < 0.02 < values[0] - 1


def test_dimension_leaves_one_at_the_tangency_at_small_p():
    """Below it the boundary crosses the line a few times, however near the tangency is; above it more often."""
    osc = basin_study.oscillator(0.1, 1.0)
    tangency = homoclinic_tangency(osc) / osc.mu
    far, before, after = (basin_study.strips(0.1, f * tangency, 3000).left.size for f in (0.99, 0.998, 1.002))
    assert far == before < 10
    assert after > 3 * before


def test_friction_time_fixed_steps_and_random_starts_see_the_same_dimension_at_small_p():
    most, ratios = 3000, (0.96, 0.99, 1.1)
    values, errors, _ = basin_study.line_dimensions(0.1, ratios, most)
    for ratio, value in zip(ratios, values, strict=True):
        fixed = {"method": "rk4", "steps_per_period": 600}
        line = line_of_starts(basin_study.oscillator(0.1, ratio), *basin_study.AXIS, 16, **fixed)
        assert value == pytest.approx(boundary_dimension(crossings(line, most=most)).value, abs=0.03)
    assert abs(values[0] - 1) <= errors[0] + 1e-12 < 0.02
    assert np.all(values[1:] - 1 > 3 * errors[1:])
    random, doubt = basin_study.random_dimensions(0.1, (1.1,), starts=2**9)
    assert abs(values[2] - random[0]) < 3 * np.hypot(errors[2], doubt[0])


def test_more_starts_see_more_crossings_at_small_p_where_the_boundary_is_a_fractal():
    _, _, curve = basin_study.line_dimensions(0.1, (0.96, 0.96), (2000, 6000))
    values, errors, fractal = basin_study.line_dimensions(0.1, (0.98, 0.98), (2000, 6000))
    assert curve[0] == curve[1] and fractal[1] > 1.3 * fractal[0]
    assert np.all(values - 1 > 3 * errors)


def test_strips_that_fixed_steps_invent_at_small_p_are_not_in_friction_time():
    ratio, most = 0.92, 6000
    seen = basin_study.strips(0.1, ratio, most)
    line = line_of_starts(basin_study.oscillator(0.1, ratio), *basin_study.AXIS, 16, method="rk4", steps_per_period=300)
    assert seen.left.size == 2 < crossings(line, most=most).left.size


def test_line_and_random_starts_agree_on_the_dimension():
    line, scatter, _ = basin_study.line_dimensions(1.0, (2.0,), most=30_000)
    random, error = basin_study.random_dimensions(1.0, (2.0,), starts=2**11)
    assert abs(line[0] - random[0]) < 3 * np.hypot(error[0], scatter[0]) + 0.01


def test_twice_the_steps_and_more_periods_leave_the_dimension():
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
    large = classify(osc, (1.3, 1.38), 40, last=16, **STATISTICS)
    assert large == LARGE


def test_the_dimension_counted_near_a_tangency_solves_its_sum():
    """4 (l^(-nd) + l^(-(n + 1)d) + ...) = 1 with n = ln(1/distance)/ln(l): here n = 2, l = 10, the sum term by term."""
    d = basin_study.counted_dimension(1e-2, 10.0)
    assert 4 * sum(10.0 ** (-n * d) for n in range(2, 400)) == pytest.approx(1.0)
    assert basin_study.counted_dimension(1e-8, 10.0) < d < basin_study.counted_dimension(1e-1, 10.0)


def test_at_the_papers_regular_forcing_every_resolved_start_ends_in_a_well_or_on_the_large_orbit():
    found = basin_study.picture(0.1, mu=basin_study.paper.MU_REGULAR, size=32)
    assert {KINDS[k] for k in found.kinds} == {"left well", "right well", "round both wells", "unresolved"}
    assert found.shares[-1] < 0.01
