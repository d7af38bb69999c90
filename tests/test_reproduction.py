"""The paper's data: its parameters, the recovered ones among them."""

import numpy as np
import pytest

from book.studies import reproduction
from duffing import lyapunov_spectrum, paper
from duffing.flow import integrate


def test_the_grid_of_mu_holds_the_papers_values_exactly():
    mu = reproduction.mu_grid()
    assert mu.size == 501
    assert {0.0, 0.25, 0.267, 0.27, 0.5} <= set(mu)


def test_exponent_curve_is_the_papers_algorithm_member_by_member():
    mu, exponent = reproduction.exponent_curve(0.5, step=0.1, last=0.2)
    for value, found in zip(mu, exponent, strict=True):
        osc = paper.Duffing(alpha=0.1, p=0.5, mu=value, omega=1.0)
        alone = lyapunov_spectrum(osc, (0.45, 0.1), 239, 0, k=1, method="rk4", steps_per_period=500)
        assert found == alone.exponents[0]


def test_onset_is_the_first_mu_above_the_threshold():
    (onset,) = reproduction.onsets((0.1,))
    mu, exponent = reproduction.exponent_curve(0.1)
    assert exponent[np.searchsorted(mu, onset)] > paper.THRESHOLD
    assert not np.any(exponent[mu < onset] > paper.THRESHOLD)
    assert np.isnan(reproduction.onsets((0.1,), step=0.05, last=0.2)[0])


@pytest.mark.parametrize("mu", [0.25, 0.27])
def test_every_stroboscopic_point_lies_on_the_path_whole_periods_after_the_start(mu):
    motion, period = reproduction.motion(mu), 2 * np.pi
    assert motion.points.shape[1] == int(1500 / period)
    for k, point in enumerate(motion.points.T, start=1):
        near = np.argmin(np.abs(motion.t - k * period))
        assert motion.t[near] == pytest.approx(k * period, rel=1e-12)
        np.testing.assert_array_equal(motion.path[:, near], point)


def test_the_parts_of_a_motion_join_without_loss():
    motion, period = reproduction.motion(0.2, end=70.0), 2 * np.pi
    early, late = motion.part(0.0, 30.0, period), motion.part(30.0, 70.0, period)
    assert early[1].shape[1] + late[1].shape[1] == motion.points.shape[1] == 11
    assert early[0].shape[1] + late[0].shape[1] == motion.t.size


def test_the_recovered_pair_meets_every_criterion_and_few_others_do():
    scan = reproduction.parameter_scan()
    agrees = reproduction.survivors(scan)["all five"]
    i, j = np.argwhere((scan.alpha[:, None] == 0.1) & (scan.omega == 1.0))[0]
    assert agrees[i, j]
    assert agrees.sum() <= 6


def test_only_the_recovered_pair_has_its_onset_at_the_papers_place():
    scan = reproduction.parameter_scan()
    left = np.argwhere(reproduction.survivors(scan)["all five"])
    onset = {}
    for i, j in left:
        osc = paper.Duffing(alpha=float(scan.alpha[i]), p=0.1, omega=float(scan.omega[j]))
        onset[scan.alpha[i], scan.omega[j]] = reproduction.onsets((0.1,), osc=osc)[0]
    inside = [pair for pair, value in onset.items() if abs(value - 0.27) < 0.005]
    assert inside == [(pytest.approx(0.1), pytest.approx(1.0))]


def test_amplitude_and_wells_of_the_scan_are_those_of_each_late_motion():
    scan = reproduction.parameter_scan()
    omega, alpha = np.meshgrid(scan.omega, scan.alpha)
    osc = paper.Duffing(alpha=alpha, p=0.1, omega=omega, mu=0.25)
    t = np.append(0.0, 229 + np.arange(101) / 10)[:, None] * 2 * np.pi / omega.ravel()
    x = integrate(osc, (0.45, 0.1), t, method="rk4").states[0, 1:].reshape(-1, *omega.shape)
    both = (x.max(axis=0) > 0) & (x.min(axis=0) < 0)
    np.testing.assert_array_equal(scan.wells, np.where(both, 2, 1))
    np.testing.assert_allclose(scan.amplitude, (x.max(axis=0) - x.min(axis=0)) / 2)


def test_the_papers_numbers_are_those_of_its_text():
    assert paper.START == (0.45, 0.1) and paper.STEPS_PER_PERIOD == 500 and paper.THRESHOLD == 0.1
    assert (paper.SETTLED, paper.END) == (1200, 1500)
    assert (paper.LAMBDA_CHAOTIC, paper.LAMBDA_REGULAR) == (0.175, -0.023)
    assert (paper.MU_CHAOTIC, paper.MU_REGULAR, paper.P_SMALL, paper.P_LINEAR) == (0.27, 0.25, 0.1, 1.0)
    assert round(paper.OSCILLATOR.omega * paper.END / (2 * np.pi)) == paper.PERIODS
