"""Writes docs/headline.svg, the picture in the README: the first figure of the book, computed anew."""

from pathlib import Path

import numpy as np

from book.claims.exponents import P_ONSET
from book.figures import index as figures_index
from book.studies import reproduction
from duffing import Duffing, critical_amplitude, homoclinic_tangency

p, touching = np.linspace(0.02, 3.1, 300), np.array([0.5, 0.75, 1.0, 1.5, 2.0, 3.0])
figure = figures_index.headline(
    p,
    critical_amplitude(Duffing(p=p)),
    touching,
    homoclinic_tangency(Duffing(p=touching)),
    np.array(P_ONSET),
    reproduction.onsets(P_ONSET),
)
path = Path(__file__).parents[1] / "docs" / "headline.svg"
path.parent.mkdir(exist_ok=True)
path.write_bytes(figure.image("svg"))
print(f"Written: {path}")
