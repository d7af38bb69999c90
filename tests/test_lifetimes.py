"""Lifetimes of transients: against linear oscillators, whose way to the periodic orbit is known, and the symmetry."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg

from duffing import Duffing, lyapunov_spectrum, poincare_section
from duffing.transients.lifetimes import both_wells, lifetimes

LINEAR = Duffing(alpha=0.1, p=1.0, mu=0.5, delta=3.0, gamma=0.0)  # x'' + x'/10 + 3 x = cos(t) / 2


def decay(osc, start, radius, periods=400):
    """The first n from which on all points start + response decay stay within the radius of the response."""
    generator = np.array([[0.0, 1.0], [-osc.delta, -osc.alpha]])
    period_map = scipy.linalg.expm(generator * osc.period)
    amplitude = osc.mu / ((osc.delta - 1) ** 2 + osc.alpha**2)
    response = amplitude * np.array([osc.delta - 1, osc.alpha])
    gap, distances = np.array(start) - response, []
    for _ in range(periods):
        distances.append(np.hypot(*gap))
        gap = period_map @ gap
    return 1 + np.flatnonzero(np.array(distances) > radius)[-1]


@pytest.mark.parametrize("radius", [0.3, 0.1, 0.02])
@pytest.mark.parametrize("block", [40, 23])
def test_lifetime_of_the_linear_oscillator_is_the_time_of_its_decay(radius, block):
    start = (1.0, -2.0)
    found = lifetimes(LINEAR, start, radius=radius, tolerance=1e-6, block=block)
    assert found.time == decay(LINEAR, start, radius)
    assert found.settled and found.multiple == 1
    np.testing.assert_allclose(found.end, poincare_section(LINEAR, start, 1, transient=200)[:, 0], atol=1e-5)


@pytest.mark.parametrize("multiple", [1, 2, 3, 5])
def test_an_undamped_oscillator_repeats_after_as_many_periods_as_its_frequency_says(multiple):
    """x'' + x / q^2 = 0, strobed at 2 pi, repeats after q points, from its first point on."""
    osc = Duffing(alpha=0.0, p=1.0, mu=0.0, delta=1 / multiple**2, gamma=0.0)
    found = lifetimes(osc, (1.0, 0.2), periods=60)
    assert (found.time, found.settled, found.multiple) == (0, True, multiple)


def test_an_orbit_that_never_settles_is_a_censored_observation():
    osc = Duffing(alpha=0.0, p=1.0, mu=0.0, delta=2.0, gamma=0.0)  # incommensurable: sqrt(2) turns a period
    found = lifetimes(osc, (1.0, 0.2), periods=70)
    assert (found.time, found.settled, found.multiple) == (70, False, 0)


def test_an_orbit_captured_before_the_end_is_seen_to_settle_after_it():
    """Near (1, -2) the linear oscillator needs some ten periods to come within 0.1, and many more to repeat itself."""
    time = decay(LINEAR, (1.0, -2.0), 0.1)
    found = lifetimes(LINEAR, (1.0, -2.0), periods=int(time), tolerance=1e-6, block=20)
    assert (found.time, found.settled) == (time, True)
    found = lifetimes(LINEAR, (1.0, -2.0), periods=int(time) - 1, tolerance=1e-6, block=20)
    assert (found.time, found.settled, found.multiple) == (time - 1, False, 0)
    found = lifetimes(LINEAR, (1.0, -2.0), periods=int(time), settling=0, tolerance=1e-6, block=20)
    assert not found.settled


def test_members_are_watched_no_longer_than_they_need_and_keep_their_places():
    family = replace(LINEAR, alpha=np.array([0.1, 0.0, 1.0]), delta=np.array([3.0, 2.0, 3.0]))
    state = np.array([[1.0, 1.0, 0.3], [-2.0, 0.2, 0.1]])
    found = lifetimes(family, state, periods=300, tolerance=1e-6, tangents=1)
    np.testing.assert_array_equal(found.settled, [True, False, True])
    assert found.time[0] == decay(LINEAR, state[:, 0], 0.1)
    assert found.time[1] == 300
    assert np.count_nonzero(found.growth[:, 1]) == 300
    assert np.count_nonzero(found.growth[:, 2]) == 40  # one block


def test_growth_is_that_of_the_lyapunov_exponent():
    """Both exponents of the linear oscillator are -alpha / 2, and its tangent turns, so that whole blocks count."""
    found = lifetimes(LINEAR, (1.0, 0.0), periods=80, block=80, tolerance=1e-12, tangents=1)
    assert found.growth[4:80].mean() / LINEAR.period == pytest.approx(-LINEAR.alpha / 2, abs=2e-3)
    osc = Duffing(p=1.0, mu=0.3)
    found = lifetimes(osc, (0.4, 0.1), periods=30, block=30, tangents=1)
    history = lyapunov_spectrum(osc, (0.4, 0.1), 30, 0, k=1).history[0]
    np.testing.assert_allclose(np.cumsum(found.growth) / osc.period / np.arange(1, 31), history, rtol=1e-12)


def test_a_mirror_image_lives_as_long():
    """(x, v, mu) -> (-x, -v, -mu) leaves the equation as it is."""
    x, v = np.linspace(-1.2, 1.2, 40), np.linspace(0.5, -0.4, 40)
    osc = Duffing(p=1.0, mu=np.full(40, 0.22))
    found = lifetimes(osc, (x, v), 300, method="rk4")
    mirrored = lifetimes(replace(osc, mu=-osc.mu), (-x, -v), 300, method="rk4")
    np.testing.assert_array_equal(found.time, mirrored.time)
    np.testing.assert_array_equal(found.end, -mirrored.end)
    assert found.time.max() > 30
    assert set(found.multiple) == {1, 3}


def test_large_orbits_visit_both_wells_and_small_ones_do_not():
    osc = Duffing(p=1.0, mu=np.array([0.15, 0.15, 0.3]))
    found = lifetimes(osc, np.array([[0.9, -0.9, 1.2], [0.0, 0.0, 1.4]]), method="rk4")
    assert found.settled.all()
    np.testing.assert_array_equal(both_wells(osc, found, method="rk4"), [False, False, True])
    wandering = lifetimes(osc, (0.1, 0.3), periods=5, method="rk4")
    np.testing.assert_array_equal(both_wells(osc, wandering, method="rk4"), [False] * 3)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"periods": 0}, "^periods = 0"),
        ({"settling": -1}, "^settling = -1"),
        ({"radius": -1.0}, r"^radius = -1\.0"),
        ({"tolerance": 0.2}, r"^tolerance = 0\.2: must be less than the radius"),
        ({"block": 18}, "^block = 18: must be more than 18"),
        ({"tangents": 2}, "^tangents = 2"),
        ({"method": "euler"}, "^method = 'euler'"),
    ],
)
def test_bad_arguments_are_named(change, message):
    with pytest.raises(ValueError, match=message):
        lifetimes(LINEAR, (1.0, 0.0), **change)
