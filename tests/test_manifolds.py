"""The manifolds as curves: invariant, evenly drawn, mirror images; exact where the exact curve is known."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from duffing import ConvergenceError, Duffing, critical_amplitude
from duffing.manifolds.curves import stable_manifold, unstable_manifold
from duffing.manifolds.saddle import saddle_orbit

LINEAR = Duffing(alpha=0.1, mu=0.12)
GENERAL = Duffing(alpha=0.2, p=0.6, mu=0.5, omega=1.3, delta=-2.0, gamma=0.5)


def stroboscopic_image(osc, points, direction, phase=0.0):
    """The points (2, n) after a period forward (1) or backward (-1), by SciPy's DOP853."""

    def field(t, y):
        return [y[1], osc.acceleration(y[0], y[1], t)]

    start = phase / osc.omega
    span = (start, start + direction * osc.period)
    return np.transpose(
        [solve_ivp(field, span, point, method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1] for point in points.T]
    )


def distance_from_curve(points, curve):
    """Distance (n,) of the points (2, n) from a polyline (2, m)."""
    start, chord = curve[:, :-1, None], np.diff(curve)[..., None]
    along = ((points[:, None] - start) * chord).sum(axis=0) / (chord**2).sum(axis=0)
    gap = points[:, None] - start - chord * np.clip(along, 0, 1)
    return np.hypot(*gap).min(axis=0)


def crossings(curve, other):
    """Number of intersections of two polylines (2, n)."""
    a, b = curve[:, :-1, None], other[:, None, :-1]
    da, db = np.diff(curve)[..., None], np.diff(other)[:, None]

    def cross(u, v):
        return u[0] * v[1] - u[1] * v[0]

    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = cross(b - a, db) / cross(da, db), cross(b - a, da) / cross(da, db)
    return np.count_nonzero((s >= 0) & (s < 1) & (t >= 0) & (t < 1))


@pytest.mark.parametrize(("manifold", "direction"), [(unstable_manifold, 1), (stable_manifold, -1)])
@pytest.mark.parametrize(("osc", "phase"), [(LINEAR, 0.0), (GENERAL, 1.0)])
def test_stroboscopic_map_carries_a_manifold_into_itself(manifold, direction, osc, phase):
    spacing, turn = 0.01, 0.05
    curve = manifold(osc, length=4.0, phase=phase, spacing=spacing, turn=turn)
    near = np.hypot(*(curve - curve[:, :1])) < 0.02
    image = stroboscopic_image(osc, curve[:, np.flatnonzero(near)[::10]], direction, phase)
    inside = np.hypot(*(image - curve[:, :1])) < 1.5  # the end of the curve is further away
    assert np.hypot(*(image[:, inside] - curve[:, :1])).max() > 0.5
    # A chord of the curve bends by at most `turn` over `spacing`: its greatest height is an eighth of both.
    assert distance_from_curve(image[:, inside], curve).max() < spacing * turn / 8 * 2


@pytest.mark.parametrize("manifold", [unstable_manifold, stable_manifold])
@pytest.mark.parametrize("side", [1, -1])
def test_curve_starts_in_the_saddle_orbit_along_its_direction(manifold, side):
    orbit = saddle_orbit(GENERAL)
    curve = manifold(GENERAL, side=side, length=1.0)
    direction = side * (orbit.unstable if manifold is unstable_manifold else orbit.stable)
    np.testing.assert_allclose(curve[:, 0], orbit.state, atol=1e-5)
    tangent = curve[:, 1] - curve[:, 0]
    np.testing.assert_allclose(tangent / np.hypot(*tangent), direction, atol=1e-4)


@pytest.mark.parametrize("spacing", [0.05, 0.01])
@pytest.mark.parametrize("turn", [0.2, 0.05])
def test_points_are_as_near_and_chords_as_aligned_as_asked(spacing, turn):
    curve = unstable_manifold(LINEAR, length=9.0, spacing=spacing, turn=turn)
    chord = np.diff(curve)
    length = np.hypot(*chord)
    assert length.max() <= spacing
    assert length.sum() == pytest.approx(9.0, abs=spacing)
    angle = np.abs(np.diff(np.unwrap(np.arctan2(chord[1], chord[0]))))
    long = (length[1:] > spacing / 100) | (length[:-1] > spacing / 100)
    assert angle[long].max() <= turn + 1e-9


def test_without_damping_and_forcing_both_manifolds_are_the_homoclinic_orbit():
    osc = Duffing(alpha=0.0, mu=0.0, delta=-2.0, gamma=0.5)
    for manifold, sign in ((unstable_manifold, -1), (stable_manifold, 1)):
        for side in (1, -1):
            curve = manifold(osc, side=side, length=2.5)
            np.testing.assert_allclose(osc.energy(*curve), 0.0, atol=1e-9)
            assert np.all(side * curve[0] > 0)
            assert np.abs(curve[0]).max() == pytest.approx(np.sqrt(2 * 2.0 / 0.5), abs=0.01)  # the outermost point
            assert np.sign(curve[1, len(curve[1]) // 4]) == -side * sign


@pytest.mark.parametrize("manifold", [unstable_manifold, stable_manifold])
def test_left_branch_is_the_mirror_image_of_the_right_one_half_a_period_later(manifold):
    left = manifold(GENERAL, side=-1, length=3.0, phase=0.4)
    right = manifold(GENERAL, side=1, length=3.0, phase=0.4 + np.pi)
    np.testing.assert_allclose(left, -right, atol=1e-6)


@pytest.mark.parametrize("side", [1, -1])
def test_loops_cross_above_the_critical_amplitude_in_pairs_and_not_below(side):
    osc = Duffing(alpha=0.1)
    mu_c = critical_amplitude(osc)
    counts = []
    for ratio in (0.7, 1.5):
        forced = replace(osc, mu=ratio * mu_c)
        curves = [m(forced, side=side, length=4.5, spacing=0.01) for m in (unstable_manifold, stable_manifold)]
        # The saddle orbit itself, where both start, is no crossing.
        apart = [curve[:, np.hypot(*(curve - curve[:, :1])) > 0.05] for curve in curves]
        counts.append(crossings(*apart))
    assert counts[0] == 0 < counts[1]
    assert counts[1] % 2 == 0 or counts[1] > 2  # of an infinite sequence the curves' ends may cut a pair


def test_scaling_carries_a_curve_over_exactly():
    curve, unit = unstable_manifold(GENERAL, length=2.0), unstable_manifold(GENERAL.dimensionless(), length=2.0)
    np.testing.assert_allclose(curve, np.array([[2.0], [2.0 * np.sqrt(2.0)]]) * unit, rtol=1e-12)


def test_branch_that_ends_in_an_attractor_has_no_more_length_than_that():
    """Unforced and damped, W^U is the solution that leaves the saddle point and falls into the well."""
    with pytest.raises(ConvergenceError, match=r"the branch is .* long and goes into an attractor"):
        unstable_manifold(Duffing(alpha=0.5, mu=0.0), length=20.0)


def test_bad_input_is_refused_by_name():
    with pytest.raises(ValueError, match=r"^osc has the shape \(2,\)"):
        unstable_manifold(Duffing(mu=[0.1, 0.2]))
    with pytest.raises(ValueError, match="side = 0"):
        stable_manifold(LINEAR, side=0)
    for name in ("length", "spacing", "turn"):
        with pytest.raises(ValueError, match=rf"{name} = 0"):
            stable_manifold(LINEAR, **{name: 0})
    with pytest.raises(ValueError, match="delta = 1"):
        unstable_manifold(Duffing(delta=1.0, mu=0.1))
    with pytest.raises(ValueError, match="more than 100000 points"):
        unstable_manifold(LINEAR, spacing=1e-5)
