"""Any input to a public function is either answered with finite numbers or refused by name; no warning leaks out.

Warnings are errors in this suite, so an overflow that NumPy would only mention fails the test that met it.
"""

from dataclasses import fields

import numpy as np
import pytest
import sympy
from bad_inputs import BAD
from hypothesis import given, settings
from hypothesis import strategies as st

import duffing
from duffing import Duffing, DuffingError

OSC = Duffing(alpha=0.1, p=1.0, mu=0.02)
RUN = {"osc": OSC, "state": (0.4, 0.1)}
ACCURATE = {"rtol": 1e-8, "atol": 1e-8, "max_steps": 1000, "switch": 0.5, "threads": 1}
SPECTRUM = {**RUN, "periods": 2, "transient": 0, "k": 1, "on_failure": "raise"}
# A valid call of every public function; in it one argument after the other is replaced by something that it is not.
CALLS = {
    "Duffing": {field.name: getattr(OSC, field.name) for field in fields(Duffing)},
    "critical_amplitude": {"osc": OSC},
    "homoclinic_orbit": {"osc": OSC, "t": 0.5, "side": 1},
    "homoclinic_tangency": {"osc": OSC, "method": "auto", "on_failure": "raise"},
    "lyapunov_spectrum": {**SPECTRUM, "method": "auto", **ACCURATE},
    "melnikov_function": {"osc": OSC, "t0": 0.5, "side": 1},
    "poincare_section": {**RUN, "periods": 2, "transient": 0, "phase": 0.0, "on_failure": "raise", **ACCURATE},
    "saddle_orbit": {"osc": OSC, "on_failure": "raise"},
    "splitting": {"osc": OSC, "phase": 0.3, "method": "auto", "on_failure": "raise"},
    "trajectory": {**RUN, "t": [0.0, 1.0], "method": "rk4", "on_failure": "raise", "threads": 1},
    "two_trajectory_exponent": {**RUN, "periods": 2, "transient": 0, "d0": 1e-8, "steps_per_period": 50},
}
SYMBOLIC = Duffing(alpha=sympy.Symbol("a", positive=True))
NUMERIC = ("homoclinic_tangency", "lyapunov_spectrum", "poincare_section", "saddle_orbit", "splitting", "trajectory")


def call(name, **arguments):
    return getattr(duffing, name)(**{**CALLS[name], **arguments})


def answers_or_refuses(name, **arguments):
    """Call the function: it may raise what the package says it raises; an answer is finite."""
    try:
        result = call(name, **arguments)
    except DuffingError as error:
        assert str(error)
        return
    for part in result if isinstance(result, tuple) else (result,):
        assert np.all(np.isfinite(part))


def test_every_public_function_is_called_here():
    functions = {name for name in duffing.__all__ if not isinstance(getattr(duffing, name), type)} | {"Duffing"}
    assert functions == CALLS.keys()


@pytest.mark.parametrize("name", CALLS)
def test_the_call_that_is_spoilt_below_is_a_good_one(name):
    call(name)


@pytest.mark.parametrize(("name", "argument"), [(name, argument) for name in CALLS for argument in CALLS[name]])
def test_what_an_argument_cannot_be_is_refused_by_its_name(name, argument):
    for bad in BAD[argument]:
        with pytest.raises(ValueError, match=rf"\b{argument}\b"):
            call(name, **{argument: bad})


@pytest.mark.parametrize("name", NUMERIC)
def test_a_symbol_in_a_computation_is_refused_by_its_name(name):
    with pytest.raises(ValueError, match="alpha = a: must be"):
        call(name, osc=SYMBOLIC)


@pytest.mark.parametrize("name", ["trajectory", "poincare_section", "lyapunov_spectrum"])
def test_an_unknown_option_is_refused_with_those_that_exist(name):
    with pytest.raises(ValueError, match=r"stepz.*must be one of"):
        call(name, stepz=50)


@pytest.mark.parametrize("name", ["trajectory", "poincare_section", "lyapunov_spectrum"])
def test_tangents_are_no_option_of_what_would_not_return_them(name):
    with pytest.raises(TypeError, match="tangents"):
        call(name, tangents=1)


@pytest.mark.parametrize("kind", [np.int8, np.uint8, np.uint64])
@pytest.mark.parametrize("name", ["poincare_section", "lyapunov_spectrum", "two_trajectory_exponent"])
def test_a_count_of_any_integer_type_is_that_number(name, kind):
    """A found failure: 100 + 100 left the range of eight bits, and minus an unsigned number is none."""
    results = [getattr(duffing, name)(**RUN, periods=one(100), transient=one(100)) for one in (kind, int)]
    np.testing.assert_equal(*results)


def test_a_tolerance_that_no_exponent_fits_is_named():
    with pytest.raises(ValueError, match=r"rtol = 1e-17: .* 2\.2e\+01"):
        call("lyapunov_spectrum", rtol=1e-17)


anything = st.floats() | st.integers(-(10**40), 10**40) | st.text(max_size=3) | st.none() | st.booleans()


@given(st.fixed_dictionaries({field.name: anything for field in fields(Duffing)}))
@settings(max_examples=300, deadline=None, derandomize=True)
def test_an_oscillator_of_anything_is_valid_or_its_field_is_named(values):
    try:
        osc = Duffing(**values)
    except ValueError as error:
        assert any(f"{name} = " in str(error) for name in values)
    else:
        assert np.all(np.isfinite(osc.columns()))


positive = st.floats(min_value=0, exclude_min=True, allow_infinity=False, allow_nan=False)
finite = st.floats(allow_infinity=False, allow_nan=False)
double_wells = st.builds(
    Duffing, alpha=positive, p=positive, mu=finite, omega=positive, delta=positive.map(lambda d: -d), gamma=positive
)


@given(double_wells, finite)
@settings(max_examples=300, deadline=None, derandomize=True)
def test_the_formulas_answer_with_finite_numbers_at_any_double_or_refuse(osc, t):
    answers_or_refuses("critical_amplitude", osc=osc)
    answers_or_refuses("homoclinic_orbit", osc=osc, t=t)
    answers_or_refuses("melnikov_function", osc=osc, t0=t)


def between(low, high):
    return st.floats(low, high, allow_nan=False)


oscillators = st.builds(
    Duffing,
    alpha=between(0, 10),
    p=between(0.02, 20),
    mu=between(-3, 3),
    omega=between(0.2, 10),
    delta=between(-3, 3),
    gamma=between(-3, 3),
)
states = st.tuples(between(-3, 3), between(-3, 3))


@given(oscillators, states, st.sampled_from(["rk4", "friction"]))
@settings(max_examples=60, deadline=None, derandomize=True)
def test_the_integrators_answer_with_finite_numbers_or_refuse(osc, state, method):
    options = {"rtol": 1e-6, "atol": 1e-8} if method == "friction" else {"steps_per_period": 100}
    try:
        states = duffing.trajectory(osc, state, [0.0, 0.5 * osc.period, osc.period], method=method, **options)
        points = duffing.poincare_section(osc, state, periods=2, method=method, **options)
    except DuffingError as error:
        assert "alpha = " in str(error)
    else:
        assert np.all(np.isfinite(states)) and np.all(np.isfinite(points))


@given(
    between(0, 0.5), between(0.1, 3), between(-0.2, 0.2), between(0.3, 3), between(-2, -0.3), between(0.3, 2), finite
)
@settings(max_examples=12, deadline=None, derandomize=True)
def test_saddle_orbits_and_tangencies_are_found_or_refused(alpha, p, mu, omega, delta, gamma, phase):
    osc = Duffing(alpha=alpha, p=p, mu=mu, omega=omega, delta=delta, gamma=gamma)
    answers_or_refuses("saddle_orbit", osc=osc)
    answers_or_refuses("splitting", osc=osc, phase=phase)
    if alpha > 0:
        answers_or_refuses("homoclinic_tangency", osc=osc)
