"""Resonance curves: the ordering of the exponents in a well, its reversal round both, and why."""

import numpy as np
import pytest
from scipy.integrate import quad

from duffing import ConvergenceError, Duffing
from duffing.book import resonance_study as resonance
from duffing.orbits.bifurcations import FOLD
from duffing.orbits.followed import at_exponent, curves, speed
from duffing.orbits.periodic import half_return, periodic_orbits


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
        done = half_return(Duffing(p=p, mu=mu, omega=omega), state, 1)
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
        matrix = half_return(fold.osc, fold.state, 1).derivative[:, :, 0]
        assert abs(np.linalg.det(matrix - np.eye(2))) < 1e-5
        np.testing.assert_allclose(half_return(fold.osc, fold.state, 1).image[:, 0], fold.state, atol=1e-8)
