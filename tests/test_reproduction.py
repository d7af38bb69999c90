"""The paper's curves by its own algorithm, and the numbers of its text."""

import numpy as np
import pytest

from book.studies import reproduction
from duffing import lyapunov_spectrum, paper


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


def test_the_papers_numbers_are_those_of_its_text():
    assert paper.START == (0.45, 0.1) and paper.STEPS_PER_PERIOD == 500 and paper.THRESHOLD == 0.1
    assert (paper.SETTLED, paper.END) == (1200, 1500)
    assert (paper.LAMBDA_CHAOTIC, paper.LAMBDA_REGULAR) == (0.175, -0.023)
    assert (paper.MU_CHAOTIC, paper.MU_REGULAR, paper.P_SMALL, paper.P_LINEAR) == (0.27, 0.25, 0.1, 1.0)
    assert round(paper.OSCILLATOR.omega * paper.END / (2 * np.pi)) == paper.PERIODS
