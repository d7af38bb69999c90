"""Writes docs/headline.svg, the picture in the README: the first figure of the book, computed anew."""

from pathlib import Path

import numpy as np

from duffing import Duffing, critical_amplitude, homoclinic_tangency
from duffing.book import figures_beyond, reproduction
from duffing.book.findings_exponents import P_ONSET

p, touching = np.linspace(0.02, 3.1, 300), np.array([0.5, 0.75, 1.0, 1.5, 2.0, 3.0])
figure = figures_beyond.headline(
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
