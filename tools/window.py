"""Writes _build/window.svg: the window of chaos at p = 0.1 from 200 starts, the book's figure from more of them."""

from pathlib import Path

import numpy as np

from book.figures import small_p as figures_small_p
from book.studies import reproduction, small_p
from duffing import paper

mu, exponents = small_p.window(columns=20, rows=10)
mu_paper, paper_exponents = reproduction.exponent_curve(paper.P_SMALL)
inside = (mu_paper >= mu[0]) & (mu_paper <= mu[-1])
figure = figures_small_p.many_starts(mu, exponents, mu_paper[inside], paper_exponents[inside])
path = Path(__file__).parents[1] / "_build" / "window.svg"
path.parent.mkdir(exist_ok=True)
path.write_bytes(figure.image("svg"))
share = np.mean(exponents > 0.05, axis=0)
for value, part in zip(mu, share, strict=True):
    print(f"mu = {value:.3f}: {part:4.0%} of {len(exponents)} starts chaotic over 199 periods")
print(f"Written: {path}")
