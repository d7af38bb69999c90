"""The grid of steps and its forcing: how many steps, which phases, and what members with one table have in common."""

import mpmath
import numpy as np
import pytest

from duffing.integrators import forcing, rk4
from duffing.oscillator import Duffing

START = (0.45, 0.1)


def _periods(osc, n):
    return osc.period * np.arange(n + 1)


def test_forcing_has_the_cosines_at_the_ends_and_middles_of_the_steps():
    columns, t = Duffing(omega=1.3, mu=np.zeros(11)).columns(), np.array([[0.2], [1.1], [4.0]])
    seen = []
    forcing.map_chunks(lambda *block: seen.append(block), columns, t, 20, 1, 8, 4)
    assert [members.tolist() for members, *_ in seen] == [list(range(8)), [8, 9, 10]]
    assert [padded.tolist() for _, padded, *_ in seen] == [list(range(8)), [8, 9, 10, 8]]
    for _, padded, h, law, (cosines, offsets, counts) in seen:
        assert h.shape == (2, len(padded))
        assert law is None
        for i, start in enumerate(t[:-1, 0]):
            times = start + h[i, 0] * np.arange(2 * counts[i] + 1) / 2
            # A phase is rounded to half of 2^-40 turns at either end: 3e-12 in radians.
            assert np.abs(cosines[offsets[i] :][: len(times)] - np.cos(1.3 * times)).max() < 6e-12
            assert abs(times[-1] - t[i + 1, 0]) < 1e-15 * counts[i]


def test_cosine_of_turns_is_right_to_round_off():
    turns = np.concatenate([np.random.default_rng(5).uniform(-2, 2, 500), np.arange(-8, 9) / 8])
    exact = [mpmath.cospi(2 * mpmath.mpf(float(u))) for u in turns]
    # At a quarter turn cos = 1 - 1.23 + ...: the roundings of z, of its coefficient, of their product and of the two
    # last sums come to at most 1 unit of 2^-53 each, or a little less.
    assert np.abs(forcing._cosine_of_turns(turns) - np.array(exact, dtype=float)).max() < 5 * 2.0**-53


def test_round_off_in_the_times_adds_no_step(monkeypatch):
    seen = []
    kernel = rk4.advance
    monkeypatch.setattr(rk4, "advance", lambda *a: (seen.append(a[5]), kernel(*a)))
    osc = Duffing(omega=1.3)
    rk4.integrate(osc, START, osc.period / 10 * np.arange(1201))
    assert np.array_equal(np.unique(seen[0]), [50])


def test_members_of_different_frequency_at_their_own_periods_share_the_phases_of_a_single_one():
    osc = Duffing(p=0.5, mu=0.25, omega=np.array([0.6, 1.0, 1.7]))
    t = np.arange(41)[:, None] * osc.period
    orbit = rk4.integrate(osc, START, t)
    for i, omega in enumerate(osc.omega):
        alone = Duffing(p=0.5, mu=0.25, omega=omega)
        assert np.array_equal(rk4.integrate(alone, START, _periods(alone, 40)).states[..., 0], orbit.states[..., i])


def test_members_with_times_of_their_own_move_as_they_do_alone():
    # Period 1 and binary fractions: the spacings are equal in every bit, the phases at the start are not.
    osc = Duffing(p=0.5, mu=3.0, omega=2 * np.pi, alpha=np.full(3, 0.1))
    t = np.array([0.0, 0.25, 0.625]) + 0.5 * np.arange(5)[:, None]
    together = rk4.integrate(osc, START, t).states
    for i in range(3):
        alone = rk4.integrate(Duffing(p=0.5, mu=3.0, omega=2 * np.pi), START, t[:, i]).states
        assert np.array_equal(alone[..., 0], together[..., i])
    assert np.abs(together[:, -1, 0] - together[:, -1, 1]).max() > 0.1


def test_start_later_by_whole_periods_changes_no_bit():
    osc = Duffing(p=np.array([0.1, 1.0]), mu=0.27, omega=1.1)
    early = rk4.integrate(osc, START, _periods(osc, 30), tangents=1)
    late = rk4.integrate(osc, START, _periods(osc, 30) + 1000 * osc.period, tangents=1)
    assert np.array_equal(early.states, late.states)
    assert np.array_equal(early.growth, late.growth)


@pytest.mark.parametrize("omega", [0.3, 1.0, 2.7])
def test_each_interval_takes_the_least_number_of_steps_not_longer_than_the_papers(omega, monkeypatch):
    seen = []
    kernel = rk4.advance
    monkeypatch.setattr(rk4, "advance", lambda *a: (seen.append((a[2], a[5])), kernel(*a)))
    osc = Duffing(omega=omega)
    longest = osc.period / 500
    t = np.cumsum([0.0, osc.period, osc.period / 4, 0.4 * longest, 3.5 * longest, 240 * osc.period])
    rk4.integrate(osc, START, t)
    h, counts = seen[0]
    assert counts.tolist() == [500, 125, 1, 4, 120000]
    assert np.allclose(h[:, 0] * counts, np.diff(t), rtol=1e-14)
