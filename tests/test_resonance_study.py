"""Resonance curves: the ordering of the exponents in a well, its reversal round both, and why."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from book.studies import resonance
from book.studies.followed import amplitude, at_exponent, curves, speed
from duffing import ConvergenceError, Duffing, paper, poincare_section
from duffing.orbits.bifurcations import FOLD
from duffing.orbits.continuation import BOUND
from duffing.orbits.periodic import half_period_map, periodic_orbits


@pytest.mark.parametrize("p", [0.1, 0.5, 2.0, 3.0])
def test_equal_braking_takes_the_energy_that_linear_damping_takes(p):
    v = float(resonance.equal_braking(p))
    taken = [quad(lambda t, q=q: np.abs(v * np.sin(t)) ** (q + 1), 0, np.pi)[0] for q in (p, 1.0)]
    assert taken[0] == pytest.approx(taken[1], rel=1e-6)


def test_equal_braking_needs_another_exponent_than_one():
    with pytest.raises(ValueError, match=r"p = 1.0: must differ from 1"):
        resonance.equal_braking(1.0)
    with pytest.raises(ValueError, match=r"p = -1: must be a finite number > 0"):
        resonance.equal_braking(-1)


@pytest.fixture(scope="module")
def moderate():
    return resonance.response(0.12)


@pytest.fixture(scope="module")
def drawn(moderate):
    return {p: curves(at_exponent(moderate, p)) for p in resonance.EXPONENTS}


def stable_amplitudes(drawn, omega, upper):
    """Stable amplitude at omega for each exponent, the greatest or the least one that the curves have there."""
    result = []
    for p in resonance.EXPONENTS:
        found = []
        for _, where, value, stable in drawn[p]:
            for j in np.flatnonzero((where[1:] - omega) * (where[:-1] - omega) < 0):
                if stable[j] and stable[j + 1]:
                    share = (omega - where[j]) / (where[j + 1] - where[j])
                    found.append((1 - share) * value[j] + share * value[j + 1])
        result.append(max(found) if upper else min(found))
    return np.array(result)


@pytest.mark.parametrize(("omega", "upper"), [(2.0, True), (1.6, True), (1.4, True), (1.2, True), (1.0, False)])
def test_in_a_well_a_smaller_exponent_gives_the_smaller_amplitude(drawn, omega, upper):
    amplitudes = stable_amplitudes(drawn, omega, upper)
    assert np.all(np.diff(amplitudes) > -1e-3)  # the curves of p >= 1 coincide away from the peaks, within sampling
    assert amplitudes[0] < 0.97 * amplitudes[3]


@pytest.mark.parametrize("mu", [0.03, 0.12])
def test_every_branch_of_the_response_ends_at_the_border_of_its_range(mu):
    for one in resonance.response(mu):
        assert one.branch.end == BOUND
        assert one.branch.parameter[-1] in (0.5, 0.65, 0.9, 2.2)


def test_a_branch_that_ends_inside_its_range_is_a_named_error():
    """Below omega = 0.63 the orbits that turn back at p = 1 to 3 need more steps than there are."""
    with pytest.raises(ConvergenceError, match=r"p = 3, mu = 0.12: .* ends at omega = 0\.6.*inside its range"):
        resonance.response(0.12, p=(3.0,), turned=0.5)


@pytest.mark.parametrize("mu", [0.03, 0.12])
def test_superharmonic_peak_near_0_7_is_what_a_run_settles_on(mu):
    """Between the folds of p = 3, or at the peak of p = 2: the greater stable amplitude is met, carried on in time."""
    for p in (2.0, 3.0):
        chosen = at_exponent(resonance.response(mu), p)
        tops = []
        for one in chosen:
            omega, stable = one.branch.parameter, one.branch.stable
            near = np.flatnonzero((np.abs(omega - 0.69) < 0.03) & stable)
            if near.size:
                size = amplitude(one.branch.osc, one.branch.state, 2)[near]
                tops.append((size.max(), omega[near[size.argmax()]], *one.branch.state[:, near[size.argmax()]]))
        size, omega, *state = max(tops)
        osc = replace(paper.OSCILLATOR, p=p, mu=mu, omega=omega)
        assert size > {0.03: 0.07, 0.12: 0.15}[mu]
        late = poincare_section(osc, np.array(state) + 1e-5, 400, method="friction")[:, -1]
        np.testing.assert_allclose(late, state, atol=1e-4)


def test_folds_of_the_weak_superharmonic_peak_bound_the_coexistence_of_two_stable_orbits():
    """At mu = 0.03, p = 3 the starts of Newton's method find one orbit outside the folds and three between."""
    folds = sorted(
        {round(float(f.osc.omega), 6) for one in at_exponent(resonance.response(0.03), 3.0) for f in one.found}
    )
    low, high = (omega for omega in folds if omega < 0.8)
    starts = np.reshape(np.meshgrid(np.linspace(0.8, 1.2, 9), np.linspace(-0.25, 0.25, 9)), (2, -1))
    counts = []
    for omega in (low - 0.004, (low + high) / 2, high + 0.004):
        osc = replace(paper.OSCILLATOR, p=3.0, mu=0.03, omega=omega)
        found = periodic_orbits(osc, starts, 2).state
        counts.append(int(np.sum(amplitude(replace(osc, mu=np.full(found.shape[1], 0.03)), found, 2) < 0.3)))
    assert counts == [1, 3, 1]


@pytest.mark.parametrize(("mu", "least"), [(0.03, 5e-4), (0.12, 3e-3)])
def test_below_1_a_smaller_exponent_is_lower_at_every_frequency_and_above_1_not_quite(mu, least):
    assert resonance.reversal(mu, (0.1, 0.3, 0.5))[0] < 1e-3
    most, first, last = resonance.reversal(mu, (1.0, 2.0))
    assert most > least
    assert 0.5 <= first < 0.7 < last < 0.85


def test_meetings_are_crossings_at_which_the_orbit_is_about_as_fast_as_equal_braking():
    found = resonance.meetings()
    assert [one.p for one in found] == [p for p in resonance.EXPONENTS if p != 1]
    for one in found:
        osc = replace(paper.OSCILLATOR, p=one.p, mu=one.mu + 1e-4, omega=one.omega)
        starts = np.reshape(np.meshgrid(np.linspace(-0.4, 0.4, 7), np.linspace(0.9, 1.3, 5)), (2, -1))
        pair = periodic_orbits(osc, starts, 1).state
        fast = pair[:, pair[1] > 0.5]
        assert fast.shape[1] == 2
        speeds = [float(speed(osc, state, 1)) for state in fast.T]
        assert min(speeds) - 1e-3 < one.speed < max(speeds) + 1e-3
        assert one.equal == float(resonance.equal_braking(one.p))
        assert abs(one.speed / one.equal - 1) < 0.1


def test_in_a_well_every_stable_orbit_is_slower_than_equal_braking_asks(moderate):
    fastest = max(value[stable].max() for *_, value, stable in curves(moderate, speed))
    assert fastest < min(resonance.equal_braking(p) for p in resonance.EXPONENTS if p != 1)


def test_response_is_complete_at_both_folds_of_the_resonance(moderate, drawn):
    """Between the folds there are two stable amplitudes, outside one: at p = 0.1 with exact folds on both sides."""
    folds = sorted({round(float(f.osc.omega), 6) for one in at_exponent(moderate, 0.1) for f in one.found})
    assert len(folds) == 2
    middle = sum(folds) / 2
    two = [stable_amplitudes(drawn, middle, upper)[0] for upper in (True, False)]
    assert two[0] > 2 * two[1]
    for outside in (folds[0] - 0.05, folds[1] + 0.05):
        one = [stable_amplitudes(drawn, outside, upper)[0] for upper in (True, False)]
        assert one[0] == pytest.approx(one[1], rel=1e-2)


def test_round_both_wells_a_smaller_exponent_reaches_a_higher_frequency():
    every = resonance.large_response(0.3)
    last = [max([one.branch.parameter.max() for one in at_exponent(every, p)]) for p in resonance.EXPONENTS]
    assert np.all(np.diff(last) <= 0)
    assert last[0] == last[2] == 2.2
    assert last[3] > last[4] > last[5]


def test_least_forcing_is_a_fold_of_symmetric_orbits_and_below_it_there_are_none():
    for p, (omega, mu, state) in resonance.least_forcing((0.1, 1.0)).items():
        assert np.all(np.diff(omega) > 0)
        assert (omega[0], omega[-1]) == (0.5, 2.2)
        done = half_period_map(Duffing(p=p, mu=mu, omega=omega), state, 1)
        np.testing.assert_allclose(done.image, state, atol=1e-6)
        assert np.all(np.abs(np.linalg.det(np.moveaxis(done.derivative, -1, 0) - np.eye(2))) < 1e-4)
        j = omega.size // 2
        starts = state[:, j, None] + 0.05 * np.array([[1, 1, -1, -1, 0], [1, -1, 1, -1, 0]])
        counts = []
        for step in (-1e-3, 1e-3):
            found = periodic_orbits(Duffing(p=p, mu=mu[j] + step, omega=omega[j]), starts, 1).state
            counts.append(int(np.sum(np.hypot(*(found - state[:, j, None])) < 0.3)))
        assert counts == [0, 2]


def test_order_of_the_exponents_turns_over_where_the_curves_cross():
    least = resonance.least_forcing()
    for p in resonance.EXPONENTS:
        if p == 1:
            continue
        omega, mu = resonance.crossing(least[p], least[1.0])
        one, other = (np.interp([omega - 0.1, omega, omega + 0.1], *least[q][:2]) for q in (p, 1.0))
        assert one[1] == pytest.approx(mu, rel=1e-3)
        assert other[1] == pytest.approx(mu, rel=1e-3)
        assert np.sign(one - other)[[0, 2]].tolist() == ([1, -1] if p < 1 else [-1, 1])


def line(first, last):
    return resonance.Threshold(np.array([0.0, 1.0]), np.array([first, last]), np.zeros((2, 2)))


def test_curves_that_do_not_cross_are_a_named_error():
    with pytest.raises(ConvergenceError, match="do not cross between omega = 0 and 1"):
        resonance.crossing(line(0.0, 1.0), line(1.0, 2.0))


def test_crossing_of_straight_lines_is_exact():
    assert resonance.crossing(line(0.0, 1.0), line(0.45, 0.2)) == pytest.approx((0.36, 0.36), abs=1e-12)


def test_folds_of_the_large_response_are_degenerate_orbits():
    folds = [f for one in resonance.large_response(0.3) for f in one.found if f.kind == FOLD]
    assert folds
    for fold in folds:
        matrix = half_period_map(fold.osc, fold.state, 1).derivative[:, :, 0]
        assert abs(np.linalg.det(matrix - np.eye(2))) < 1e-5
        np.testing.assert_allclose(half_period_map(fold.osc, fold.state, 1).image[:, 0], fold.state, atol=1e-8)
