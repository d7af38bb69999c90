"""What the package raises when a valid question has no computable answer.

Invalid input is a ValueError (see `checks`); these are for valid input whose answer does not exist or
was not reached. None of them is replaced by a NaN unless the caller asks for it (`failures`).
"""


class DuffingError(Exception):
    """Base of the package's own exceptions."""


class DivergedError(DuffingError):
    """A solution left every bound (possible for gamma <= 0) or a step became NaN."""


class NoSaddleOrbitError(DuffingError):
    """No hyperbolic saddle orbit exists near x = 0, or it sticks and the stroboscopic map is not invertible there."""


class ConvergenceError(DuffingError):
    """An iteration or an adaptive integration did not reach its tolerance within its bound on work."""


class LostWorkerError(DuffingError):
    """A block of a sweep ended its worker process each time that it was tried, or no worker was left to try it."""
