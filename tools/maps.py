"""The planes of lambda_1 of the chapter "The whole plane" at full resolution, 400 x 400: `make maps`.

Each plane is kept block by block in _build/maps/blocks: an interrupted run goes on where it was.
"""

from dataclasses import replace
from pathlib import Path

from book.figures import maps as figures_maps
from book.studies import maps
from duffing import paper

FOLDER = Path("_build/maps")
PLANES = {
    "p-mu": ("p", 0.1, 3.0, paper.OSCILLATOR, "damping exponent $p$"),
    "omega-mu-p0.1": ("omega", 0.4, 2.0, paper.OSCILLATOR, r"forcing frequency $\omega$ (dimensionless)"),
    "omega-mu-p1": ("omega", 0.4, 2.0, replace(paper.OSCILLATOR, p=1.0), r"forcing frequency $\omega$ (dimensionless)"),
}


def main(pixels=400):
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, (field, first, last, osc, label) in PLANES.items():
        print(f"{name}: {pixels} x {pixels}")
        plane = maps.exponent_plane(
            field, first, last, pixels, osc=osc, progress=True, checkpoint=str(FOLDER / "blocks")
        )
        lines = maps.thresholds(field, first, last, crosses=25, osc=osc)
        fig = figures_maps.exponent_plane(*plane, *lines, label)
        (FOLDER / f"{name}.png").write_bytes(fig.image("png"))
        print(f"wrote {FOLDER / name}.png")


if __name__ == "__main__":
    main()
