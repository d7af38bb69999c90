"""The Duffing oscillator with power-law (fractional-exponent) damping. See the README and the book."""

from .errors import ConvergenceError, DivergedError, DuffingError, NoSaddleOrbitError
from .melnikov import critical_amplitude, homoclinic_orbit, melnikov_function
from .oscillator import Duffing

__all__ = [
    "ConvergenceError",
    "DivergedError",
    "Duffing",
    "DuffingError",
    "NoSaddleOrbitError",
    "critical_amplitude",
    "homoclinic_orbit",
    "melnikov_function",
]
