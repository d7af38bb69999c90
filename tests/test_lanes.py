"""Trajectories side by side: each is what it is alone, whoever flies beside it and whatever befalls them."""

import numpy as np
import pytest

from duffing.errors import DivergedError
from duffing.integrators.friction_time import adaptive as friction
from duffing.integrators.friction_time import turning_points as turning
from duffing.integrators.friction_time.block import WIDTH
from duffing.oscillator import Duffing

PERIOD = 2 * np.pi
SIZE = 3 * WIDTH + 5


def _mixed(size=SIZE):
    """A family that creeps, is chaotic, has smooth damping or none, from random starts."""
    rng = np.random.default_rng(11)
    fields = {
        "alpha": rng.choice([0.0, 0.1, 0.3], size, p=[0.1, 0.6, 0.3]),
        "p": rng.choice([0.1, 0.3, 0.5, 1.0, 2.0, 3.0], size),
        "mu": rng.choice([0.0, 0.03, 0.05, 0.27], size),
        "omega": rng.choice([0.7, 1.0, 1.9], size),
    }
    return fields, rng.uniform(-1, 1, (2, size))


def _run(fields, states, chosen, t, **options):
    return friction.integrate(
        Duffing(**{k: v[chosen] for k, v in fields.items()}), states[:, chosen], t, rtol=1e-8, atol=1e-10, **options
    )


def _same(one, other, chosen):
    for a, b in zip(one, other, strict=True):
        if a is not None:
            np.testing.assert_array_equal(a[..., chosen], b)


@pytest.mark.parametrize("tangents", [0, 1, 2])
def test_bits_do_not_depend_on_company_order_or_threads(tangents):
    fields, states = _mixed()
    t = np.linspace(0, 3, 5) * PERIOD
    everything = _run(fields, states, slice(None), t, tangents=tangents, threads=1)
    assert everything.annihilations.sum() > 0
    backwards = np.arange(SIZE)[::-1]
    for chosen, threads in ((slice(None), 3), (backwards, 1), (slice(7, 30), 2), (slice(40, None), 1)):
        _same(everything, _run(fields, states, chosen, t, tangents=tangents, threads=threads), chosen)
    for i in range(0, SIZE, 5):
        _same(everything, _run(fields, states, slice(i, i + 1), t, tangents=tangents), slice(i, i + 1))


def test_turning_points_do_not_depend_on_company_or_order():
    states = np.random.default_rng(5).uniform(0.05, 0.6, (2, SIZE))
    osc, t0 = Duffing(p=0.5, mu=0.1), np.linspace(0, 1, SIZE)
    everything = turning.to_turning_point(osc, states, t0, derivatives=True)
    for chosen in (np.arange(SIZE)[::-1], slice(3, 4), slice(20, None)):
        _same(everything, turning.to_turning_point(osc, states[:, chosen], t0[chosen], derivatives=True), chosen)


def test_trajectories_that_share_a_block_with_creeps_are_the_tight_solution_to_tolerance():
    fields, states = _mixed()
    t = [0.0, PERIOD]
    loose = _run(fields, states, slice(None), t).states
    tight = friction.integrate(Duffing(**fields), states, t, rtol=1e-12, atol=1e-14).states
    # A step's error of 1e-8 grows by the motion's own instability, at most as fast as at the top of the hill.
    assert np.abs(loose - tight).max() < 1e-8 * np.exp(PERIOD)


def test_every_time_is_met_as_by_runs_that_end_there():
    osc = Duffing(p=[0.1, 0.5, 1.0, 2.0], mu=0.27)
    t = np.array([0.0, 0.1, 0.1 + 1e-9, 2.0, 2 * PERIOD])
    orbit = friction.integrate(osc, (0.45, 0.1), t)
    for i in range(1, 5):
        ends = friction.integrate(osc, (0.45, 0.1), t[[0, i]]).states[:, -1]
        assert orbit.states[:, i] == pytest.approx(ends, abs=1e-9)
    # Over a nanosecond the motion is straight.
    move, v = orbit.states[0, 2] - orbit.states[0, 1], orbit.states[1, 1]
    assert move == pytest.approx(1e-9 * v, abs=1e-15)


@pytest.mark.parametrize("place", [0, WIDTH, SIZE - 1])
def test_the_member_that_diverges_is_named_wherever_it_flies(place):
    delta, gamma, mu = np.full(SIZE, -1.0), np.ones(SIZE), np.linspace(0.1, 0.2, SIZE)
    delta[place], gamma[place] = 1.0, -1.0
    named = rf"1 of {SIZE} members fail; the first, .*mu = {mu[place]:g}, .*delta = 1,"
    with pytest.raises(DivergedError, match=named):
        friction.integrate(Duffing(p=0.1, delta=delta, gamma=gamma, mu=mu), (2.0, 1.0), [0, PERIOD, 2 * PERIOD])


def test_a_linear_motion_may_become_large():
    osc = Duffing(alpha=0.1, p=1, gamma=0.0)
    rate = (-0.1 + np.sqrt(0.01 + 4)) / 2
    x, v = friction.integrate(osc, (1.0, rate), [0.0, 100.0]).states[:, -1, 0]
    assert x == pytest.approx(np.exp(rate * 100.0), rel=1e-7)
    assert v == pytest.approx(rate * x, rel=1e-9)
    with pytest.raises(DivergedError, match="bound"):
        friction.integrate(osc, (1.0, rate), np.linspace(0.0, 500.0, 6))


@pytest.mark.parametrize(("p", "rtol"), [(1e-9, 1e-8), (1e-7, 1e-10), (1.1e4, 1e-8)])
def test_exponents_out_of_reach_are_refused_by_name(p, rtol):
    with pytest.raises(ValueError, match=rf"p = {p}, rtol = .*: p must be from"):
        friction.integrate(Duffing(p=[0.5, p], mu=0.1), (0.1, 0.2), [0.0, 1.0], rtol=rtol)
    assert np.all(np.isfinite(friction.integrate(Duffing(alpha=0.0, p=p), (0.1, 0.2), [0.0, 1.0]).states))


def test_a_single_time_gives_the_start():
    orbit = friction.integrate(Duffing(mu=[0.1, 0.2]), (0.1, 0.2), [3.0], tangents=1)
    np.testing.assert_array_equal(orbit.states[:, 0], [[0.1, 0.1], [0.2, 0.2]])
    assert orbit.growth.shape == (1, 0, 2)
