"""Branches, bifurcations and loci: a linear oscillator, exact scaling, SciPy's map, brute force on both sides."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from duffing import ConvergenceError, Duffing, poincare_section
from duffing.orbits.bifurcations import FLIP, FOLD, bifurcation_curves, bifurcations, orbit_branches, switch_branches
from duffing.orbits.periodic import half_period_map, periodic_orbit, periodic_orbits

P = (0.1, 1.0)


@pytest.fixture(scope="module")
def in_well():
    """The in-well branches from the weakly forced orbit, through both folds: p = 0.1 and p = 1."""
    return orbit_branches(Duffing(p=P, mu=0.05), (1.05, 0.01), 2, bounds=(0.04, 0.3), points=120)


@pytest.fixture(scope="module")
def found(in_well):
    return bifurcations(in_well)


def scipy_map(osc, state):
    def field(t, y):
        return [y[1], osc.acceleration(y[0], y[1], t)]

    run = solve_ivp(field, (0, osc.period), state, method="DOP853", rtol=1e-12, atol=1e-14)
    return run.y[:, -1]


def test_branch_in_frequency_of_a_linear_oscillator_is_its_response_curve():
    osc = Duffing(alpha=0.3, p=1.0, mu=[0.4], omega=0.5, delta=2.0, gamma=0.0)
    (branch,) = orbit_branches(osc, (0.2, 0.0), 2, field="omega", bounds=(0.5, 2.5))
    omega = branch.parameter
    response = 0.4 / (2.0 - omega**2 + 0.3j * omega)
    np.testing.assert_allclose(branch.state, [response.real, (1j * omega * response).real], atol=1e-8)
    assert omega[-1] == 2.5
    assert branch.stable.all()
    np.testing.assert_allclose(np.abs(branch.multipliers), np.exp(-0.3 * np.pi / omega) * np.ones((2, 1)), atol=1e-8)
    assert bifurcations([branch]) == [[]]


def test_every_point_of_a_branch_is_a_periodic_orbit_with_its_multipliers(in_well):
    for branch in in_well:
        done = half_period_map(branch.osc, branch.state, branch.halves)
        np.testing.assert_allclose(done.image, branch.state, atol=1e-8)
        trace = done.derivative[0, 0] + done.derivative[1, 1]
        np.testing.assert_allclose(branch.multipliers.sum(axis=0), trace, atol=1e-9)
        np.testing.assert_array_equal(branch.osc.mu, branch.parameter)


def test_in_well_branches_have_two_folds_and_a_period_doubling(found):
    for flaws in found:
        assert [one.kind for one in flaws] == [FOLD, FOLD, FLIP]
        assert flaws[0].osc.mu > flaws[2].osc.mu > flaws[1].osc.mu


def test_at_a_fold_scipys_map_has_the_multiplier_1_and_at_a_flip_minus_1(found):
    for one in found[1]:
        sign = 1 if one.kind == FOLD else -1
        h = 1e-5
        ends = [scipy_map(one.osc, one.state + s * h * one.direction) for s in (1, -1)]
        np.testing.assert_allclose((ends[0] - ends[1]) / (2 * h), sign * one.direction, atol=1e-5)
        np.testing.assert_allclose(scipy_map(one.osc, one.state), one.state, atol=1e-8)


def test_two_orbits_meet_at_a_fold_and_beyond_it_there_are_none(found):
    for flaws in found:
        for fold, inside in ((flaws[0], -1), (flaws[1], 1)):
            near = np.linspace(-0.15, 0.15, 7)
            starts = fold.state[:, None] + near * fold.direction[:, None]
            with_two = periodic_orbits(replace(fold.osc, mu=fold.osc.mu + inside * 1e-3), starts)
            without = periodic_orbits(replace(fold.osc, mu=fold.osc.mu - inside * 1e-3), starts)
            close = [np.hypot(*(o.state - fold.state[:, None])) < 0.12 for o in (with_two, without)]
            assert [part.sum() for part in close] == [2, 0]
            assert np.sort(np.abs(with_two.multipliers[0, close[0]]) < 1).tolist() == [False, True]


def test_distance_of_the_two_orbits_grows_as_the_square_root_beyond_a_fold(in_well, found):
    fold, branch = found[1][0], in_well[1]
    below = branch.parameter < fold.osc.mu
    distance = np.hypot(*(branch.state - fold.state[:, None]))
    near = below & (distance < 0.05) & (distance > 1e-3)
    assert near.sum() >= 2
    coefficient = distance[near] ** 2 / (fold.osc.mu - branch.parameter[near])
    assert coefficient.max() / coefficient.min() < 1.3


def test_brute_force_stays_below_the_fold_and_leaves_the_well_above_it(found):
    for flaws in found:
        fold = flaws[0]
        below, above = (replace(fold.osc, mu=fold.osc.mu + d) for d in (-2e-3, 2e-3))
        orbits = periodic_orbits(below, fold.state[:, None] + np.linspace(-0.1, 0.1, 7) * fold.direction[:, None])
        stable = orbits.state[:, np.abs(orbits.multipliers[0]) < 1][:, 0]
        stays = poincare_section(below, stable + 1e-3, 1, transient=200)[:, 0]
        np.testing.assert_allclose(stays, stable, atol=1e-6)
        assert np.min(poincare_section(above, stable, 60)[0]) < 0


def test_at_a_period_doubling_the_multiplier_crosses_minus_1_and_a_doubled_orbit_is_born(in_well, found):
    doubled = switch_branches([flaws[2] for flaws in found], bounds=(0.04, 0.3), points=12, largest=0.02)
    for branch, flaws, whole in zip(doubled, found, in_well, strict=True):
        flip = flaws[2]
        before, after = (whole.multipliers[:, flip.index + k].real for k in (0, 1))
        assert before.min() > -1 > after.min()
        assert branch.halves == 4
        assert branch.parameter[0] > flip.osc.mu  # supercritical: it exists where the single orbit is unstable ...
        assert branch.stable[0]  # ... and attracts
        once = half_period_map(branch.osc, branch.state, 2).image
        assert np.all(np.hypot(*(once - branch.state)) > 1e-3)  # not the single orbit twice
        np.testing.assert_allclose(half_period_map(branch.osc, branch.state, 4).image, branch.state, atol=1e-8)


def test_brute_force_finds_the_doubled_orbit_beyond_the_period_doubling(found):
    flip = found[1][2]
    (branch,) = switch_branches([flip], bounds=(0.04, 0.3), points=6, largest=0.02)
    osc = Duffing(*branch.osc.columns()[:, 2])
    late = poincare_section(osc, branch.state[:, 2] + 1e-4, 2, transient=1500)
    np.testing.assert_allclose(late[:, 1], branch.state[:, 2], atol=1e-7)
    assert np.hypot(*(late[:, 0] - late[:, 1])) > 0.02


def test_flip_of_the_half_map_breaks_the_symmetry():
    """The large orbit, followed to low frequency: at the flip its N has -1, over the whole period +1."""
    osc = Duffing(p=1.0, mu=[0.3], omega=1.0)
    late = poincare_section(osc, (1.0, 1.4), 1, transient=80)[:, 0]
    (branch,) = orbit_branches(osc, late, 1, field="omega", bounds=(0.5, 1.1), direction=-1)
    (flip,) = bifurcations([branch])[0]
    assert flip.kind == FLIP
    whole = half_period_map(flip.osc, flip.state, 2).derivative[:, :, 0]
    np.testing.assert_allclose(whole @ flip.direction, flip.direction, atol=1e-6)
    (broken,) = switch_branches([flip], field="omega", bounds=(0.5, 1.1), points=5)
    assert np.all(np.hypot(*(half_period_map(broken.osc, broken.state, 1).image - broken.state)) > 1e-3)
    np.testing.assert_allclose(half_period_map(broken.osc, broken.state, 2).image, broken.state, atol=1e-8)


def test_locus_in_the_cubic_stiffness_is_the_exact_scaling(found):
    """With linear damping x = gamma^(-1/2) X leaves mu sqrt(gamma) as the only parameter: mu ~ gamma^(-1/2)."""
    curves = bifurcation_curves(found[1], second="gamma", bounds=(0.5, 1.0 + 1e-9), direction=-1, largest=0.2)
    for curve, one in zip(curves, found[1], strict=True):
        assert curve.parameter[-1] == 0.5
        np.testing.assert_allclose(curve.u[2], one.osc.mu * curve.parameter**-0.5, rtol=1e-6)
        np.testing.assert_allclose(curve.u[0], one.state[0] * curve.parameter**-0.5, rtol=1e-4)


def test_locus_in_p_leads_to_the_bifurcations_found_there_directly(found):
    curves = bifurcation_curves(found[1], bounds=(P[0], 1.1), direction=-1, largest=0.2)
    for curve, direct in zip(curves, found[0], strict=True):
        assert curve.parameter[-1] == P[0]
        assert curve.u[2, -1] == pytest.approx(float(direct.osc.mu), abs=1e-7)


def test_a_branch_may_be_followed_in_p():
    (branch,) = orbit_branches(Duffing(p=[1.0], mu=0.2), (1.2, 0.04), 2, field="p", bounds=(0.3, 1.1), direction=-1)
    direct = periodic_orbit(Duffing(p=0.3, mu=0.2), branch.state[:, -1])
    np.testing.assert_allclose(branch.state[:, -1], direct.state, atol=1e-8)
    np.testing.assert_allclose(branch.multipliers[:, -1], direct.multipliers, atol=1e-7)


def test_a_start_without_an_orbit_is_a_named_error():
    with pytest.raises(ConvergenceError, match=r"parameter = 0\.29"):
        orbit_branches(Duffing(p=[1.0, 1.0], mu=[0.05, 0.29]), np.array([[1.05, 1.3], [0.0, 0.1]]), 2)


def test_branches_of_different_fields_are_refused(in_well):
    with pytest.raises(ValueError, match=r"branches vary \['mu', 'omega'\]: must be of one field"):
        bifurcations([in_well[1], in_well[1]._replace(field="omega")])


def test_unknown_field_is_named():
    with pytest.raises(ValueError, match="field = 'nu': must be one of 'alpha', 'p', 'mu'"):
        orbit_branches(Duffing(mu=[0.05]), (1.0, 0.0), field="nu")
