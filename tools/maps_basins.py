"""Writes _build/maps/basins-*.png: the basins of attraction at full resolution, 512 x 512 starts or as many as asked.

python tools/maps_basins.py [starts a side]; p = 1 is some seconds a picture, p = 0.1 about a minute. Each is kept
block by block in _build/maps/blocks: an interrupted run goes on where it was.
"""

import sys
import time
from pathlib import Path

from book.figures import basins as figures_basins
from book.studies import basins as basin_study
from duffing import paper
from duffing.basins.basins import KINDS

SIZE = int(sys.argv[1]) if len(sys.argv) > 1 else 512
FOLDER = Path(__file__).parents[1] / "_build" / "maps"
PICTURES = [
    *((paper.P_LINEAR, {"ratio": ratio}) for ratio in (0.9, 1.1, 2.0, 3.0)),
    *((paper.P_SMALL, {"ratio": ratio}) for ratio in (0.9, 1.1)),
    *((paper.P_SMALL, {"mu": mu}) for mu in (paper.MU_REGULAR, paper.MU_CHAOTIC)),
]

FOLDER.mkdir(parents=True, exist_ok=True)
for p, forcing in PICTURES:
    begin = time.perf_counter()
    found = basin_study.picture(p, **forcing, size=SIZE, progress=True, checkpoint=str(FOLDER / "blocks"))
    (name, value), points = *forcing.items(), [one.points for one in found.attractors if one.period]
    title = rf"$p = {p:g}$, $\mu = {value:g}$" + (r"$\,\mu_c$" if name == "ratio" else "")
    case = (title, found.x, found.v, found.kinds[found.labels], points, [])
    path = FOLDER / f"basins-p{p:g}-{name}{value:g}-{SIZE}.png"
    path.write_bytes(figures_basins.basin_pictures([case], KINDS, columns=1).image("png"))
    shares = ", ".join(f"{one.name} {share:.2%}" for one, share in zip(found.attractors, found.shares, strict=False))
    print(f"{path}: {shares}, unresolved {found.shares[-1]:.3%} ({time.perf_counter() - begin:.0f} s)", flush=True)
