"""A member without an answer: by default an error for the family, on request NaN for that member alone."""

import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from duffing import (
    ConvergenceError,
    DivergedError,
    Duffing,
    NoSaddleOrbitError,
    homoclinic_tangency,
    lyapunov_spectrum,
    poincare_section,
    saddle_orbit,
    splitting,
    trajectory,
)

# With gamma < 0 the force pushes away from x = 0 without end: such members diverge.
GAMMA = np.array([1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
BAD = GAMMA < 0
START = (0.45, 0.1)
CALLS = {
    "trajectory": lambda osc, **options: trajectory(osc, START, np.linspace(0, 30, 4), **options),
    "poincare_section": lambda osc, **options: poincare_section(osc, START, periods=5, **options),
    "lyapunov_spectrum": lambda osc, **options: lyapunov_spectrum(osc, START, 10, 2, k=2, **options).exponents,
    "lyapunov_spectrum without history": lambda osc, **options: (
        lyapunov_spectrum(osc, START, 10, 2, k=1, history=False, **options).exponents
    ),
}
each_call = pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
each_method = pytest.mark.parametrize("method", ["rk4", "friction"])


def family(gamma=GAMMA):
    return Duffing(alpha=0.2, p=1.0, mu=np.linspace(0.1, 0.4, gamma.size), gamma=gamma)


@each_call
@each_method
def test_one_bad_member_is_an_error_by_default(call, method):
    with pytest.raises(DivergedError, match="gamma = -1"):
        call(family(), method=method)


@each_call
@each_method
def test_on_request_bad_members_are_nan_and_the_others_are_what_they_would_be_without_them(call, method):
    with pytest.warns(
        RuntimeWarning, match=r"^2 of 7 members have no answer .* member 2, .*gamma = -1 .*Diverged"
    ) as said:
        result = call(family(), method=method, on_failure="nan")
    assert len(said) == 1
    assert np.array_equal(np.isnan(result).all(axis=tuple(range(result.ndim - 1))), BAD)
    good = call(Duffing(*family().columns()[:, ~BAD]), method=method)
    np.testing.assert_array_equal(result[..., ~BAD], good)


@each_call
def test_a_family_without_failures_is_the_same_under_both_policies_and_nothing_is_said(call):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        np.testing.assert_array_equal(
            call(family(np.ones(3)), method="rk4", on_failure="nan"), call(family(np.ones(3)), method="rk4")
        )


@each_call
def test_a_family_of_failures_is_all_nan(call):
    with pytest.warns(RuntimeWarning, match="^3 of 3 members"):
        assert np.isnan(call(family(-np.ones(3)), method="rk4", on_failure="nan")).all()


@pytest.mark.parametrize("run", [{}, {"progress": lambda done, total: None}, {"executor": ThreadPoolExecutor}])
def test_sweeps_in_blocks_with_executors_and_checkpoints_keep_what_is_good(run, tmp_path):
    osc = Duffing(alpha=0.2, mu=np.linspace(0.1, 0.4, 600), gamma=np.where(np.arange(600) == 311, -1.0, 1.0))
    options = {"periods": 100, "transient": 0, "k": 1, "method": "rk4", "history": False}
    with pytest.warns(RuntimeWarning, match="^1 of 600 members .* member 311,"):
        result = lyapunov_spectrum(osc, START, **options, checkpoint=tmp_path, on_failure="nan", **run)
    assert np.flatnonzero(np.isnan(result.exponents[0])).tolist() == [311]
    with pytest.warns(RuntimeWarning, match="^1 of 600"):  # read back, and said again
        again = lyapunov_spectrum(osc, START, **options, checkpoint=tmp_path, on_failure="nan")
    np.testing.assert_array_equal(again.exponents, result.exponents)
    with pytest.raises(DivergedError):  # a run that allows no NaN takes none from the folder
        lyapunov_spectrum(osc, START, **options, checkpoint=tmp_path)


@each_call
@pytest.mark.parametrize("bad", ["ignore", None, 0, np.array(["nan", "raise"])])
def test_an_unknown_policy_is_refused_by_name(call, bad):
    with pytest.raises(ValueError, match=r"^on_failure = "):
        call(family(np.ones(2)), on_failure=bad)


PHASES = np.array([0.5, 1.5])
# Families in which the second member alone has no answer, and why.
MANIFOLDS = {
    "saddle_orbit": (
        lambda osc, **options: np.stack(saddle_orbit(osc, **options)),
        Duffing(alpha=0.1, p=0.2, mu=[0.12, 0.001, 0.13]),
        NoSaddleOrbitError,
        "it sticks",
    ),
    "splitting": (
        lambda osc, **options: splitting(osc, PHASES, method="manifolds", **options),
        Duffing(alpha=0.1, p=[1.0, 0.5, 2.0], mu=[0.1, 0.0, 0.2]),
        NoSaddleOrbitError,
        "at rest at mu = 0",
    ),
    "splitting by the threshold": (
        lambda osc, **options: splitting(osc, PHASES, **options),
        Duffing(alpha=0.1, p=0.1, mu=[0.15, 0.05, 0.14]),
        NoSaddleOrbitError,
        "interval of positions is caught",
    ),
    "homoclinic_tangency": (
        lambda osc, **options: homoclinic_tangency(osc, **options),
        Duffing(alpha=[0.1, 1e-9, 0.2], delta=[-1.0, -1.0, -2.0]),
        ConvergenceError,
        "too small for doubles",
    ),
}
each_manifold = pytest.mark.parametrize(("call", "osc", "kind", "reason"), MANIFOLDS.values(), ids=MANIFOLDS)


@each_manifold
def test_a_member_without_an_answer_of_the_manifolds_is_nan_on_request_and_an_error_by_default(call, osc, kind, reason):
    with pytest.raises(kind, match=reason):
        call(osc)
    with pytest.warns(
        RuntimeWarning, match=rf"^1 of 3 members have no answer .* member 1, .*{kind.__name__}.*{reason}"
    ) as said:
        result = call(osc, on_failure="nan")
    assert len(said) == 1
    assert said[0].filename == __file__
    np.testing.assert_array_equal(np.isnan(result).reshape(-1, 3).any(axis=0), [False, True, False])
    assert np.isnan(result[..., 1]).all()
    np.testing.assert_allclose(result[..., [0, 2]], call(osc.members([0, 2])), rtol=1e-8)


@each_manifold
def test_one_oscillator_without_an_answer_of_the_manifolds_is_nan_in_the_shape_of_an_answer(call, osc, kind, reason):
    with pytest.warns(RuntimeWarning, match=f"^1 of 1 members have no answer .*{reason}"):
        result = call(osc.members(1), on_failure="nan")
    assert np.isnan(result).all()
    assert result.shape == np.shape(call(osc.members(0)))


@each_manifold
def test_what_is_no_question_about_manifolds_is_refused_under_either_policy(call, osc, kind, reason):
    for policy in ("raise", "nan"):
        with pytest.raises(ValueError, match=r"^delta = "):
            call(osc.members(delta=1.0), on_failure=policy)
    with pytest.raises(ValueError, match=r"^on_failure = 'ignore': must be one of 'raise', 'nan'"):
        call(osc, on_failure="ignore")


@pytest.mark.parametrize(
    "call",
    [lambda **o: splitting(Duffing(mu=0.1), 0.5, **o), lambda **o: homoclinic_tangency(Duffing(alpha=1e-9), **o)],
)
def test_an_unknown_method_is_refused_though_nan_is_asked_for(call):
    with pytest.raises(ValueError, match=r"^method = 'backward'"):
        call(method="backward", on_failure="nan")


@each_call
def test_a_bad_option_is_refused_though_nan_is_asked_for(call):
    with pytest.raises(ValueError, match=r"^max_steps = 0"):
        call(family(np.ones(2)), max_steps=0, on_failure="nan")


def test_without_a_tangency_at_alpha_0_the_question_is_refused_though_nan_is_asked_for():
    with pytest.raises(ValueError, match=r"alpha = .*must be > 0 for a tangency"):
        homoclinic_tangency(Duffing(alpha=[0.1, 0.0]), on_failure="nan")
