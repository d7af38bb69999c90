"""When a state counts as caught: a disk round an attracting periodic point that the flow carries into itself.

Near the point the map of one return contracts, not in every norm but in that of a form Q that the linearised map
supplies. Rings of that norm, each smaller than the last by a fixed ratio, are followed: where every ring's image lies
inside the next ring the whole disk shrinks onto the point, and a state in it has its fate. For a homeomorphism of the
plane maps a disk onto the inside of its border's image; and where creep makes the map non-invertible, the rings are a
dense sample of the disk. Rings below LINEAR may drown in the integrator's error: there the linearised map decides.
"""

from typing import NamedTuple

import numpy as np
import scipy.linalg

RATIO = 0.6  # of successive rings
MARGIN = 0.98  # an image must stay inside the next ring by this factor: a ring is known at its marked points alone
ANGLES = 32  # marked points on a ring
LEAST, LINEAR, LARGEST = 3e-6, 1e-3, 1.0  # radii of the rings in (x, v)
STRONGEST, WEAKEST = 0.2, 0.999  # modulus of the multipliers aimed at by repeating the map, and the weakest allowed


class Trap(NamedTuple):
    """The disk of states y with (y - centre)^T form (y - centre) < 1 : centre (2,), form (2, 2)."""

    centre: np.ndarray
    form: np.ndarray

    def holds(self, states):
        """Which of the states (2, ...) lie in the disk: boolean array (...)."""
        x, v = (part - centre for part, centre in zip(states, self.centre, strict=True))
        return self.form[0, 0] * x * x + 2 * self.form[0, 1] * x * v + self.form[1, 1] * v * v < 1


def trap(follow, point, jacobian):
    """The largest such disk round an attracting fixed point, or None if there is none that the rings can prove.

    follow : follow(states (2, M), m) gives the states after m applications of the map
    point : (2,), fixed under the map, or nearly so
    jacobian : (2, 2), the linearised map, its multipliers below one in modulus
    """
    modulus = np.max(np.abs(np.linalg.eigvals(jacobian)))
    if modulus > WEAKEST:
        return None
    repeats = max(1, int(np.ceil(np.log(STRONGEST) / np.log(max(modulus, 1e-300)))))
    form = contracted_form(np.linalg.matrix_power(jacobian, repeats))
    point = follow(point[:, None], 6 * repeats)[:, 0]  # what is fixed under the followed map, its error included
    number = int(np.log(LARGEST / LEAST) / -np.log(RATIO)) + 1
    radii = LEAST * RATIO ** -np.arange(number)  # from the least ring out
    angle = 2 * np.pi * np.arange(ANGLES) / ANGLES
    circle = np.linalg.solve(np.linalg.cholesky(form).T, [np.cos(angle), np.sin(angle)])  # norm one under the form
    rings = point[:, None, None] + radii[:, None] * circle[:, None, :]
    image = follow(rings.reshape(2, -1), repeats).reshape(rings.shape) - point[:, None, None]
    reached = np.sqrt(np.einsum("irk,ij,jrk->rk", image, form, image).max(axis=1))
    shrinks = reached < MARGIN * RATIO * radii
    first = int(np.argmax(shrinks))  # smaller rings may drown in the integrator's error
    if not shrinks[first] or radii[first] > LINEAR:
        return None
    last = number - 1 if shrinks[first:].all() else first + int(np.argmin(shrinks[first:])) - 1
    return Trap(point, form / radii[last] ** 2)


def contracted_form(matrix):
    """Q (2, 2), least eigenvalue one, with |A y| <= s |y| in its norm, s the root of A's spectral radius (>= 0.3)."""
    root = max(0.3, np.sqrt(np.max(np.abs(np.linalg.eigvals(matrix)))))
    form = scipy.linalg.solve_discrete_lyapunov((matrix / root).T, np.eye(2))
    return form / np.linalg.eigvalsh(form)[0]
