"""The model, Eq. 1 of the paper: x'' + alpha x'|x'|^(p-1) + delta x + gamma x^3 = mu cos(omega t)."""

from dataclasses import dataclass, fields, replace

import numpy as np

from . import checks
from .arithmetic import library, promoted, within_range


@dataclass(frozen=True, eq=False)
class Duffing:
    """The Duffing oscillator with power-law damping; all quantities dimensionless, symbols as in the paper.

    Parameters
    ----------
    alpha : damping coefficient, >= 0
    p : damping exponent, > 0 (1: linear; p -> 0: dry friction)
    mu : forcing amplitude
    omega : forcing frequency, > 0
    delta, gamma : linear and cubic stiffness; delta < 0 < gamma makes the double well

    Any field may be an array: the fields broadcast, and the oscillator is then a *family* of `shape`.
    For the formulas (not the integrators) a field may also be an mpmath or a sympy number.

    Raises
    ------
    ValueError : naming the field, its value and what is allowed.
    """

    alpha: float | np.ndarray = 0.1
    p: float | np.ndarray = 1.0
    mu: float | np.ndarray = 0.0
    omega: float | np.ndarray = 1.0
    delta: float | np.ndarray = -1.0
    gamma: float | np.ndarray = 1.0

    def __post_init__(self):
        allowed = {
            "alpha": {"allowed": "a finite number >= 0", "lower": 0},
            "p": {"allowed": "a finite number > 0", "lower": 0, "strict": True},
            "omega": {"allowed": "a finite number > 0", "lower": 0, "strict": True},
        }
        checked = [checks.parameter(name, getattr(self, name), **allowed.get(name, {})) for name in FIELDS]
        # One mpmath or sympy field makes all of them so: no formula then meets a rounded float.
        vars(self).update(zip(FIELDS, promoted(*checked), strict=True))  # frozen for everybody else
        shapes = dict(zip(FIELDS, map(np.shape, self._values()), strict=True))
        try:
            family = self.shape
        except ValueError:
            raise ValueError(f"the fields' shapes {shapes} must broadcast to one family") from None
        if 0 in family:
            raise ValueError(f"the fields' shapes {shapes} make an empty family: at least one member is needed")

    def __eq__(self, other):
        if not isinstance(other, Duffing):
            return NotImplemented
        return all(np.array_equal(a, b) for a, b in zip(self._values(), other._values(), strict=True))

    def __hash__(self):
        return hash(tuple(v.tobytes() if isinstance(v, np.ndarray) else v for v in self._values()))

    def __setstate__(self, state):  # of a copy or a pickle: NumPy's copies of read-only arrays can be written to
        vars(self).update(state)
        self.__post_init__()

    @property
    def shape(self):
        """Shape of the family: () for a single oscillator."""
        return np.broadcast_shapes(*map(np.shape, self._values()))

    @property
    def period(self):
        """Forcing period 2 pi / omega (time)."""
        return 2 * library(self.omega).pi / self.omega

    def columns(self):
        """The six parameters of every member as float array (6, N), in the order of `FIELDS`.

        Raises ValueError for a symbol: only formulas take it.
        """
        full, shape = [], self.shape
        for name, value in zip(FIELDS, self._values(), strict=True):
            try:
                full.append(np.broadcast_to(np.asarray(value, dtype=float), shape).ravel())
            except TypeError:
                raise ValueError(f"{name} = {value}: must be a number where the equation is integrated") from None
        return np.array(full)

    def members(self, which=slice(None), **changed):
        """The members that an index or a mask over all N chooses, in a row: a family of shape (n,), or one oscillator.

        changed : fields of the result that are others, numbers or (n,) each
        """
        return replace(Duffing(*self.columns()[:, which]), **changed)

    def repeated(self, times):
        """Every member so many times one after the other: a family of shape (N times,)."""
        return Duffing(*np.repeat(self.columns(), times, axis=1))

    @classmethod
    def joined(cls, oscillators):
        """The members of several oscillators, one after the other, as one family of shape (N,)."""
        return cls(*np.concatenate([osc.columns() for osc in oscillators], axis=1))

    def named(self, member=0):
        """The parameters of one of the N members in words, for a message."""
        return ", ".join(f"{name} = {value:g}" for name, value in zip(FIELDS, self.columns()[:, member], strict=True))

    def potential(self, x):
        """V(x) of Eq. 2: delta x^2 / 2 + gamma x^4 / 4 (energy); x broadcasts against the family."""
        return self.delta * x**2 / 2 + self.gamma * x**4 / 4

    def force(self, x, t):
        """Potential force F_x of Eq. 2 and forcing: -delta x - gamma x^3 + mu cos(omega t)."""
        return -self.delta * x - self.gamma * x**3 + self.mu * library(t, self.omega).cos(self.omega * t)

    def damping(self, v):
        """dpt(v) of Eq. 3: alpha v |v|^(p-1), written alpha sign(v) |v|^p, which is finite at v = 0 for every p > 0."""
        return self.alpha * library(v, self.p).sign(v) * abs(v) ** self.p

    def acceleration(self, x, v, t):
        """Right-hand side of Eq. 5 for v: force less damping."""
        return self.force(x, t) - self.damping(v)

    def energy(self, x, v):
        """H0 of Eq. 4: v^2 / 2 + V(x)."""
        return v**2 / 2 + self.potential(x)

    def dimensionless(self):
        """The same motion with delta = -1, gamma = 1: x = sqrt(-delta/gamma) X, t = tau / sqrt(-delta).

        Raises ValueError unless delta < 0 < gamma, DivergedError where a field leaves the range of doubles.
        """
        checks.double_well(self)
        alpha, mu, omega = dimensionless_fields(self)
        return Duffing(alpha=alpha, p=self.p, mu=mu, omega=omega)

    def units(self):
        """Units (3, *family) of length, velocity and forcing for which delta = -1, gamma = 1; ValueError as above."""
        checks.double_well(self)
        stiffness, cubic = (np.broadcast_to(value, self.shape) for value in (-self.delta, self.gamma))
        return np.array([np.sqrt(stiffness / cubic), stiffness / np.sqrt(cubic), stiffness**1.5 / np.sqrt(cubic)])

    def _values(self):
        return tuple(getattr(self, name) for name in FIELDS)


FIELDS = tuple(field.name for field in fields(Duffing))


@within_range
def dimensionless_fields(osc):
    """alpha, mu and omega of the same motion in the units in which delta = -1 and gamma = 1."""
    stiffness = -osc.delta
    return (
        osc.alpha * stiffness ** (osc.p - 1.5) * osc.gamma ** ((1 - osc.p) / 2),
        osc.mu * osc.gamma**0.5 * stiffness**-1.5,
        osc.omega * stiffness**-0.5,
    )
