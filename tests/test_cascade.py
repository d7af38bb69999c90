"""Chaos inside one well: its cascade against brute force, its accumulation against Feigenbaum's ratio."""

import numpy as np
import pytest

from book.studies import cascade as study
from duffing import ConvergenceError, homoclinic_tangency, lyapunov_spectrum, poincare_section
from duffing.oscillator import Duffing
from duffing.transients.lifetimes import returns


@pytest.fixture(scope="module")
def found():
    return study.cascade(0.1, 1.0, (0.1, 1.0), 3)


def test_between_the_flips_orbits_have_the_doubled_periods(found):
    for k, p in enumerate((0.1, 1.0)):
        first, second, third, _ = found.flips[:, k]
        for mu, period in (((first + second) / 2, 2), ((second + third) / 2, 4)):
            points = poincare_section(Duffing(0.1, p, mu), found.state[:, k], 30, transient=600)
            assert returns(points[..., None], 1e-5)[0] == period, (p, mu)
            assert points[0].min() > 0


def test_intervals_between_the_flips_shrink_by_feigenbaums_ratio(found):
    assert np.all(np.diff(found.flips, axis=0) > 0)
    off = np.abs(found.ratio / study.FEIGENBAUM - 1)
    assert np.all(off[1] < off[0])
    assert np.all(off[1] < 0.15)
    fewer = study.cascade(0.1, 1.0, (0.1, 1.0), 2)
    np.testing.assert_array_equal(fewer.flips, found.flips[:3])
    np.testing.assert_allclose(fewer.accumulation, found.accumulation, atol=5e-5)


def test_motion_in_a_well_is_chaotic_before_the_end_and_captured_after_it(found):
    up = study.swept(0.1, 1.0, (0.1, 1.0), doublings=3)
    for k, p in enumerate((0.1, 1.0)):
        start, end = found.accumulation[k], up.end[k]
        assert 1e-4 < end - start < 1e-3
        before, after = Duffing(0.1, p, 0.3 * start + 0.7 * end), Duffing(0.1, p, end + 2e-4)
        spectrum = lyapunov_spectrum(before, found.state[:, k] + 1e-4, 1500, 200, k=1)
        assert spectrum.exponents[0] > 5 * spectrum.error[0]
        assert poincare_section(before, found.state[:, k] + 1e-4, 1500)[0].min() > 0
        late = poincare_section(after, found.state[:, k], 2000, rtol=1e-8, atol=1e-10)[:, -30:]
        assert returns(late[..., None], 1e-4)[0] == 1


def test_at_small_p_the_accumulation_is_near_the_critical_amplitude_by_accident():
    ratio = [
        study.cascade(alpha, omega, 0.1).accumulation[0] / study.critical_amplitude(Duffing(alpha, 0.1, 0.0, omega))
        for alpha, omega in ((0.1, 1.0), (0.1, 0.9), (0.1, 1.2), (0.05, 1.0), (0.3, 1.0))
    ]
    assert abs(ratio[0] - 1) < 0.02
    assert ratio[1] < 0.96 and ratio[2] > 1.3 and ratio[3] > 1.2 and ratio[4] < 0.92


def test_chaos_in_a_well_can_come_before_the_homoclinic_tangency():
    osc = Duffing(0.3, 1.0, 0.2230)
    assert osc.mu < 0.99 * homoclinic_tangency(osc)
    assert study.cascade(0.3, 1.0, 1.0).accumulation[0] < osc.mu
    found = study.share(0.3, 1.0, 1.0, osc.mu, columns=8, rows=6, periods=600)
    assert found.share > 0.02 and found.cross == 0
    assert found.exponent > 0.01


def test_shares_count_what_has_not_settled_by_where_it_moves():
    inside = study.share(0.1, 1.0, 1.0, 0.1029, columns=12, rows=8, periods=400)
    assert inside.starts == 96 and 0 < inside.share < 0.2 and inside.cross == 0
    between = study.share(0.14, 1.05, 1.0, 0.24, columns=3, rows=2, periods=200)
    assert (between.share, between.cross) == (0, 1)
    assert np.isnan(between.exponent)
    nothing = study.share(0.1, 1.0, 1.0, 0.05, columns=3, rows=2, periods=200)
    assert (nothing.share, nothing.cross) == (0, 0)


def test_an_oscillator_whose_small_orbit_has_no_fold_is_named():
    with pytest.raises(ConvergenceError, match=r"omega = 1.5.*no fold of the in-well orbit was found"):
        study.small_folds(0.1, 1.5, 1.0)
