"""The saddle orbit: existence, uniqueness and hyperbolicity, for every forcing amplitude of an interval.

The equation is unchanged by (x, v, t) -> (-x, -v, t + pi / omega). A fixed point of Q = -(flow over half a period)
is therefore an orbit of the forcing's period with x(t + pi / omega) = -x(t). Krawczyk's test finds it.
"""

from dataclasses import dataclass, replace

from flint import arb, arb_mat

from .crossing import to_phase
from .lohner import solution_set
from .oscillator import NotProved, around

ORDERS = (20, 16)
WIDE = 1e-4  # half an interval of forcing amplitudes that is divided
RADIUS = 1e-4  # of the box that is proved to hold one fixed point
ZERO = arb_mat(3, 3)
NOTHING = arb(0)
ONE = arb_mat([[1, 0], [0, 1]])
MIRROR, EXCHANGE = arb_mat([[1, 0], [0, -1]]), arb_mat([[0, 1], [1, 0]])


@dataclass(frozen=True)
class Saddle:
    """The saddle orbit at phase 0 for the forcing amplitudes mu + spread.

    z : (x, v) at mu, a ball, the only one within RADIUS; slope : dz/dmu over the interval;
    frame : columns near the eigenvectors of Q, unstable first, exact.
    """

    mu: arb
    spread: arb
    z: arb_mat
    slope: arb_mat
    frame: arb_mat

    def reversed(self):
        """The same orbit backward in time, of the reversed oscillator: its mirror image, with the frame exchanged."""
        return replace(self, z=MIRROR * self.z, slope=MIRROR * self.slope, frame=MIRROR * self.frame * EXCHANGE)


def half_map(osc, z, mu, spread, drift):
    """Q at the states z + drift * spread[2] + spread[:2] for mu + spread[2]: where spread = 0, and its derivative."""
    C = arb_mat([[1, 0, drift[0, 0]], [0, 1, drift[1, 0]], [0, 0, 1]])
    start = solution_set((z[0, 0], z[1, 0], mu), spread, (0, 0, 0), C, (0, 0, 0), ZERO)
    end = to_phase(osc, start, 1, ORDERS)
    slope, image = -end.derivative(), arb_mat([[-value] for value in end.box(1)[:2]])
    return image, columns(slope, 0, 2), columns(slope, 2, 3)


def columns(matrix, first, last):
    """Some columns of the rows x and v."""
    return arb_mat([row[first:last] for row in matrix.tolist()[:2]])


def saddle(osc, mu, spread=NOTHING):
    """The Saddle of an oscillator. mu : exact ball; spread : ball around 0. Raises NotProved."""
    z, inverse, drift = _newton(osc, mu)
    held = _fixed(osc, z, mu, arb(0), drift, inverse)
    frame = _eigenframe(half_map(osc, z, mu, (0, 0, 0), drift)[1].mid())
    return Saddle(mu, spread, z + held, _slope(osc, mu, spread, (z, inverse, drift)), frame)


def _slope(osc, mu, spread, start):
    """dz/dmu for each forcing amplitude of mu + spread; where that is wide, part by part, which is sharper."""
    if spread.rad() > WIDE:
        quarter, slopes = (spread.rad() / 2).upper(), []
        for part in ((mu + sign * quarter).mid() for sign in (-1, 1)):
            near = _newton(osc, part)
            slopes.append(_slope(osc, part, around(1.01 * quarter), near))
            close(near[0] + slopes[-1] * (mu - part), start[0])
        return arb_mat([[slopes[0][i, 0].union(slopes[1][i, 0])] for i in (0, 1)])
    z, inverse, drift = start
    near = _fixed(osc, z, mu, spread, drift, inverse)
    _, slope, by_mu = half_map(osc, z, mu, (near[0, 0], near[1, 0], spread), drift)
    return drift + (ONE - slope).inv() * (by_mu - drift)


def close(z, other):
    """Assert that two points on saddle orbits of one forcing amplitude are so close that the orbits are the same."""
    if not all(abs(z[i, 0] - other[i, 0]) < RADIUS / 2 for i in (0, 1)):
        raise NotProved(f"one saddle orbit: {z[0, 0].str(9)} and {other[0, 0].str(9)}")


def _newton(osc, mu):
    """(z, (1 - DQ)^-1, dz/dmu) at the fixed point, nearly: points."""
    z = nothing = arb_mat(2, 1)
    for _ in range(8):
        image, slope, by_mu = half_map(osc, z, mu, (0, 0, 0), nothing)
        inverse = (ONE - slope).inv().mid()
        change = inverse * (z - image)
        z = (z - change).mid()
        if abs(change[0, 0]) < 1e-24 and abs(change[1, 0]) < 1e-24:
            break
    return z, inverse, (inverse * by_mu).mid()


def _fixed(osc, z, mu, spread, drift, inverse):
    """The box about z + drift (mu' - mu) that holds the one fixed point within RADIUS, for each mu'."""
    box = arb_mat([[around(RADIUS)]] * 2)
    held = _krawczyk(osc, z, mu, spread, drift, inverse, box)
    if not all(box[i, 0].contains_interior(held[i, 0]) for i in (0, 1)):
        raise NotProved(f"Krawczyk: the box of radius {RADIUS} has an image of {held[0, 0].str(3)}")
    if not all(held[i, 0].contains(0) for i in (0, 1)):
        raise NotProved(f"Krawczyk: the image {held[0, 0].str(3)} of the box does not hold its middle")
    for _ in range(4):  # what is fixed in a box lies in the box's image
        held = _krawczyk(osc, z, mu, spread, drift, inverse, held)
    return held


def _krawczyk(osc, z, mu, spread, drift, inverse, box):
    """Krawczyk's operator: z + drift (mu' - mu) + box is mapped to the like with the box returned, for each mu'.

    Where the box returned lies inside the box, there is exactly one fixed point of Q in it.
    """
    image, slope, by_mu = half_map(osc, z, mu, (box[0, 0], box[1, 0], spread), drift)
    return inverse * (image - z) + inverse * (by_mu - drift) * spread + (ONE - inverse * (ONE - slope)) * box


def _eigenframe(M):
    """Points near the eigenvectors of a 2 x 2 matrix with two real eigenvalues, the larger first."""
    half, det = (M[0, 0] + M[1, 1]) / 2, M[0, 0] * M[1, 1] - M[0, 1] * M[1, 0]
    root = (half * half - det).sqrt()
    large = half - root if half < 0 else half + root
    columns = []
    for value in (large.mid(), (det / large).mid()):
        a, b = M[0, 1].mid(), (value - M[0, 0]).mid()
        size = (a * a + b * b).sqrt() * (1 if a > 0 else -1)
        columns.append(((a / size).mid(), (b / size).mid()))
    return arb_mat([[columns[0][i], columns[1][i]] for i in (0, 1)])
