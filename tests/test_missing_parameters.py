"""Which alpha and omega: the ensemble of runs, the probability of each statement, and the pairs that come out."""

from types import SimpleNamespace

import numpy as np
import pytest

from book.paper import LIKELY, STATEMENTS
from book.studies import inference, likely_pairs, reproduction
from book.studies import missing_parameters as study
from duffing import Duffing, critical_amplitude, lyapunov_spectrum, paper
from duffing.flow import trajectory

A, B, C = LIKELY


@pytest.fixture(scope="module")
def likely():
    alpha, omega = zip(*((pair.alpha, pair.omega) for pair in LIKELY), strict=True)
    return study.evidence(alpha, omega, n=64, few=4)


@pytest.fixture(scope="module")
def lattice():
    return study.plane(alpha_step=0.01, omega_step=0.1)


def marginal(evidence, **options):
    return inference.marginal(inference.log_likelihood(evidence, **options))


def test_the_ensemble_lies_within_the_distance_and_begins_with_the_papers_start():
    start = study.starts(50, distance=1e-6)
    np.testing.assert_array_equal(start[:, 0], paper.START)
    assert 1e-7 < np.abs(start - start[:, :1]).max() <= 1e-6


def test_exponents_of_the_ensemble_are_those_of_the_papers_algorithm_over_both_averages():
    found = study.runs(0.1, 1.0, (0.2,), n=1)  # a regular motion: another order of rounding is harmless
    osc = Duffing(alpha=0.1, p=0.1, mu=0.2, omega=1.0)
    for average, (transient, periods) in enumerate(((0, 239), (191, 48))):
        alone = lyapunov_spectrum(osc, paper.START, periods, transient, k=1, method="rk4").exponents[0]
        assert found.exponent[average, 0, 0, 0] == pytest.approx(alone, abs=2e-3)
    two = study.two_trajectories(0.1, 1.0, (0.2,), n=1)
    np.testing.assert_allclose(two[:, 0, 0, 0], found.exponent[:, 0, 0, 0], atol=2e-3)


def test_crossings_amplitudes_and_periods_are_those_of_the_motion():
    found = study.runs((0.1, 0.16), (1.0, 1.175), (0.25,), n=1)
    for k, (alpha, omega) in enumerate(((0.1, 1.0), (0.16, 1.175))):
        t = np.arange(2391) / 10 * 2 * np.pi / omega
        x, v = trajectory(Duffing(alpha=alpha, p=0.1, mu=0.25, omega=omega), paper.START, t, method="rk4")
        crossings = np.nonzero(np.diff(np.sign(x)))[0]
        assert found.crossings[:, 0, 0, k].tolist() == [np.sum(crossings < 1910), np.sum(crossings >= 1910)]
        halves = [np.ptp(x[:1911]) / 2, np.ptp(x[1910:]) / 2]
        np.testing.assert_allclose(found.amplitude[:, 0, 0, k], halves, rtol=1e-8)
        points = np.array([x, v])[:, 1910::10]
        apart = [np.hypot(*(points[:, q:] - points[:, :-q])).max() for q in range(1, 7)]
        assert found.aperiodic[0, 0, k] == pytest.approx(min(apart), rel=1e-9)


def test_every_statement_has_its_probability_and_none_is_impossible(likely):
    found = inference.probabilities(likely)
    assert set(found) == {statement.key for statement in STATEMENTS}
    for key, probability in found.items():
        assert np.all(probability > 0) and (key in inference.NUMBERS or np.all(probability <= 1)), key


def runs_of(exponent, crossings=(9, 0), amplitude=(1.0, 0.25), aperiodic=1.0):
    """Made-up Runs of one candidate: one start for each exponent."""
    n = np.size(exponent)
    both = [np.tile(np.reshape(pair, (2, 1, 1)), (1, n, 1)) for pair in (crossings, amplitude)]
    return study.Runs(np.tile(np.reshape(exponent, (1, n, 1)), (2, 1, 1)), *both, np.full((n, 1), aperiodic))


def test_probabilities_of_made_up_motions_are_exact():
    models = inference.Models(misprint=0.0, error=0.0, judgement=0.0)
    regular = runs_of((-0.023, -0.023 - 0.006), crossings=(9, 0))
    found = inference.quoted(runs_of(0.175), regular, models=models)
    peak = 1 / (0.006 * np.sqrt(2 * np.pi))
    assert found["lambda-027"] == pytest.approx(peak)
    assert found["lambda-025"] == pytest.approx(peak * (1 + np.exp(-0.5)) / 2)
    assert found["not-periodic"] == found["transient"] == 1
    assert found["much-smaller"] == pytest.approx(1 / (1 + 0.5**4))
    late = inference.quoted(runs_of(0.175, aperiodic=1e-6), runs_of(-0.023, crossings=(9, 1)), models=models)
    assert late["not-periodic"] == late["transient"] == 0


def test_an_exponent_in_bits_is_one_in_nats_over_the_logarithm_of_two():
    nats = inference.quoted(runs_of(0.17), runs_of(-0.02))
    bits = inference.quoted(runs_of(0.17 * np.log(2)), runs_of(-0.02 * np.log(2)), "bits")
    assert all(bits[key] == pytest.approx(nats[key]) for key in nats)


def test_wolfs_exponent_of_the_lorenz_attractor_is_in_bits():
    """Wolf et al. (1985) print 2.16 for sigma = 16, R = 45.92, b = 4; in nats it is 1.50 (see Sprott's page)."""
    sigma, r, b, h = 16.0, 45.92, 4.0, 0.004
    state = np.random.default_rng(0).uniform(-20, 20, (3, 200)) + np.array([[0.0], [0.0], [45.0]])
    tangent, total = np.ones((3, 200)), 0.0

    def slope(s, u):
        (x, y, z), (a, c, d) = s, u
        return np.array([sigma * (y - x), x * (r - z) - y, x * y - b * z]), np.array(
            [sigma * (c - a), a * (r - z) - x * d - c, a * y + x * c - b * d]
        )

    for step in range(7000):
        k1 = slope(state, tangent)
        k2 = slope(state + h / 2 * k1[0], tangent + h / 2 * k1[1])
        k3 = slope(state + h / 2 * k2[0], tangent + h / 2 * k2[1])
        k4 = slope(state + h * k3[0], tangent + h * k3[1])
        weights = ((k1, 1), (k2, 2), (k3, 2), (k4, 1))
        state = state + h / 6 * sum(w * k[0] for k, w in weights)
        tangent = tangent + h / 6 * sum(w * k[1] for k, w in weights)
        length = np.sqrt(np.sum(tangent**2, axis=0))
        tangent, total = tangent / length, total + (np.log(length).mean() if step >= 3000 else 0.0)
    exponent = total / (4000 * h)
    assert exponent * inference.UNITS["bits"] == pytest.approx(2.16, abs=0.03)
    assert exponent == pytest.approx(1.50, abs=0.02)


def test_the_onset_is_weighed_by_where_chaos_first_appears():
    mu = np.array([0.24, 0.25, 0.26, 0.27, 0.28])
    share = np.array([[0, 0, 1, 1, 1], [0, 0, 0.5, 1, 1], [0, 0, 0, 0, 1], [0, 0, 0, 1, 1]]).T
    expected = [np.exp(-2), (np.exp(-2) + 1) / 2, 0, 1]
    np.testing.assert_allclose(inference.at_onset(mu, share, 0.005), expected)


def test_no_likelihood_exceeds_its_ceiling(likely, lattice):
    for found in (likely, lattice.evidence):
        assert np.all(marginal(found) <= inference.ceiling(found.chaotic, found.regular))
    np.testing.assert_allclose(
        lattice.ceiling[tuple(lattice.kept)], inference.ceiling(lattice.evidence.chaotic, lattice.evidence.regular)
    )


def test_what_a_plane_does_not_follow_holds_little_of_its_likelihood(lattice):
    rest = lattice.ceiling.copy()
    rest[tuple(lattice.kept)] = -np.inf
    assert np.exp(rest).sum() < 0.05 * np.exp(marginal(lattice.evidence)).sum()


def test_the_posterior_of_a_lattice_and_a_plane_is_bayes_rule():
    lattice, plane = (SimpleNamespace(exponent=np.zeros(size)) for size in (2, 10))
    first, second = inference.posterior((np.log([3.0]), np.log([1.0, 4.0])), plane, lattice, 0.25)
    evidence = 0.25 * 3 / 2 + 0.75 * (1 + 4) / 10
    np.testing.assert_allclose(first, [0.25 * 3 / 2 / evidence])
    np.testing.assert_allclose(second, [0.75 * 1 / 10 / evidence, 0.75 * 4 / 10 / evidence])


def test_pair_a_is_the_likeliest_of_round_numbers(lattice):
    best = np.argmax(marginal(lattice.evidence))
    assert (lattice.evidence.alpha[best], lattice.evidence.omega[best]) == (A.alpha, A.omega)
    assert inference.index(lattice.evidence, A) == best
    assert lattice.exponent.size == 280


@pytest.mark.parametrize("pair", [B, C], ids="BC")
def test_the_other_pairs_are_likelier_than_their_eight_neighbours(pair):
    alpha, omega = np.meshgrid(pair.alpha + 0.005 * np.arange(-1, 2), pair.omega + 0.0125 * np.arange(-1, 2))
    logs = marginal(study.evidence(alpha.ravel(), omega.ravel()))
    assert np.argmax(logs) == 4


@pytest.mark.parametrize("change", [{}, {"seed": 2}, {"distance": 1e-6}], ids=["stated", "seed", "distance"])
def test_b_is_likelier_than_a_whatever_the_ensemble(likely, change):
    found = study.evidence((A.alpha, B.alpha), (A.omega, B.omega), n=64, few=4, **change) if change else likely
    logs = marginal(found)
    assert 1 < logs[1] - logs[0] < 5


def test_what_each_pair_meets_better_is_what_the_chapter_says(likely):
    found = inference.probabilities(likely)
    for key in ("onset-027", "larger-lambda", "much-smaller"):
        assert found[key][0] > found[key][1], key
    for key in ("lambda-025", "agreement", "sign-change"):
        assert found[key][1] > 2 * found[key][0], key
    without = marginal(likely, without=("lambda-025",))
    assert abs(without[1] - without[0]) < 1.5  # the printed -0.023 is what tells them apart


def test_the_pair_that_fits_the_exponents_in_bits_has_no_transient():
    chaotic, regular = study.quoted(0.16, 1.175, n=16)
    scale = inference.UNITS["bits"]
    assert scale * chaotic.exponent[0].mean() == pytest.approx(paper.LAMBDA_CHAOTIC, abs=0.02)
    assert scale * regular.exponent[0].mean() == pytest.approx(paper.LAMBDA_REGULAR, abs=0.02)
    assert np.all(regular.crossings == 0)
    osc = Duffing(alpha=0.16, omega=1.175)
    (onset,) = reproduction.onsets((0.1,), step=0.005, last=0.3, osc=osc)
    assert 1 < onset / critical_amplitude(Duffing(alpha=0.16, p=0.1, omega=1.175)) < 1.1


def test_beyond_the_domain_the_critical_amplitude_exceeds_0_27_at_every_frequency():
    omega = np.linspace(0.05, 4, 4000)
    assert critical_amplitude(Duffing(alpha=0.1965, p=0.1, omega=omega)).min() > 0.27
    assert critical_amplitude(Duffing(alpha=0.1955, p=0.1, omega=omega)).min() < 0.27


def test_onsets_of_the_likely_pairs_are_those_of_the_reproduction_and_lie_above_the_line():
    onsets = likely_pairs.onsets(LIKELY)
    direct = reproduction.onsets(likely_pairs.P, step=0.005, last=0.4, osc=likely_pairs.oscillator(B))
    np.testing.assert_array_equal(onsets["nats"][1], direct)
    assert np.all(onsets["nats"] > likely_pairs.lines(LIKELY, np.array(likely_pairs.P)))
    assert likely_pairs.THRESHOLDS["bits"] == pytest.approx(0.1 * np.log(2))


def test_motions_of_the_likely_pairs_run_to_1500_units_of_the_frequency():
    t, x = likely_pairs.history(B, 0.25)
    assert t[-1] == pytest.approx(1500, abs=0.1) and t.shape == x.shape
    early, late = likely_pairs.portrait(B, 0.25, early=True)
    assert early[1].shape[1] == 190 and late[1].shape[1] == 48
    assert likely_pairs.portrait(B, 0.27, early=False)[0] is None


def test_a_part_of_a_plane_is_the_plane_of_its_frequencies(lattice):
    omegas = lattice.omega[1::2]
    part, near = study.part(lattice, omegas), np.isin(lattice.evidence.omega, omegas)
    np.testing.assert_array_equal(part.omega, omegas)
    np.testing.assert_array_equal(part.ceiling, lattice.ceiling[:, 1::2])
    assert 0 < near.sum() < near.size
    np.testing.assert_array_equal(marginal(part.evidence), marginal(lattice.evidence)[near])
    laid = study.laid_out(part, part.evidence.omega)  # each value is in the column of its own frequency
    np.testing.assert_array_equal(laid[np.isfinite(laid)], np.broadcast_to(part.omega, laid.shape)[np.isfinite(laid)])
    np.testing.assert_array_equal(part.ceiling[tuple(part.kept)] > -np.inf, True)


def test_what_cannot_be_followed_is_named():
    with pytest.raises(ValueError, match=r"^alphas = \(0.1, 0.1\), omegas = \(0.5, 0.5\): no candidate"):
        study.plane(alphas=(0.1, 0.1), omegas=(0.5, 0.5))
    with pytest.raises(ValueError, match=r"^pair = \(0.15, 1.1875\): must be one of the candidates"):
        inference.index(SimpleNamespace(alpha=np.array([0.1]), omega=np.array([1.0])), B)
