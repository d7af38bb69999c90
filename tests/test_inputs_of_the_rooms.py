"""The functions of the rooms refuse what an argument cannot be by its name, as those of `duffing` itself do.

See test_inputs.py. Warnings are errors here too.
"""

import inspect
import pkgutil
from importlib import import_module

import numpy as np
import pytest
from bad_inputs import BAD, COUNTS, NOTHING, NUMBERS, POSITIVE
from hypothesis import given, settings
from hypothesis import strategies as st

from duffing import Duffing, DuffingError, basins, orbits, transients
from duffing.orbits.bifurcations import orbit_branches
from duffing.transients.crisis import large_saddle

OSC = Duffing(alpha=0.1, p=1.0, mu=0.02)
STRONG = Duffing(alpha=0.1, p=1.0, mu=0.3)
OUTER = tuple(large_saddle(STRONG))
SAMPLE = {"time": [3, 5, 8, 13], "settled": [True, True, True, False], "since": 0}
CURVE = {"osc": OSC, "side": 1, "length": 1.0, "phase": 0.0, "spacing": 0.1, "turn": 0.5}
ORBIT = {"osc": OSC, "state": (1.0, 0.0), "halves": 2}
STRIPS = {"osc": OSC, "periods": 8, "most": 1000}
START = [[0.9], [0.0]]


def sides(states):
    return states[0] > 0


def line(s):
    return np.array([s, s])[:, None], s > 0.5


# A valid call of each; in it one argument after the other is replaced by something that it is not.
CALLS = {
    "manifolds.curves.unstable_manifold": CURVE,
    "manifolds.curves.stable_manifold": CURVE,
    "melnikov.damping_integral": {"osc": OSC},
    "melnikov.forcing_integral": {"osc": OSC},
    "book.studies.melnikov.melnikov_quadrature": {"osc": OSC, "t0": 0.5, "digits": 10},
    "manifolds.sticking.sticking_amplitude": {"osc": OSC},
    "manifolds.correction.tangency_correction": {"osc": Duffing(p=0.5)},
    "orbits.periodic.half_period_map": ORBIT,
    "orbits.periodic.periodic_orbit": ORBIT,
    "orbits.periodic.periodic_orbits": {"osc": OSC, "starts": START, "halves": 2, "apart": 1e-5},
    "orbits.periodic.cycle": ORBIT,
    "orbits.periodic.path": {**ORBIT, "samples": 4},
    "book.studies.followed.amplitude": {**ORBIT, "samples": 4},
    "book.studies.followed.speed": {**ORBIT, "samples": 4},
    "book.studies.followed.stroboscopic": ORBIT,
    "orbits.diagram.bifurcation_diagram": {"osc": OSC, "mu": [0.1, 0.2], "starts": START, "transient": 0, "kept": 1},
    "orbits.bifurcations.orbit_branches": {
        "osc": Duffing(alpha=0.1, mu=[0.02]), "state": [[1.0], [0.0]], "halves": 2, "field": "mu", "bounds": (0.0, 0.03)
    },
    "basins.attractors.find_attractors": {"osc": OSC, "starts": START, "periods": 100},
    "basins.attractors.settle": {"osc": OSC, "states": START, "attractors": (), "periods": 10, "phase": 0.0},
    "basins.basins.basins": {
        "osc": OSC, "x": [0.9], "v": [0.0], "attractors": (), "periods": 10, "phase": 0.0
    },
    "basins.boundary.crossings": {"follow": line, "reach": 0.2, "least": 1e-3, "most": 1000},
    "basins.boundary.line_of_starts": {"osc": OSC, "start": (0.0, 0.0), "end": (1.0, 0.0), "periods": 6},
    "basins.contact.homoclinic_strips": STRIPS,
    "basins.contact.first_contact": {**STRIPS, "low": 0.07, "high": 0.09, "halvings": 1, "periods": 14},
    "transients.crisis.large_saddle": {"osc": STRONG},
    "transients.crisis.saddles": {"osc": STRONG, "outer": OUTER},
    "transients.crisis.crisis": {
        "osc": Duffing(alpha=0.1, mu=[0.0]), "lower": 0.24, "upper": 0.26, "outer": OUTER, "steps": 1, "points": 200
    },
    "transients.crisis.crisis_above": {
        "osc": Duffing(alpha=0.1, mu=[0.0]), "lower": 0.24, "outer": OUTER, "step": 0.02, "tries": 1, "steps": 1,
        "points": 100
    },
    "basins.fates.classify": {"osc": OSC, "states": START, "periods": 6, "last": 4},
    "transients.lifetimes.lifetimes": {
        "osc": OSC, "state": (0.9, 0.0), "periods": 10, "settling": 0, "radius": 0.1, "tolerance": 1e-4, "block": 40,
        "tangents": 0,
    },
    "book.studies.survival.survival": {"time": SAMPLE["time"], "settled": SAMPLE["settled"]},
    "book.studies.survival.exponential": SAMPLE,
    "book.studies.survival.rate": {"time": SAMPLE["time"], "captured": SAMPLE["settled"], "since": 0},
    "book.studies.survival.law_test": {**SAMPLE, "until": 13, "resamples": 2, "seed": 1},
    "basins.uncertainty.uncertain_starts": {
        "label": sides, "box": ((-1, 1), (-1, 1)), "eps": [0.1], "starts": 10, "seed": 1
    },
    "basins.uncertainty.dimension": {"eps": [0.1, 0.01, 0.001], "uncertain": [30, 10, 3], "starts": 100},
}  # an entry a line, or two  # fmt: skip
# Those that take what another one gave, or what a caller inside the package has checked.
WITHIN = {
    "orbits": "bifurcations bifurcation_curves correct follow_branches multipliers_of switch_branches",
    "basins": "boundary_dimension capture changed classify_path contracted_form first_capture ordered neighbourhood"
    " points_of trap",
    "transients": "beyond both_wells distance_to_basin_boundary returns",
}
INCREASING = [[2.0, 1.0], [], *NOTHING]
STATES = [1.0, [], np.zeros((3, 2)), np.zeros((2, 0)), [[np.nan], [0.0]], *NOTHING]
POINT = BAD["state"]
SOME = [bad for bad in STATES if bad is not None]  # None: a grid of them
WRONG = BAD | {
    **dict.fromkeys(("length", "spacing", "turn", "apart", "radius", "tolerance", "reach", "least", "step"), POSITIVE),
    **{
        key: [0, *COUNTS]
        for key in (
            "halves",
            "samples",
            "kept",
            "last",
            "block",
            "most",
            "halvings",
            "resamples",
            "digits",
            "steps",
            "tries",
            "points",
        )
    },
    "until": [0, *(bad for bad in COUNTS if bad is not None)],  # None: the longest time
    **{key: COUNTS for key in ("settling", "since", "seed")},
    **{key: STATES for key in ("states", "starts")},
    **{key: INCREASING for key in ("mu", "x", "v")},
    **{key: POINT for key in ("start", "end", "outer")},
    **{key: NUMBERS for key in ("low", "high", "lower", "upper")},
    "field": [0, "mass", *NOTHING],
    "bounds": [0.5, (0.1,), (0.2, 0.1), (np.nan, 1.0), ([0.0, 0.1], 1.0), *NOTHING],
    "attractors": [3, "a word", (1,), {}, object()],  # None: they are looked for
    "tangents": [2, -1, *NOTHING],
    **{key: [1, None, "a word"] for key in ("label", "follow")},
    "phase": [[0.0, 1.0], [], *BAD["phase"]],
    "box": [1.0, (1, 2), ((1, -1), (-1, 1)), ((np.nan, 1), (0, 1)), *NOTHING],
    "eps": [0.0, -1.0, *NOTHING],
    "uncertain": [1, [1, 2], [-1, 2, 3], [1000, 10, 3], *NOTHING],
    "time": [1.0, [], [1, 2], [-1, 1, 1, 1], [0.5, 1, 1, 1], *NOTHING],
    **{key: [1.0, [], [True], [1, 1, 1, 1], *NOTHING] for key in ("settled", "captured")},
}
# An argument of one name is not the same thing everywhere.
OTHERWISE = {
    "basins.attractors.find_attractors": {"starts": SOME},
    "basins.uncertainty.uncertain_starts": {"starts": [0, *COUNTS]},
    "basins.uncertainty.dimension": {"starts": [0, *COUNTS]},
}


def call(name, **arguments):
    module, _, function = name.rpartition(".")
    place = module if module.startswith("book.") else f"duffing.{module}"
    return getattr(import_module(place), function)(**{**CALLS[name], **arguments})


@pytest.mark.parametrize("room", [orbits, basins, transients])
def test_every_function_of_the_room_is_called_here_or_named_as_one_that_is_not(room):
    name = room.__name__.removeprefix("duffing.")
    found = set()
    for one in pkgutil.iter_modules(room.__path__):
        module = import_module(f"{room.__name__}.{one.name}")
        own = (
            key for key, value in inspect.getmembers(module, inspect.isfunction) if value.__module__ == module.__name__
        )
        found |= {key for key in own if not key.startswith("_")}
    called = {key.rpartition(".")[2] for key in CALLS if key.startswith(f"{name}.")}
    assert found == called | set(WITHIN[name].split())
    assert not called & set(WITHIN[name].split())


@pytest.mark.parametrize("name", CALLS)
def test_the_call_that_is_spoilt_below_is_a_good_one(name):
    call(name)


@pytest.mark.parametrize(("name", "argument"), [(name, argument) for name in CALLS for argument in CALLS[name]])
def test_what_an_argument_cannot_be_is_refused_by_its_name(name, argument):
    for bad in OTHERWISE.get(name, {}).get(argument, WRONG[argument]):
        with pytest.raises(ValueError, match=rf"\b{argument}\b"):
            call(name, **{argument: bad})


SINGLE = (
    "book.studies.melnikov.melnikov_quadrature",
    "manifolds.curves.unstable_manifold", "orbits.periodic.periodic_orbits",
    "basins.attractors.find_attractors", "basins.attractors.settle", "basins.basins.basins",
    "basins.boundary.line_of_starts", "basins.contact.homoclinic_strips", "basins.contact.first_contact",
    "transients.crisis.large_saddle",
)  # names in rows, not a column  # fmt: skip


@pytest.mark.parametrize("name", SINGLE)
def test_a_family_is_refused_where_one_oscillator_is_needed(name):
    with pytest.raises(ValueError, match=r"osc has the shape \(2,\): must be a single oscillator"):
        call(name, osc=Duffing(alpha=0.1, mu=[0.02, 0.03]))


# What takes no more than some seconds with any oscillator.
ANY_OSCILLATOR = (
    "manifolds.curves.stable_manifold",
    "manifolds.correction.tangency_correction",
    "orbits.periodic.periodic_orbit", "orbits.periodic.periodic_orbits", "orbits.periodic.path",
    "orbits.diagram.bifurcation_diagram", "basins.attractors.find_attractors",
    "basins.contact.homoclinic_strips", "basins.fates.classify", "transients.lifetimes.lifetimes",
)  # names in rows, not a column  # fmt: skip


def numbers_of(result):
    if isinstance(result, tuple | list):
        return [number for part in result for number in numbers_of(part)]
    return [result] if isinstance(result, float | np.ndarray) else []


@pytest.mark.parametrize("name", ANY_OSCILLATOR)
@given(
    alpha=st.floats(0, 0.5),
    p=st.floats(0.1, 3),
    mu=st.floats(-0.5, 0.5),
    omega=st.floats(0.3, 3),
    delta=st.floats(-2, 2),
    gamma=st.floats(-1, 2),
)
@settings(max_examples=10, deadline=None, derandomize=True)
def test_any_oscillator_is_answered_with_finite_numbers_or_refused(name, **parameters):
    try:
        result = call(name, osc=Duffing(**parameters))
    except DuffingError as error:
        assert str(error)
    except ValueError as error:
        assert any(f"{parameter} = " in str(error) for parameter in parameters)
    else:
        assert all(np.all(np.isfinite(number)) for number in numbers_of(result))


def test_counts_of_any_integer_type_are_those_numbers():
    small = np.uint8
    fates, ours = (basins.fates.classify(OSC, START, periods=kind(40), last=kind(4)) for kind in (small, int))
    np.testing.assert_array_equal(fates, ours)
    counts = {"periods": 250, "settling": 100, "block": 40}
    lived = transients.lifetimes.lifetimes(OSC, (0.9, 0.0), **{name: small(n) for name, n in counts.items()})
    np.testing.assert_equal(lived, transients.lifetimes.lifetimes(OSC, (0.9, 0.0), **counts))


def test_lengths_of_any_number_type_are_those_numbers():
    curves = [call("manifolds.curves.unstable_manifold", spacing=kind(0.5)) for kind in (np.float16, float)]
    np.testing.assert_array_equal(*curves)


def test_steps_that_are_too_long_to_be_squared_are_not_taken():
    """A found failure: Newton's method with steps of 1e200, whose length NumPy could only warn of."""
    osc = Duffing(alpha=[6.0], p=15.3, mu=2.83, omega=7.6, delta=2.3e-313, gamma=4.1e-221)
    with pytest.raises(DuffingError, match="Newton's method finds no solution"):
        orbit_branches(osc, [[0.0], [-2.43]], bounds=(-4.0, 4.0), points=8)
