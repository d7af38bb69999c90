"""The Duffing oscillator with power-law (fractional-exponent) damping. See the README and the book.

The core, these modules and `duffing.integrators`, stands on nothing else of the package; what it offers of the room of
manifolds is imported when it is asked for.
"""

from importlib import import_module

from .errors import ConvergenceError, DivergedError, DuffingError, LostWorkerError, NoSaddleOrbitError
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

_OF_MANIFOLDS = {
    "SaddleOrbit": "saddle",
    "homoclinic_tangency": "tangency",
    "saddle_orbit": "saddle",
    "splitting": "tangency",
}


def __getattr__(name):
    if name not in _OF_MANIFOLDS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".manifolds.{_OF_MANIFOLDS[name]}", __name__), name)


def __dir__():
    return sorted({*globals(), *__all__})
