"""Where chaos between the wells lasts: the borders against brute force, on both sides of each and of their apex."""

import numpy as np
import pytest

from book.studies import plane, plane_maps
from duffing import ConvergenceError, critical_amplitude, lyapunov_spectrum
from duffing.oscillator import Duffing

OMEGA = (1.1, 1.175)  # below the first the fold is the lower border at p = 1, at the second the doublings are


def across(omega, p, mu, alpha=0.1, periods=500):
    return plane.lasting(alpha, omega, p, tuple(mu), columns=2, rows=2, periods=periods).across


@pytest.fixture(scope="module")
def borders():
    return plane.borders(0.1, OMEGA, 1.0)


def test_the_lower_border_is_the_fold_and_further_right_the_doublings_in_the_well(borders):
    assert borders.fold[0] > borders.inside[0] + 0.02
    assert borders.inside[1] > borders.fold[1] + 0.02
    assert np.all(borders.crisis > borders.fold)
    np.testing.assert_allclose(borders.critical, critical_amplitude(Duffing(0.1, 1.0, 0.0, np.array(OMEGA))))


def test_chaos_lasts_between_the_borders_and_not_outside_them(borders):
    for k, omega in enumerate(OMEGA):
        low, high = max(borders.fold[k], borders.inside[k]), borders.crisis[k]
        between = low + (high - low) * np.linspace(0.1, 0.9, 9)  # some fall into periodic windows
        assert np.sum(across(omega, 1.0, between) > 0) >= 7
        assert not across(omega, 1.0, (low - 0.02, low - 0.01, high + 0.01, high + 0.02)).any()


def test_at_small_p_chaos_lasts_between_the_borders_and_not_outside_them():
    found = plane.borders(0.1, (1.05,), 0.1)
    low, high = float(max(found.fold[0], found.inside[0])), float(found.crisis[0])
    assert np.sum(across(1.05, 0.1, np.linspace(low + 0.01, high - 0.01, 4), periods=300) > 0) >= 3
    assert not across(1.05, 0.1, (low - 0.01, high + 0.02)).any()


def test_one_per_cent_of_the_frequency_makes_a_window_at_p_1_and_closes_that_at_p_0_1():
    fine = np.arange(0.230, 0.2601, 0.003)
    assert across(1.01, 1.0, fine).max() == 1
    assert across(0.995, 1.0, fine + 0.002, periods=800).max() == 0
    assert across(1.0, 0.1, (0.268, 0.271, 0.274)).min() > 0.5
    assert across(0.985, 0.1, np.arange(0.262, 0.2901, 0.004), periods=800).max() == 0


def test_the_sign_at_the_fold_is_that_of_fold_less_crisis(borders):
    found = plane.borders(0.1, (0.98, 1.02), 1.0)
    np.testing.assert_array_equal(plane.leaks_at_fold(0.1, (0.98, 1.02), 1.0), found.fold > found.crisis)
    assert found.fold[0] > found.crisis[0]
    assert found.fold[1] < found.crisis[1]


def test_the_apex_lies_between_frequencies_of_different_order():
    (omega,) = plane.apex((0.12,), 1.0, reach=0.04, halvings=3)
    assert list(plane.leaks_at_fold(0.12, (omega - 0.01, omega + 0.01), 1.0)) == [True, False]
    with pytest.raises(ConvergenceError, match=r"alpha = 0.12, p = 1: fold and crisis keep their order"):
        plane.apex((0.12,), 1.0, reach=0.001)


def test_shares_are_of_the_initial_conditions_and_exponents_of_the_chaotic_ones():
    found = plane.lasting(0.14, 1.05, 1.0, (0.05, 0.24), columns=2, rows=2, periods=300)
    np.testing.assert_array_equal(found.across, [0, 1])
    np.testing.assert_array_equal(found.inside, [0, 0])
    assert np.isnan(found.exponent[0])
    other = lyapunov_spectrum(Duffing(0.14, 1.0, 0.24, 1.05), (0.3, 0.2), 1000, 200, k=1, method="rk4")
    assert abs(found.exponent[1] - other.exponents[0]) < 5 * np.hypot(found.error[1], other.error[0])


def test_chaos_in_one_well_is_not_counted_as_chaos_between_the_wells():
    """At alpha = 0.3, p = 1 the doublings accumulate at 0.2222, where the small orbit still attracts."""
    found = plane.lasting(0.3, 1.0, 1.0, (0.2235,), columns=8, rows=6, periods=300)
    assert found.across[0] == 0 < found.inside[0] < 1


def test_two_exponents_are_compared_where_both_have_lasting_chaos():
    mu, sizes = (0.05, 0.25, 0.3125), {"columns": 2, "rows": 2, "periods": 200}
    found = plane.compared((0.14, 1.05), mu, **sizes)
    parts = [plane.lasting(0.14, 1.05, p, mu, **sizes) for p in plane.EXPONENTS]
    both = (parts[0].across >= 0.5) & (parts[1].across >= 0.5)
    change = (parts[0].exponent - parts[1].exponent)[both]
    assert found.forcings == both.sum() > 0
    assert found.smaller == np.sum(change < 0)
    assert found.difference == pytest.approx(change.mean())
    assert np.all(found.first[:, 0] >= 0.25)
    assert plane.compared((0.1, 1.0), (0.05, 0.1), **sizes).forcings == 0


def test_agreement_counts_cells_between_lines():
    """Two columns, six rows; between the lines 2.5 and 4.5 lie the rows 3 and 4, near them 2 and 5."""
    found = plane.Borders(None, np.array([2.5, 2.5]), np.array([1.0, 2.4]), np.array([4.5, 4.5]))
    mu, x = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0), (0.0, 1.0)
    shares = np.array([[1, 0], [1, 0], [0, 1], [1, 1], [1, 0], [0, 1]])
    inside, filled = plane.agreement(x, mu, shares, x, found)
    assert (inside, filled) == (pytest.approx(5 / 7), pytest.approx(3 / 4))


def test_neighbours_are_a_pair_and_the_eight_around_it():
    found = {tuple(pair) for pair in plane_maps.neighbours(0.1, 1.0).T.tolist()}
    assert found == {(a, w) for a in (0.099, 0.1, 0.101) for w in (0.99, 1.0, 1.01)}
