"""Basins on grids: areas and symmetries that are known."""

import numpy as np
import pytest

from duffing import Duffing, poincare_section
from duffing.basins.attractors import UNRESOLVED, find_attractors
from duffing.basins.basins import basins, changed

RK4 = {"method": "rk4", "steps_per_period": 64}
X, V = np.linspace(-1.6, 1.6, 41), np.linspace(-1.1, 1.1, 31)


def test_without_forcing_basins_are_point_images_of_each_other_and_share_the_plane():
    found = basins(Duffing(), X, V, **RK4)
    assert found.labels.shape == (31, 41)
    off_centre = found.labels.ravel()[: X.size * V.size // 2]
    np.testing.assert_array_equal(off_centre, 1 - found.labels[::-1, ::-1].ravel()[: off_centre.size])
    np.testing.assert_allclose(found.shares, [0.5, 0.5, 0.0], atol=1 / X.size / V.size)


def test_the_grid_runs_along_x_in_columns_and_along_v_in_rows():
    found = basins(Duffing(), [-1.0, 1.0], [0.0, 0.05, 0.1], **RK4)
    np.testing.assert_array_equal(found.labels, [[0, 1]] * 3)


def test_at_phase_pi_basins_are_the_mirror_image():
    osc = Duffing(mu=0.07)
    known = find_attractors(osc, **RK4)
    here, there = (basins(osc, X, V, known, phase=phase, **RK4) for phase in (0.0, np.pi))
    points = np.array([one.points[:, 0] for one in known])
    mirrored = np.array([-poincare_section(osc, point, 1, phase=np.pi)[:, 0] for point in points])
    image = np.hypot(*np.moveaxis(mirrored[:, None] - points, -1, 0)).argmin(axis=1)
    assert sorted(image) == [0, 1, 2, 3] and np.all(image != np.arange(4))
    np.testing.assert_array_equal(image[here.labels], there.labels[::-1, ::-1])


def test_shares_count_the_unresolved():
    osc = Duffing(mu=0.2)
    found = basins(osc, X, V, periods=5, **RK4)
    assert found.shares.sum() == pytest.approx(1)
    assert found.shares[-1] == np.mean(found.labels == UNRESOLVED) > 0.1
    assert found.shares.size == len(found.attractors) + 1


def test_changed_counts_labels_by_attractor_and_not_by_number():
    osc = Duffing(mu=0.07)
    known = find_attractors(osc, **RK4)
    one, other = basins(osc, X, V, known, **RK4), basins(osc, X, V, known[::-1], **RK4)
    assert np.mean(one.labels != other.labels) > 0.5
    assert changed(one, other) == 0
    few = basins(osc, X, V, known, periods=3, **RK4)
    assert changed(one, few) == np.mean(few.labels == UNRESOLVED) > 0
    elsewhere = one._replace(attractors=tuple(a._replace(points=a.points + 1) for a in one.attractors))
    assert changed(one, elsewhere) == 1
    with pytest.raises(ValueError, match="must be the same"):
        changed(one, basins(osc, X[:5], V, known, **RK4))


def test_a_grid_must_increase():
    with pytest.raises(ValueError, match=r"^x = "):
        basins(Duffing(), [1.0, 0.0], V)
