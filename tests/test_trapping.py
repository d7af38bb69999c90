"""Trapping disks against maps whose basins are known."""

import numpy as np
import pytest

from duffing.basins.trapping import LARGEST, RATIO, contracted_form, trap


def repeated(step):
    def follow(states, repeats):
        for _ in range(repeats):
            states = step(states)
        return states

    return follow


def radii(found):
    """Half axes of the disk, the smaller one first."""
    return 1 / np.sqrt(np.linalg.eigvalsh(found.form)[::-1])


def test_a_linear_contraction_is_trapped_as_far_as_the_rings_go():
    matrix = np.array([[0.3, 0.9], [0.0, 0.3]])  # stretches at first: no disk of the Euclidean norm would do
    found = trap(repeated(lambda y: matrix @ y), np.zeros(2), matrix)
    assert LARGEST * RATIO < radii(found)[1] <= LARGEST
    assert radii(found)[0] < 0.9 * radii(found)[1]


def test_the_norm_contracts_by_the_root_of_the_spectral_radius():
    matrix = np.array([[0.7, 1.5], [-0.2, 0.1]])
    form, directions = contracted_form(matrix), np.random.default_rng(1).normal(size=(2, 100))

    def norm(y):
        return np.sqrt(np.einsum("ik,ij,jk->k", y, form, y))

    root = np.sqrt(np.max(np.abs(np.linalg.eigvals(matrix))))
    assert np.all(norm(matrix @ directions) <= root * norm(directions))


@pytest.mark.parametrize("point", [(0.0, 0.0), (2.0, -1.0)])
def test_the_disk_ends_where_a_ring_is_no_longer_mapped_into_the_next(point):
    centre = np.array(point)

    def step(
        y,
    ):  # the radius r goes to 0.19 r + r^3: attracting for r < 0.9, shrinks by the ratio for r^2 < ratio - 0.19
        away = y - centre[:, None]
        return centre[:, None] + (0.19 + 16 * np.sum(away**2, axis=0)) * away

    found = trap(repeated(step), centre, 0.19 * np.eye(2))
    limit = np.sqrt(RATIO - 0.19) / 4
    assert RATIO**2 * limit < radii(found)[0] <= limit
    assert np.ptp(radii(found)) < 1e-9
    np.testing.assert_allclose(found.centre, centre)


def test_the_disk_is_centred_where_the_followed_map_has_its_fixed_point():
    found = trap(repeated(lambda y: 0.1 * y + 9e-4), np.zeros(2), 0.1 * np.eye(2))
    np.testing.assert_allclose(found.centre, 1e-3, rtol=1e-5)


def test_there_is_no_disk_where_nothing_contracts_or_the_contraction_is_lost_in_noise():
    assert trap(repeated(lambda y: y), np.zeros(2), np.eye(2)) is None
    noisy = repeated(lambda y: 0.1 * y + 2e-3 * np.sign(np.sin(1e9 * y)))
    assert trap(noisy, np.zeros(2), 0.1 * np.eye(2)) is None


def test_holds_tells_the_inside_of_an_ellipse_from_the_outside():
    found = trap(repeated(lambda y: 0.1 * y), np.array([1.0, 2.0]), 0.1 * np.eye(2))
    radius = radii(found)[0]
    angle = np.linspace(0, 6, 20)
    circle = found.centre[:, None] + radius * np.array([np.cos(angle), np.sin(angle)])
    assert np.all(found.holds(found.centre[:, None] + 0.999 * (circle - found.centre[:, None])))
    assert not np.any(found.holds(found.centre[:, None] + 1.001 * (circle - found.centre[:, None])))
    assert found.holds(circle.reshape(2, 4, 5)).shape == (4, 5)
