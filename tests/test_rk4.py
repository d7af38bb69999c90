"""The paper's Runge-Kutta kernel: against exact solutions, an independent plain loop, and the laws of the flow."""

import numpy as np
import pytest

from duffing.errors import DivergedError
from duffing.integrators import rk4
from duffing.integrators.friction_time import adaptive as friction
from duffing.oscillator import Duffing

START = (0.45, 0.1)


def _periods(osc, n):
    return osc.period * np.arange(n + 1)


def _plain_rk4(osc, state, periods, steps=500):
    """The textbook's loop in NumPy, all members at once: states (2, periods + 1, N)."""
    y = np.array(np.broadcast_to(np.reshape(state, (2, -1)), (2, max(1, np.prod(osc.shape, dtype=int)))), dtype=float)
    h, out = osc.period / steps, [y]
    for n in range(periods * steps):

        def f(c, y, n=n):
            return np.array([y[1], osc.acceleration(y[0], y[1], (n % steps + c) * h)])

        k1 = f(0, y)
        k2 = f(0.5, y + h / 2 * k1)
        k3 = f(0.5, y + h / 2 * k2)
        k4 = f(1, y + h * k3)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        if (n + 1) % steps == 0:
            out.append(y)
    return np.stack(out, axis=1)


def _linear_oscillator(alpha, delta, mu, omega, t):
    """Exact x of x'' + alpha x' + delta x = mu cos(omega t), start x = 1, v = 0."""
    steady = mu / (delta - omega**2 + 1j * alpha * omega)
    root = (-alpha + np.sqrt(complex(alpha**2 - 4 * delta))) / 2
    # Transient Re(z exp(root t)) with x(0) = 1 - Re steady, v(0) = -Re(i omega steady).
    a, b = 1 - steady.real, -(1j * omega * steady).real
    z = a - 1j * (b - root.real * a) / root.imag
    return (z * np.exp(root * t) + steady * np.exp(1j * omega * t)).real


def test_linear_oscillator_is_solved_to_fourth_order():
    osc = Duffing(alpha=0.3, p=1, mu=0.7, omega=1.3, delta=2.0, gamma=0.0)
    t = np.linspace(0.0, 12.0, 7)
    exact = _linear_oscillator(0.3, 2.0, 0.7, 1.3, t)
    errors = [
        np.abs(rk4.integrate(osc, (1, 0), t, steps_per_period=s).states[0, :, 0] - exact).max() for s in (50, 100)
    ]
    assert errors[1] < 1e-6
    # One halving of the step leaves 1/16 of the error, up to terms of the next order in the step (about 0.1).
    assert abs(np.log2(errors[0] / errors[1]) - 4) < 0.1


def test_undamped_energy_is_kept_to_the_order_of_the_step():
    osc = Duffing(alpha=0.0, mu=0.0)
    drift = []
    for steps in (100, 200):
        x, v = rk4.integrate(osc, (1.3, 0.2), np.linspace(0, 10, 11), steps_per_period=steps).states
        drift.append(np.abs(osc.energy(x, v) - osc.energy(1.3, 0.2)).max())
    assert drift[1] < drift[0] / 12
    assert drift[1] < 1e-6


@pytest.mark.parametrize("p", [0.1, 0.5, 1.0, 2.0])
def test_kernel_equals_a_plain_runge_kutta_loop_to_round_off(p):
    osc = Duffing(alpha=0.2, p=p, mu=np.array([0.2, 0.27, 0.3]), omega=1.3, delta=-1.2, gamma=0.8)
    ours = rk4.integrate(osc, START, _periods(osc, 2)).states
    # 4000 stages of round-off; p < 1 amplifies it where v changes sign.
    assert np.abs(ours - _plain_rk4(osc, START, 2)).max() < 2e-12


def test_family_over_all_parameters_equals_its_members_one_by_one_to_the_last_bit():
    rng = np.random.default_rng(7)
    fields = {
        "alpha": rng.uniform(0.05, 0.3, 9), "p": rng.choice([0.1, 0.5, 1.0, 2.0], 9), "mu": rng.uniform(0, 0.4, 9),
        "omega": rng.choice([0.7, 1.0, 1.9], 9), "delta": rng.uniform(-1.5, -0.5, 9), "gamma": rng.uniform(0.5, 1.5, 9),
    }  # fmt: skip
    states = rng.uniform(-1, 1, (2, 9))
    t = np.linspace(0.3, 9.0, 13)
    family = rk4.integrate(Duffing(**fields), states, t, tangents=2)
    for i in range(9):
        alone = rk4.integrate(Duffing(**{k: v[i] for k, v in fields.items()}), states[:, i], t, tangents=2)
        assert np.array_equal(alone.states[..., 0], family.states[..., i])
        assert np.array_equal(alone.growth[..., 0], family.growth[..., i])
        assert np.array_equal(alone.propagators[..., 0], family.propagators[..., i])


@pytest.mark.parametrize("p", [0.1, 1.0])
def test_bits_depend_neither_on_blocks_nor_on_threads_nor_on_order(p):
    mu = np.linspace(0.2, 0.3, 77)

    def run(chosen, threads):
        osc = Duffing(p=p, mu=mu[chosen])
        return rk4.integrate(osc, START, _periods(osc, 3), tangents=1, threads=threads)

    everything = run(slice(None), 1)
    # Two blocks on more threads; other places in the block, the vector and the padding.
    for chosen, threads in ((slice(None), 3), (slice(None, None, -1), 2), (slice(60, None), 1), (slice(3, 4), 1)):
        part = run(chosen, threads)
        assert np.array_equal(part.states, everything.states[..., chosen])
        assert np.array_equal(part.growth, everything.growth[..., chosen])


@pytest.mark.parametrize("p", [0.1, 0.5, 1.0, 2.0])
def test_motion_is_symmetric_under_reflection_and_half_a_period(p):
    osc = Duffing(p=p, mu=0.21, omega=1.3)
    t = _periods(osc, 3)
    one = rk4.integrate(osc, START, t, tangents=1)
    other = rk4.integrate(osc, -np.array(START), t + osc.period / 2, tangents=1)
    assert np.abs(one.states + other.states).max() < 1e-10
    assert np.abs(one.growth - other.growth).max() < 1e-9


@pytest.mark.parametrize("p", [0.5, 1.0, 2.0])
def test_tangents_equal_central_differences_of_the_flow(p):
    osc = Duffing(alpha=0.2, p=p, mu=0.3, omega=1.2)
    # Five times inside a stretch without a change of sign of v, where the flow is smooth for every p.
    t = np.linspace(0.0, 0.8, 5)
    d = 1e-5
    starts = np.array([START, START, START, START]).T + d * np.array([[1, -1, 0, 0], [0, 0, 1, -1]])
    orbit = rk4.integrate(osc, START, t, tangents=2)
    ends = [rk4.integrate(osc, s, t).states[:, -1, 0] for s in starts.T]
    difference = np.array([(ends[0] - ends[1]) / (2 * d), (ends[2] - ends[3]) / (2 * d)]).T
    product = np.linalg.multi_dot(np.moveaxis(orbit.propagators[..., 0], 2, 0)[::-1])
    assert np.all(orbit.states[1] > 0)
    assert np.abs(product - difference).max() < 1e-7
    # The QR factors of the product: growth is the logarithm of R's diagonal.
    assert np.allclose(orbit.growth.sum(axis=1)[:, 0], np.log(np.abs(np.diag(np.linalg.qr(product)[1]))), atol=1e-12)


@pytest.mark.parametrize("steps", [125, 250])
def test_linear_damping_contracts_area_by_exp_minus_alpha_T(steps):
    osc = Duffing(alpha=0.15, p=1, mu=0.27, omega=np.array([0.8, 1.3]))
    t = np.arange(6)[:, None] * osc.period
    orbit = rk4.integrate(osc, START, t, tangents=2, steps_per_period=steps)
    h = osc.period / steps
    assert np.all(np.abs(orbit.growth.sum(axis=0) + 0.15 * osc.period) < 5 * h**4)
    determinants = np.linalg.det(np.moveaxis(orbit.propagators, (2, 3), (0, 1)))
    assert np.allclose(determinants, np.exp(-0.15 * osc.period), rtol=5e-5, atol=0)


def test_first_tangent_grows_alike_alone_and_in_company():
    osc = Duffing(p=0.5, mu=np.array([0.2, 0.26]))
    one, two = (rk4.integrate(osc, START, _periods(osc, 4), tangents=k) for k in (1, 2))
    assert np.array_equal(one.growth[0], two.growth[0])
    assert np.array_equal(one.states, two.states)


def test_growth_over_one_long_interval_is_the_sum_over_short_ones_and_does_not_overflow():
    # At the top of the potential hill the linear rate is known exactly, and exp(rate T) = exp(1236) is no double.
    osc = Duffing(alpha=0.1, p=1, mu=0.0)
    rate = (-0.1 + np.sqrt(0.01 + 4)) / 2
    t = np.array([0.0, 1300.0])
    growth = rk4.integrate(osc, (0.0, 0.0), t, tangents=1).growth[0, 0, 0]
    transient = np.log(np.hypot(1, rate) * ((rate + 0.1) / (2 * rate + 0.1)))  # of (1, 0) along the growing direction
    assert abs(growth - (rate * 1300.0 + transient)) < 1e-5


@pytest.mark.parametrize("omega", [1e-8, 1e-12, 1e-300])
def test_a_forcing_that_hardly_changes_is_a_constant_force(omega):
    """A found failure: where a phase moved by less than its rounding, time stood still."""
    t = np.linspace(0.0, 0.1, 11)
    constant = friction.integrate(Duffing(mu=0.3, omega=omega), START, t).states
    np.testing.assert_allclose(rk4.integrate(Duffing(mu=0.3, omega=omega), START, t).states, constant, atol=1e-10)


def test_rest_under_power_law_damping_stays_at_rest_exactly():
    osc = Duffing(p=np.array([0.1, 0.5, 1.5]), mu=0.0)
    assert np.array_equal(rk4.integrate(osc, (1.0, 0.0), [0.0, 7.0]).states[:, 1], [[1.0] * 3, [0.0] * 3])


def test_tangent_map_of_exact_rest_for_p_below_one_is_the_derivative_of_the_flow():
    osc, t = Duffing(p=0.5, mu=0.0), [0.0, 3.0, 7.0]
    orbit = rk4.integrate(osc, (1.0, 0.0), t, tangents=2)
    # By the other integrator: what a small d displaces is of order d^(1/p - 1) in x, d^(1 - p) in v, beside d itself.
    d = 1e-8
    rest, in_x, in_v = (friction.integrate(osc, s, t).states[:, -1, 0] for s in ((1, 0), (1 + d, 0), (1, d)))
    derivative = np.transpose([(in_x - rest) / d, (in_v - rest) / d])
    product = orbit.propagators[..., 1, 0] @ orbit.propagators[..., 0, 0]
    assert np.abs(product - derivative).max() < 1e-3
    assert np.array_equal(orbit.growth[..., 0], [[0.0, 0.0], [-np.inf, -np.inf]])


def test_members_forced_moving_or_off_balance_do_not_count_as_at_rest():
    mu, starts = np.array([0.0, 0.3, 0.0, 0.0]), np.array([[-1.0, -1.0, -1.0, -0.9], [0.0, 0.0, 0.2, 0.0]])
    together = rk4.integrate(Duffing(p=0.1, mu=mu), starts, [0.0, 7.0], tangents=1)
    alone = rk4.integrate(Duffing(p=0.1, mu=mu[1:]), starts[:, 1:], [0.0, 7.0], tangents=1)
    assert np.array_equal(together.growth[0, 0] == 0, [True, False, False, False])
    assert np.array_equal(together.growth[..., 1:], alone.growth)
    assert np.array_equal(together.states[..., 1:], alone.states)


def test_tangent_of_undamped_rest_grows_as_in_the_linear_equation():
    growth = rk4.integrate(Duffing(alpha=0.0, p=0.5, mu=0.0), (0.0, 0.0), [0.0, 3.0], tangents=1).growth[0, 0, 0]
    assert abs(growth - np.log(np.hypot(np.cosh(3.0), np.sinh(3.0)))) < 1e-7


@pytest.mark.parametrize("p", [0.1, 0.5])
def test_a_start_from_rest_off_balance_has_finite_tangents_for_p_below_one(p):
    orbit = rk4.integrate(Duffing(p=p, mu=0.3), (0.45, 0.0), 2 * np.pi * np.arange(3), tangents=1)
    assert np.all(np.isfinite(orbit.growth))


def test_diverging_solutions_are_named():
    osc = Duffing(delta=1.0, gamma=-1.0, mu=np.array([0.0, 0.01]))
    with pytest.raises(DivergedError, match=r"1 of 2 .* mu = 0\.01"):
        rk4.integrate(osc, np.array([[0.5, 3.0], [0.0, 0.0]]), [0.0, 50.0])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"state": (0.0, np.nan)}, "state"),
        ({"state": (0.0, 1.0, 2.0)}, "state has shape"),
        ({"t": [0.0, 1.0, 1.0]}, "t = "),
        ({"t": [0.0, np.inf]}, "t = "),
        ({"t": np.zeros((2, 3))}, "t has shape"),
        ({"t": np.array([[0.0, 1.0], [1.0, 0.5]])}, "t = "),
        ({"t": []}, "t has shape"),
        ({"tangents": 3}, "tangents = 3"),
        ({"tangents": -1}, "tangents = -1"),
        ({"steps_per_period": 0}, "steps_per_period = 0"),
        ({"steps_per_period": 10.5}, "steps_per_period = 10.5"),
        ({"threads": 0}, "threads = 0"),
        ({"osc": Duffing(p=np.array([2.0, 300.0]))}, r"^p = 300\.0: must be"),
    ],
)
def test_invalid_input_is_named(change, message):
    arguments = {"osc": Duffing(mu=np.array([0.1, 0.2])), "state": START, "t": [0.0, 1.0]} | change
    with pytest.raises(ValueError, match=message):
        rk4.integrate(**arguments)


def test_input_is_not_changed():
    state, t = np.array([[0.1, 0.2], [0.3, 0.4]]), np.array([0.0, 1.0, 2.0])
    kept = state.copy(), t.copy()
    rk4.integrate(Duffing(mu=np.array([0.1, 0.2])), state, t, tangents=2)
    assert np.array_equal(state, kept[0])
    assert np.array_equal(t, kept[1])
