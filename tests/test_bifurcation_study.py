"""The chapter's branches and loci: brute force on both sides of what they claim, one method against the other."""

from dataclasses import replace

import numpy as np
import pytest

from book.studies import bifurcations as study
from book.studies.followed import amplitude, at_exponent, curves, marks, orbits_at, side_by_side, speed, stroboscopic
from duffing import ConvergenceError, Duffing, paper, poincare_section, saddle_orbit
from duffing.orbits.bifurcations import FLIP, FOLD
from duffing.orbits.periodic import half_period_map, periodic_orbit, periodic_orbits


@pytest.fixture(scope="module")
def branches():
    return study.branches()


def places(branches):
    """(name, kind) -> {p: mu} of the first bifurcation of that kind on a branch of that name."""
    return {(name, kind): where for name, kind, where in side_by_side(branches)[::-1]}


def test_the_same_bifurcations_are_met_at_every_exponent(branches):
    for _, _, where in side_by_side(branches):
        assert tuple(where) == study.EXPONENTS


def test_what_brute_force_settles_on_is_an_orbit_of_the_branches():
    """At every forcing for p <= 1; at p = 2 up to mu = 0.18, where chaos attracts none of the starts yet."""
    for p in study.EXPONENTS:
        away = study.agreement(p)
        assert away.shape == (6, study.STARTS.shape[1])
        assert np.all(away[: 4 if p == 2 else 6] < 1e-8)


def test_starts_of_brute_force_reach_the_resonant_orbit_at_every_exponent(branches):
    """A point of it that attracts, in the middle between its fold and its flip, is among the late points."""
    for p in study.EXPONENTS:
        on = [one for one in at_exponent(branches, p) if one.name == study.IN_WELL and len(one.found) == 3]
        (*_, fold, flip) = (float(flaw.osc.mu) for flaw in on[0].found)
        mu = (fold + flip) / 2
        attracting = [
            orbit.state
            for orbit in orbits_at(at_exponent(branches, p), mu)[study.IN_WELL]
            if np.abs(orbit.multipliers[0]) < 1
        ]
        assert len(attracting) == 2
        osc = replace(paper.OSCILLATOR, p=p, mu=mu)
        small, resonant = sorted((amplitude(osc, state, 2), *state) for state in attracting)
        assert resonant[0] > 2 * small[0]
        (late,) = [
            points for name, points in study.brute_force(p, mu, mu + 1e-6, 2, 200).items() if name == "many starts"
        ]
        own = stroboscopic(osc, np.array(resonant[1:])[:, None], 2).ravel()
        assert np.min(np.abs(late[1][:, None] - own)) < 1e-3


def test_an_orbit_followed_in_the_exponent_is_what_a_run_settles_on_at_every_exponent():
    one = study.in_exponent(0.2)
    p = one.branch.parameter
    assert (p[0], p[-1]) == (0.1, 3.0)
    assert np.all(np.diff(p) > 0)
    assert one.found == ()
    assert one.branch.stable.all()
    for k in (0, p.size // 2, p.size - 1):
        late = poincare_section(replace(paper.OSCILLATOR, p=p[k], mu=0.2), one.branch.state[:, k] + 0.01, 300)
        np.testing.assert_allclose(late[:, -1], one.branch.state[:, k], atol=1e-5)


def test_an_orbit_that_ends_before_the_last_exponent_is_a_named_error():
    """At mu = 0.249 the small orbit exists at p = 1 and ends in its fold before p = 3."""
    with pytest.raises(ConvergenceError, match=r"mu = 0.249: the orbit does not reach p = 0.1 and 3"):
        study.in_exponent(0.249)


def test_stability_claimed_by_the_branches_is_what_brute_force_does(branches):
    """From beside every orbit at mu = 0.2: back to it where it is called stable, away from it where it is not."""
    for p in study.EXPONENTS:
        one = replace(paper.OSCILLATOR, p=p, mu=0.2)
        for name, orbits in orbits_at(at_exponent(branches, p), 0.2).items():
            halves = study.HALVES.get(name, 4)
            for orbit in orbits:
                stable = np.abs(orbit.multipliers[0]) < 1
                cycles = 150 if stable else 12
                late = poincare_section(one, orbit.state + 1e-4, 3 * cycles)[:, 3 * cycles - 1 :: -1]
                own = half_period_map(one, orbit.state, 2 * halves).image  # the orbit's own point again
                period = 2 * halves // (1 if halves % 2 else 2)
                apart = np.min(np.hypot(*(late[:, :period] - own)), axis=0)
                assert (apart < 1e-4) == stable, (p, name, orbit.state)


def test_large_orbit_is_born_with_its_saddle_and_never_breaks_its_symmetry(branches):
    for one in branches:
        if one.name == study.LARGE:
            assert {flaw.kind for flaw in one.found} <= {FOLD}
    for p, mu in places(branches)[study.LARGE, FOLD].items():
        starts = np.reshape(np.meshgrid(np.linspace(-0.3, 0.3, 5), np.linspace(1.0, 1.3, 4)), (2, -1))
        counts = [
            np.sum(periodic_orbits(replace(paper.OSCILLATOR, p=p, mu=mu + d), starts, 1).state[1] > 0.5)
            for d in (-1e-3, 1e-3)
        ]
        assert counts == [0, 2]


def test_period_three_crosses_between_the_wells_and_attracts_between_its_fold_and_its_flip(branches):
    for p in study.EXPONENTS:
        fold, flip = (places(branches)[study.THIRD, kind][p] for kind in (FOLD, FLIP))
        mu = (fold + flip) / 2
        attracting = [
            orbit for orbit in orbits_at(at_exponent(branches, p), mu)[study.THIRD] if np.abs(orbit.multipliers[0]) < 1
        ]
        (orbit,) = attracting
        osc = replace(paper.OSCILLATOR, p=p, mu=mu)
        late = poincare_section(osc, orbit.state, 3, transient=300)
        np.testing.assert_allclose(late[:, -1], orbit.state, atol=1e-7)
        assert np.min(np.hypot(*(late[:, :2] - late[:, 2:]))) > 0.1
        assert late[0].min() < 0 < late[0].max()


def test_saddle_branch_is_the_saddle_orbit_found_by_multiple_shooting(branches):
    for p in (0.5, 1.0, 2.0):
        (orbit,) = orbits_at(at_exponent(branches, p), 0.2)[study.SADDLE]
        other = saddle_orbit(replace(paper.OSCILLATOR, p=p, mu=0.2))
        np.testing.assert_allclose(orbit.state, other.state, atol=1e-8)
        np.testing.assert_allclose(orbit.multipliers.real**2, other.multipliers, rtol=1e-5)


def test_loci_pass_through_the_bifurcations_of_every_exponent(branches):
    where = places(branches)
    loci = {name: curve for name, *_, curve in ((one.name, one) for one in study.loci_in_p())}
    for key in ((study.LARGE, FOLD), (study.THIRD, FOLD), (study.THIRD, FLIP), (study.IN_WELL, FLIP)):
        curve = loci[", ".join(key)]
        assert np.all(np.diff(curve.p) > 0)
        assert (curve.p[0], curve.p[-1]) == (0.1, 3.0)
        assert curve.mu[0] == pytest.approx(where[key][0.1], abs=1e-7)
        # In between the curve's points are joined by straight lines.
        between = np.interp([0.5, 2.0], curve.p, curve.mu)
        np.testing.assert_allclose(between, [where[key][0.5], where[key][2.0]], atol=3e-4)


def test_every_point_of_a_locus_is_degenerate():
    for curve in study.loci_in_p():
        halves = {"period 3": 3, "round both wells": 1, "in a well": 2}[curve.name.split(", ")[0]]
        sign = 1 if curve.name.endswith(FOLD) else -1
        done = half_period_map(Duffing(p=curve.p, mu=curve.mu), curve.state, halves)
        np.testing.assert_allclose(done.image, curve.state, atol=1e-6)
        matrix = np.moveaxis(done.derivative, -1, 0) - sign * np.eye(2)
        assert np.all(np.abs(np.linalg.det(matrix)) < 1e-4)


def test_orbits_at_a_forcing_are_those_of_the_branches_on_both_sides_of_it(branches):
    found = orbits_at(at_exponent(branches, 1.0), 0.2)
    assert len(found[study.IN_WELL]) == 3
    assert len(found[study.LARGE]) == 2
    assert len(orbits_at(at_exponent(branches, 1.0), 0.25)[study.LARGE]) == 2  # where two branches start, once each
    assert study.LARGE not in orbits_at(at_exponent(branches, 1.0), 0.16)


def test_amplitude_and_speed_of_a_linear_oscillator():
    osc = Duffing(alpha=0.3, p=1.0, mu=0.4, omega=1.3, delta=2.0, gamma=0.0)
    exact = 0.4 / abs(2.0 - 1.3**2 + 0.39j)
    for halves in (1, 2, 3):
        orbit = periodic_orbit(osc, (0.5, 0.1), halves)
        assert amplitude(osc, orbit.state, halves) == pytest.approx(exact, rel=1e-3)
        assert speed(osc, orbit.state, halves) == pytest.approx(1.3 * exact, rel=1e-3)


def test_curves_hold_the_bifurcations_and_change_their_stability_there(branches):
    chosen = [one for one in at_exponent(branches, 1.0) if one.name == study.IN_WELL and len(one.found) == 3]
    ((_, mu, x, stable),) = curves(chosen, stroboscopic)
    (one,) = chosen
    assert mu.size == one.branch.parameter.size + 3
    assert x.shape == (2, mu.size)
    changes = np.flatnonzero(stable[1:] != stable[:-1])
    ends = [mu[k] if stable[k] else mu[k + 1] for k in changes]
    np.testing.assert_allclose(ends, [float(flaw.osc.mu) for flaw in one.found], rtol=1e-12)
    for (kind, where, height), flaw in zip(marks(chosen), one.found, strict=True):
        assert (kind, where) == (flaw.kind, float(flaw.osc.mu))
        assert 0 < height < 1


def test_brute_force_names_every_point_with_its_forcing():
    found = study.brute_force(1.0, first=0.15, last=0.16, forcings=2, transient=150)
    stable = orbits_at(at_exponent(study.branches(), 1.0), 0.15)[study.IN_WELL]
    (small,) = [orbit for orbit in stable if np.abs(orbit.multipliers[0]) < 1]
    for name, size in (("many starts", 2 * 12 * 8), ("forward sweep", 2 * 12), ("backward sweep", 2 * 12)):
        mu, x = found[name]
        assert mu.shape == x.shape == (size,)
        assert set(mu) == {0.15, 0.16}
    mu, x = found["forward sweep"]
    wells = stroboscopic(replace(paper.OSCILLATOR, p=1.0, mu=0.15), small.state, 2)
    assert np.min(np.abs(x[mu == 0.15][-1] - wells)) < 1e-4
