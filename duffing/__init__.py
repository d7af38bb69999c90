"""The Duffing oscillator with power-law (fractional-exponent) damping. See the README and the book."""

from .errors import ConvergenceError, DivergedError, DuffingError, NoSaddleOrbitError
from .flow import trajectory
from .lyapunov import LyapunovSpectrum, lyapunov_spectrum, two_trajectory_exponent
from .melnikov import critical_amplitude, homoclinic_orbit, melnikov_function
from .oscillator import Duffing
from .poincare import poincare_section

__all__ = [
    "ConvergenceError",
    "DivergedError",
    "Duffing",
    "DuffingError",
    "LyapunovSpectrum",
    "NoSaddleOrbitError",
    "critical_amplitude",
    "homoclinic_orbit",
    "lyapunov_spectrum",
    "melnikov_function",
    "poincare_section",
    "trajectory",
    "two_trajectory_exponent",
]
