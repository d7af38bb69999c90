"""The Duffing oscillator with power-law (fractional-exponent) damping. See the README and the book."""

from .errors import ConvergenceError, DivergedError, DuffingError, LostWorkerError, NoSaddleOrbitError
from .flow import trajectory
from .lyapunov import LyapunovSpectrum, lyapunov_spectrum, two_trajectory_exponent
from .manifolds.saddle import SaddleOrbit, saddle_orbit
from .manifolds.tangency import homoclinic_tangency, splitting
from .melnikov import critical_amplitude, homoclinic_orbit, melnikov_function
from .oscillator import Duffing
from .poincare import poincare_section

__all__ = [
    "ConvergenceError",
    "DivergedError",
    "Duffing",
    "DuffingError",
    "LostWorkerError",
    "LyapunovSpectrum",
    "NoSaddleOrbitError",
    "SaddleOrbit",
    "critical_amplitude",
    "homoclinic_orbit",
    "homoclinic_tangency",
    "lyapunov_spectrum",
    "melnikov_function",
    "poincare_section",
    "saddle_orbit",
    "splitting",
    "trajectory",
    "two_trajectory_exponent",
]
