"""The planes of the chapter "Where chaos lasts" on finer grids, for every pair and with more initial conditions.

Writes _build/maps/regions.png, apexes.png and pairs.png, each when it is done: `make maps WHAT=wedge`, hours.
"""

from pathlib import Path

import numpy as np

from book.figures import plane as figures
from book.studies import plane
from duffing import critical_amplitude
from duffing.oscillator import Duffing

FOLDER = Path("_build/maps")
GRID = {"omega": np.round(np.arange(0.9, 1.251, 0.0125), 5), "alpha": np.round(np.arange(0.05, 0.301, 0.01), 5)}
LINES = {
    "omega": tuple(np.round(np.arange(0.97, 1.241, 0.03), 5)),
    "alpha": tuple(np.round(np.arange(0.08, 0.301, 0.02), 5)),
}
FIXED = {"alpha": r"$\omega = 1$", "omega": r"$\alpha = 0.1$"}


def write(name, figure):
    """Write one figure and say where."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    (FOLDER / f"{name}.png").write_bytes(figure.image("png"))
    print(f"wrote {FOLDER / name}.png", flush=True)


def regions(step=0.005, columns=4, rows=2, periods=2000):
    """The wedge over omega and alpha at both exponents, and how brute force and the borders agree."""
    mu, panels = np.round(np.arange(0.05, 0.4501, step), 4), []
    for p in plane.EXPONENTS:
        for field, x in LINES.items():
            found = plane.borders(*((x, 1.0) if field == "alpha" else (0.1, x)), p, points=600, steps=6)
            across = plane.region(field, GRID[field], mu, p, columns=columns, rows=rows, periods=periods).across
            inside, filled = plane.agreement(GRID[field], mu, across, x, found)
            print(f"p = {p}, {field}: {inside:.1%} of the chaos between the borders, {filled:.1%} of that chaotic")
            title = f"$p = {p:g}$, {FIXED[field]}"
            panels.append((title, field, (GRID[field], mu), across, np.array(x), found._asdict()))
    write("regions", figures.regions(panels, {"alpha": 0.1, "omega": 1.0}))


def apexes():
    """The apex against alpha and p within 0.0003."""
    alpha, exponents = tuple(np.round(np.arange(0.05, 0.161, 0.01), 3)), (0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0)
    fine = {"halvings": 7, "points": 600}
    over_alpha = {p: (alpha, plane.apex(alpha, p, **fine)) for p in plane.EXPONENTS}
    over_p = (exponents, [float(plane.apex((0.1,), p, **fine)[0]) for p in exponents])
    write("apexes", figures.apexes(over_alpha, over_p, plane.PAIRS))


def pairs(step=0.002, columns=4, rows=2, periods=2000):
    """Lasting chaos under each pair up to mu = 0.4, and lambda_1 at the two exponents compared."""
    mu, shares = tuple(np.round(np.arange(0.1, 0.4001, step), 4)), {}
    sizes = {"columns": columns, "rows": rows, "periods": periods}
    for alpha, omega in plane.PAIRS:
        shares[alpha, omega] = {}
        for p in plane.EXPONENTS:
            one = plane.lasting(alpha, omega, p, mu, **sizes)
            critical = float(critical_amplitude(Duffing(alpha, p, 0.0, omega)))
            shares[alpha, omega][p] = (np.array(mu), one.across, one.inside, critical)
        print((alpha, omega), plane.compared((alpha, omega), mu, **sizes), flush=True)
    write("pairs", figures.pairs(shares))


if __name__ == "__main__":
    apexes()
    pairs()
    regions()
