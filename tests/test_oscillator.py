"""The model: Eq. 1 to 4, scaling, families and the checks of its parameters."""

import copy
import pickle
from dataclasses import FrozenInstanceError, replace

import mpmath
import numpy as np
import pytest
import sympy as sp

from duffing import Duffing

SYMBOLS = dict(
    zip(("alpha", "p", "mu", "omega", "gamma"), sp.symbols("alpha p mu omega gamma", positive=True), strict=True)
)
DELTA = sp.Symbol("delta", negative=True)
SYMBOLIC = Duffing(**SYMBOLS, delta=DELTA)
X, V, T = sp.symbols("x v t", real=True)


def test_acceleration_is_equation_1_solved_for_the_second_derivative():
    alpha, p, mu, omega, gamma = SYMBOLS.values()
    printed = alpha * V * sp.Abs(V) ** (p - 1) + DELTA * X + gamma * X**3 - mu * sp.cos(omega * T)
    for sign in (1, -1):  # sympy decides |v| on each side of zero
        v = sp.Symbol("v", positive=True)
        assert sp.simplify((SYMBOLIC.acceleration(X, V, T) + printed).subs(V, sign * v)) == 0


def test_force_is_minus_the_gradient_of_the_potential():
    static = replace(SYMBOLIC, mu=sp.Integer(0))
    assert sp.simplify(static.force(X, T) + sp.diff(static.potential(X), X)) == 0
    assert static.force(X, T) == -DELTA * X - SYMBOLS["gamma"] * X**3


@pytest.mark.parametrize("p", [0.1, 0.5, 1.0, 2.0, 3.0])
def test_damping_is_odd_zero_at_rest_and_equals_equation_3(p):
    osc, v = Duffing(alpha=0.3, p=p), np.array([-2.0, -0.7, -1e-3, 1e-3, 0.7, 2.0])
    assert osc.damping(0.0) == 0.0
    np.testing.assert_allclose(osc.damping(v), 0.3 * v * np.abs(v) ** (p - 1), rtol=1e-14)
    np.testing.assert_array_equal(osc.damping(-v), -osc.damping(v))


def test_wells_lie_at_the_zeros_of_the_force_and_the_saddle_between_them():
    osc = Duffing(delta=-2.0, gamma=0.5)
    well = np.sqrt(2.0 / 0.5)
    assert osc.force(well, 0.0) == pytest.approx(0.0, abs=1e-14)
    assert osc.potential(well) == pytest.approx(-(2.0**2) / (4 * 0.5))
    assert osc.potential(0.0) == 0.0 > osc.potential(well)


def test_energy_is_conserved_by_the_unperturbed_flow_and_lost_to_damping_as_v_times_damping():
    x, v = sp.Function("x")(T), sp.Function("v")(T)
    osc = replace(SYMBOLIC, mu=sp.Integer(0))
    rate = sp.diff(osc.energy(x, v), T).subs({sp.Derivative(v, T): osc.acceleration(x, v, T), sp.Derivative(x, T): v})
    assert sp.simplify(rate + v * osc.damping(v)) == 0


def test_dimensionless_form_is_the_same_motion():
    """x = sqrt(-delta/gamma) X, t = tau / sqrt(-delta), put into Eq. 1 term by term."""
    osc = Duffing(alpha=0.3, p=0.7, mu=0.4, omega=1.3, delta=-2.0, gamma=3.0)
    unit = osc.dimensionless()
    length, rate = np.sqrt(2.0 / 3.0), np.sqrt(2.0)
    for x, v, t in ((0.3, -0.8, 0.0), (-1.1, 0.2, 2.2)):
        scaled = unit.acceleration(x / length, v / (length * rate), t * rate) * length * rate**2
        assert scaled == pytest.approx(osc.acceleration(x, v, t), rel=1e-13)
    assert (unit.delta, unit.gamma) == (-1.0, 1.0)


def test_fields_broadcast_to_a_family():
    family = Duffing(mu=np.linspace(0, 1, 5), p=np.array([[0.1], [1.0]]))
    assert family.shape == (2, 5)
    columns = family.columns()
    assert columns.shape == (6, 10)
    np.testing.assert_array_equal(columns[1], np.repeat([0.1, 1.0], 5))
    np.testing.assert_array_equal(columns[2], np.tile(np.linspace(0, 1, 5), 2))


def test_an_oscillator_cannot_be_changed_in_place():
    source = np.array([0.1, 0.2])
    osc = Duffing(mu=source)
    source[0] = 9.0
    assert osc.mu[0] == 0.1
    with pytest.raises(FrozenInstanceError):
        osc.mu = 1.0
    with pytest.raises(ValueError, match="read-only"):
        osc.mu[0] = 1.0


def through_pickle(osc):
    return pickle.loads(pickle.dumps(osc))


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, through_pickle])
def test_a_copy_is_equal_and_cannot_be_changed_in_place_either(copied):
    """A found failure: NumPy's own copy of a read-only array can be written to, and so nothing checked the number."""
    osc = Duffing(p=[0.5, 1.0], mu=0.3)
    again = copied(osc)
    assert again == osc and hash(again) == hash(osc)
    with pytest.raises(ValueError, match="read-only"):
        again.p[0] = -1.0


def test_equal_oscillators_are_equal_and_hash_alike():
    assert Duffing(mu=[0.1, 0.2]) == Duffing(mu=np.array([0.1, 0.2]))
    assert hash(Duffing(mu=[0.1, 0.2])) == hash(Duffing(mu=np.array([0.1, 0.2])))
    assert Duffing(mu=0.1) != Duffing(mu=0.2)
    assert Duffing() != "Duffing"


def test_one_exact_field_makes_all_fields_exact():
    assert Duffing(p=sp.Rational(1, 3)).alpha == sp.Rational(1, 10)
    assert isinstance(Duffing(p=mpmath.mpf(1)).alpha, mpmath.mpf)
    with pytest.raises(ValueError, match="family"):
        Duffing(p=sp.Rational(1, 3), mu=[0.1, 0.2])


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("alpha", -0.1, ">= 0"),
        ("p", 0.0, "> 0"),
        ("p", -1.0, "> 0"),
        ("omega", 0.0, "> 0"),
        ("omega", [1.0, -1.0], "> 0"),
        ("mu", np.nan, "finite"),
        ("mu", np.inf, "finite"),
        ("delta", -np.inf, "finite"),
        ("gamma", "one", "finite"),
        ("alpha", 1j, ">= 0"),
        ("alpha", None, ">= 0"),
        ("alpha", True, ">= 0"),
        ("p", mpmath.mpf(-1), "> 0"),
        ("p", mpmath.nan, "> 0"),
        ("omega", sp.Symbol("omega"), "> 0"),
        ("delta", sp.Symbol("delta"), "assumption"),
    ],
)
def test_a_bad_parameter_is_named_with_its_value_and_what_is_allowed(name, value, allowed):
    with pytest.raises(ValueError, match=rf"^{name} = .*{allowed}"):
        Duffing(**{name: value})


def test_fields_that_do_not_broadcast_are_refused_with_their_shapes():
    with pytest.raises(ValueError, match=r"'mu': \(2,\).*'omega': \(3,\)"):
        Duffing(mu=[0.1, 0.2], omega=[1.0, 2.0, 3.0])


@pytest.mark.parametrize(("delta", "gamma", "name"), [(1.0, 1.0, "delta"), (0.0, 1.0, "delta"), (-1.0, 0.0, "gamma")])
def test_the_dimensionless_form_and_its_units_need_a_double_well(delta, gamma, name):
    osc = Duffing(delta=delta, gamma=gamma)
    for ask in (osc.dimensionless, osc.units):
        with pytest.raises(ValueError, match=f"^{name} = .*double well"):
            ask()


def test_an_empty_family_and_a_ragged_field_are_refused():
    with pytest.raises(ValueError, match="empty family"):
        Duffing(mu=[])
    with pytest.raises(ValueError, match=r"^alpha = "):
        Duffing(alpha=[[1, 2], [3]])


def test_zero_and_negative_zero_are_one_oscillator():
    assert hash(Duffing(mu=[0.0])) == hash(Duffing(mu=[-0.0]))
    assert hash(Duffing(mu=0.0)) == hash(Duffing(mu=-0.0))
