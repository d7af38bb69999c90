"""The growth of the distance to a companion: against the tangent, an exact contraction, and invalid input."""

import numpy as np
import pytest

from duffing import lyapunov_spectrum, two_trajectory_exponent
from duffing.errors import DivergedError
from duffing.integrators import rk4
from duffing.integrators.companion import two_trajectory_growth
from duffing.oscillator import Duffing

START = (0.45, 0.1)


@pytest.mark.parametrize("p", [1.0, 2.0])
def test_growth_of_two_trajectories_tends_to_the_tangents_in_proportion_to_d0(p):
    osc = Duffing(p=p, mu=np.array([0.05, 0.1]))
    tangent = rk4.integrate(osc, START, osc.period * np.arange(5), tangents=1).growth[0]
    errors = [np.abs(two_trajectory_growth(osc, START, 4, d0=d0) - tangent).max(axis=0) for d0 in (1e-5, 1e-6)]
    assert errors[1].shape == (2,)
    assert np.all(errors[1] < 1e-3)
    assert np.all(np.abs(errors[0] / errors[1] - 10) < 0.2)


def test_companion_that_merges_gives_a_finite_upper_bound_and_starts_anew():
    # Critical damping shrinks the separation by (1 + T or less) exp(-T), T = 4 pi, in each period: far below a unit
    # in the last place of the motion when d0 is a few of them.
    osc = Duffing(alpha=2.0, p=1, mu=1.0, delta=1.0, gamma=0.0, omega=0.5)
    d0 = 1e-15
    growth = two_trajectory_growth(osc, START, 12, d0=d0)
    exact = np.log(1 + osc.period) - osc.period
    assert np.all(growth >= np.log(2.0**-54 / (2 * d0)))
    assert np.all(growth < 0)
    assert np.all(growth > exact)


@pytest.mark.parametrize(
    ("change", "message"), [({"periods": 0}, "periods = 0"), ({"d0": 0.0}, "d0 = 0"), ({"d0": 1e-30}, "d0 = 1e-30")]
)
def test_invalid_input_to_two_trajectories_is_named(change, message):
    with pytest.raises(ValueError, match=message):
        two_trajectory_growth(**({"osc": Duffing(), "state": START, "periods": 2} | change))


def test_a_d0_that_is_lost_on_the_way_is_named():
    """A found failure: at x = 0.01 it can be seen, at x = 1 not, and the growth was infinite."""
    with pytest.raises(ValueError, match=r"d0 = 1e-17: .*\[0\.8"):
        two_trajectory_growth(Duffing(mu=0.27), (0.01, 0.0), 5, d0=1e-17)


def test_diverging_companions_are_named():
    osc = Duffing(delta=1.0, gamma=-1.0, mu=np.array([0.0, 0.01]))
    with pytest.raises(DivergedError, match="gamma = -1"):
        two_trajectory_growth(osc, (3.0, 0.0), 5)


def test_over_a_long_chaotic_run_it_is_the_tangents_exponent_so_the_distance_is_kept_small():
    """Without the reset the distance would saturate, and the mean growth would be ten times too small."""
    osc = Duffing(p=1.0, mu=0.25)
    options = {"periods": 60, "transient": 0, "steps_per_period": 500}
    tangent = lyapunov_spectrum(osc, k=1, method="rk4", **options).exponents[0]
    assert tangent > 0.1
    assert two_trajectory_exponent(osc, d0=1e-8, **options).exponents[0] == pytest.approx(tangent, abs=0.01)


def test_the_transient_is_left_out_of_the_mean():
    osc = Duffing(p=1.0, mu=0.25)
    growth = two_trajectory_growth(osc, (0.45, 0.1), 15)[:, 0]
    found = two_trajectory_exponent(osc, (0.45, 0.1), periods=5, transient=10).exponents[0]
    assert found == pytest.approx(growth[10:].mean() / osc.period, rel=1e-12)
    assert abs(growth[:5].mean() - growth[10:].mean()) > 0.01
