"""One hash for each thing the integrators return: run before and after a change that should not change a bit.

    python tools/kernel_hash.py > before.txt          and, after the change,
    python tools/kernel_hash.py | diff before.txt -   says which results are no longer the same to the last bit

Families over p and mu, with 0, 1 and 2 tangents, forward and backward, creeping and not, met at common and at own
times; turning points with their derivatives. Hashes are comparable on one machine only: creeps use the C library's
pow, exp and log.
"""

import hashlib

import numpy as np

from duffing import Duffing
from duffing.errors import DuffingError
from duffing.integrators import rk4
from duffing.integrators.companion import two_trajectory_growth
from duffing.integrators.friction_time import adaptive
from duffing.integrators.friction_time.turning_points import to_turning_point

EXPONENTS = (0.05, 0.1, 0.3, 0.5, 0.75, 1.0, 1.3, 2.0, 3.0)
MU = np.append(np.linspace(0.0, 0.3, 37), [0.05, 0.1, 0.12])  # more than a block; below alpha a mass can creep
START = (0.45, 0.1)


def digest(arrays):
    """Twelve hexadecimal digits of the arrays' bytes and shapes; None counts as itself."""
    found = hashlib.sha256()
    for array in arrays:
        found.update(repr(None if array is None else (array.shape, array.dtype.str)).encode())
        found.update(b"" if array is None else np.ascontiguousarray(array).tobytes())
    return found.hexdigest()[:12]


def report(name, compute, arguments, **options):
    """Print the name with the hash of each field of what compute(*arguments) returns, or the error that it raises."""
    try:
        found = compute(*arguments, **options)
    except DuffingError as error:
        print(f"{name}: {type(error).__name__} {error}", flush=True)
        return
    fields = found._asdict() if hasattr(found, "_asdict") else {"result": found}
    for field, array in fields.items():
        if array is not None:
            print(f"{name}, {field}: {digest([array])}", flush=True)


def main():
    for p in EXPONENTS:
        osc = Duffing(p=p, mu=MU)
        t = osc.period * np.array([0.0, 0.3, 1.0, 1.7, 3.0])
        own = t[:, None] * np.linspace(1.0, 1.1, MU.size)
        for tangents in range(3):
            for name, integrate in (("rk4", rk4.integrate), ("adaptive", adaptive.integrate)):
                report(f"{name}, p = {p}, {tangents} tangents", integrate, (osc, START, t, tangents))
            report(
                f"adaptive, p = {p}, {tangents} tangents, own times",
                adaptive.integrate,
                (osc, START, own, tangents),
            )
            report(f"rk4, p = {p}, {tangents} tangents, own times", rk4.integrate, (osc, START, own, tangents))
            few = Duffing(p=p, mu=np.linspace(0.15, 0.3, 11))
            report(
                f"adaptive, p = {p}, {tangents} tangents, backward",
                adaptive.integrate,
                (few, START, -t[:3] / 4, tangents),
            )
            report(
                f"adaptive, p = {p}, {tangents} tangents, loose",
                adaptive.integrate,
                (osc, START, t, tangents),
                rtol=1e-5,
                atol=1e-7,
            )
        report(f"companion, p = {p}", two_trajectory_growth, (osc, START, 2))
        for direction in (1, -1):
            starts = np.array([np.linspace(0.1, 1.2, 21), np.linspace(-0.4, 0.5, 21)])
            one = Duffing(p=p, mu=0.27)
            for derivatives in (False, True):
                report(
                    f"turning points, p = {p}, direction {direction}, derivatives {derivatives}",
                    to_turning_point,
                    (one, starts, 0.2, direction),
                    derivatives=derivatives,
                )
            report(
                f"turning points beyond, p = {p}, direction {direction}",
                to_turning_point,
                (one, starts, 0.2, direction),
                beyond=0.3,
            )
    mixed = Duffing(
        p=np.array(EXPONENTS * 5), mu=np.linspace(0.0, 0.3, 45), alpha=np.tile([0.0, 0.05, 0.1, 0.3, 0.2], 9)
    )
    t = 2 * np.pi * np.arange(6) / 2
    for tangents in range(3):
        report(f"adaptive, mixed, {tangents} tangents", adaptive.integrate, (mixed, START, t, tangents))
    softer = Duffing(p=np.array([0.5, 1.0, 2.0]), mu=0.2, delta=0.5, gamma=0.0)
    report("adaptive, linear spring", adaptive.integrate, (softer, START, t, 2))
    at_rest = Duffing(p=np.array([0.3, 1.0, 2.0]), mu=0.0)
    for name, integrate in (("rk4", rk4.integrate), ("adaptive", adaptive.integrate)):
        report(f"{name}, at rest", integrate, (at_rest, (1.0, 0.0), t, 2))


if __name__ == "__main__":
    main()
