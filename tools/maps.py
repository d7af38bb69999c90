"""The book's pictures from far more numbers than a book may take: `make maps`, or `make maps WHAT="basins window"`.

    planes      lambda_1 over the planes of the chapter on maps (chapters/maps.md), 400 x 400
    basins      basins of attraction, 512 x 512 starts: seconds a picture at p = 1, about a minute at p = 0.1
    transients  the figures of transients, the window and the exponents compared, from more starts and finer grids
    wedge       the figures of the chapter "Where chaos lasts", on finer grids and for every pair
    candidates  the likelihood of alpha and omega in steps of 0.005 and 0.00625, with a list of the likeliest
    window      the window of chaos at p = 0.1 from 200 starts
    headline    the picture in the README, docs/headline.svg: the first figure of the book

All but the last go to _build/maps. What sweeps have finished is kept block by block in _build/maps/blocks: an
interrupted run goes on where it was.
"""

import sys
from dataclasses import replace
from pathlib import Path

import maps_plane
import numpy as np

from book.figures import basins as basin_figures
from book.figures import exponents_compared, index, small_p, window_ends
from book.figures import maps as plane_figures
from book.figures import missing_parameters as candidate_figures
from book.figures import transients as transient_figures
from book.paper import LIKELY
from book.studies import basins, comparison, inference, maps, missing_parameters, reproduction, transients
from book.studies import small_p as small_p_study
from book.studies.survival import exponential, law_test, survival
from duffing import Duffing, critical_amplitude, homoclinic_tangency, paper
from duffing.basins.basins import KINDS

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "_build" / "maps"
KEPT = {"checkpoint": str(FOLDER / "blocks"), "progress": True}
PLANES = {
    "p-mu": ("p", 0.1, 3.0, paper.OSCILLATOR, "damping exponent $p$"),
    "omega-mu-p0.1": ("omega", 0.4, 2.0, paper.OSCILLATOR, r"forcing frequency $\omega$ (dimensionless)"),
    "omega-mu-p1": ("omega", 0.4, 2.0, replace(paper.OSCILLATOR, p=1.0), r"forcing frequency $\omega$ (dimensionless)"),
}
BASINS = [
    *((paper.P_LINEAR, {"ratio": ratio}) for ratio in (0.9, 1.1, 2.0, 3.0)),
    *((paper.P_SMALL, {"ratio": ratio}) for ratio in (0.9, 1.1)),
    *((paper.P_SMALL, {"mu": mu}) for mu in (paper.MU_REGULAR, paper.MU_CHAOTIC)),
]


def write(figure, path):
    """Write one figure and say where."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(figure.image(path.suffix[1:]))
    print(f"Written: {path}", flush=True)


def planes(pixels=400):
    for name, (field, first, last, osc, label) in PLANES.items():
        plane = maps.exponent_plane(field, first, last, pixels, osc=osc, **KEPT)
        lines = maps.thresholds(field, first, last, crosses=25, osc=osc)
        write(plane_figures.exponent_plane(*plane, *lines, label), FOLDER / f"{name}.png")


def basin_pictures(size=512):
    for p, forcing in BASINS:
        found = basins.picture(p, **forcing, size=size, **KEPT)
        (name, value), points = *forcing.items(), [one.points for one in found.attractors if one.period]
        title = rf"$p = {p:g}$, $\mu = {value:g}$" + (r"$\,\mu_c$" if name == "ratio" else "")
        case = (title, found.x, found.v, found.kinds[found.labels], points, [])
        figure = basin_figures.basin_pictures([case], KINDS, columns=1)
        write(figure, FOLDER / f"basins-p{p:g}-{name}{value:g}-{size}.png")
        shares = ", ".join(
            f"{one.name} {share:.2%}" for one, share in zip(found.attractors, found.shares, strict=False)
        )
        print(f"{shares}, unresolved {found.shares[-1]:.3%}")


def survival_curves():
    """Sixteen thousand starts at each of four forcings."""
    curves, since = {}, transients.SINCE
    for mu in (0.25, 0.26, 0.264, 0.2663):
        time, settled, _ = transients.sample(mu, columns=160, rows=100, periods=2000, **KEPT)
        fit = exponential(time, settled, since)
        chance = law_test(time, settled, since, until=2000)[1]
        print(f"mu = {mu}: mean lifetime {fit.mean:.1f} +- {fit.error:.1f}, probability of the law {chance:.2f}")
        curves[rf"$\mu = {mu:g}$"] = (*survival(time, settled), since, fit.mean)
    figure = transient_figures.survival_curves(curves, transients.sample_of_the_paper()[0])
    write(figure, FOLDER / "survival.svg")


def lifetimes_and_rates():
    """A grid of 0.001 in mu from just above mu_c on, 2000 starts at each.

    The crises are found anew each time: each step of their bisection depends on the one before. A start that ends on an
    orbit of more than six forcing periods, as a few do at p = 1 and mu = 0.08, counts as wandering and makes the mean
    lifetime too long there.
    """
    (folds, _), crises = transients.folds(), transients.crises(points=2000, steps=8)
    grid = {0.1: np.arange(0.146, 0.2901, 0.001), 1.0: np.arange(0.076, 0.2801, 0.001)}
    found = {p: transients.escape(np.round(mu, 4), p, 50, 40, periods=3000, **KEPT) for p, mu in grid.items()}
    lines = [{p: values[transients.P_CRISIS.index(p)] for p in grid} for values in (folds, crises)]
    means = {p: (one.mu, one.mean, one.error) for p, one in found.items()}
    bounds = {p: (one.mu, one.bound) for p, one in found.items()}
    write(transient_figures.mean_lifetimes(means, *lines, bounds), FOLDER / "mean_lifetimes.svg")
    rates = {p: (one.mu, one.small, one.large) for p, one in found.items()}
    write(transient_figures.capture_rates(rates, *lines), FOLDER / "capture_rates.svg")
    p = np.array(transients.P_CRISIS)
    critical = critical_amplitude(replace(paper.OSCILLATOR, p=p))
    write(window_ends.order_of_events(p, critical, folds, crises), FOLDER / "order_of_events.svg")


def exponents():
    """Four times the starts of the book in each direction."""
    curves = {}
    for p, (columns, rows) in comparison.GRID.items():
        mu, ratio, w = comparison.compared(p, columns=4 * columns, rows=4 * rows, **KEPT)
        curves[p] = (mu, ratio, w.dissipated, w.spread, w.exponent, w.error, w.share > 0.5)
    write(exponents_compared.exponents_compared(curves), FOLDER / "exponents_compared.svg")
    strong = np.round(np.arange(0.30, 1.501, 0.01), 3)
    shares = {p: (strong, comparison.chaotic_starts(strong, p, **KEPT).share) for p in comparison.P}
    write(exponents_compared.strong_forcing(shares), FOLDER / "strong_forcing.svg")


def candidates(alpha_step=0.005, omega_step=0.00625):
    plane = missing_parameters.plane(alpha_step, omega_step, **KEPT)
    logs = inference.log_likelihood(plane.evidence)
    total, best = inference.marginal(logs), inference.best_reading(logs)
    share = np.exp(total - total.max()) / np.exp(total - total.max()).sum()
    for k in np.argsort(-total)[:12]:
        pair = f"alpha = {plane.evidence.alpha[k]:g}, omega = {plane.evidence.omega[k]:g}"
        reading = f"in {best[k][0]} from t = {(0, 1200)[best[k][1]]}"
        print(f"{pair}: log likelihood {total[k]:.2f}, {share[k]:.1%} of all, {reading}")
    panels = {"all statements": (missing_parameters.laid_out(plane, total) - total.max()) / np.log(10)}
    rings = {pair.letter: (pair.alpha, pair.omega) for pair in LIKELY}
    figure = candidate_figures.likelihood_maps(plane.alpha, plane.omega, plane.exponent, panels, rings)
    write(figure, FOLDER / "candidates.png")


def window():
    mu, found = small_p_study.window(columns=20, rows=10)
    mu_paper, paper_exponents = reproduction.exponent_curve(paper.P_SMALL)
    inside = (mu_paper >= mu[0]) & (mu_paper <= mu[-1])
    write(small_p.many_starts(mu, found, mu_paper[inside], paper_exponents[inside]), FOLDER / "window.svg")
    for value, part in zip(mu, np.mean(found > 0.05, axis=0), strict=True):
        print(f"mu = {value:.3f}: {part:4.0%} of {len(found)} starts chaotic over 199 periods")


def headline():
    p, touching = np.linspace(0.02, 3.1, 300), np.array([0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0])
    tangency, onset = homoclinic_tangency(Duffing(p=touching)), reproduction.onsets(paper.P_ONSET)
    figure = index.headline(p, critical_amplitude(Duffing(p=p)), touching, tangency, np.array(paper.P_ONSET), onset)
    write(figure, ROOT / "docs" / "headline.svg")


MAPS = {
    "planes": (planes,),
    "basins": (basin_pictures,),
    "transients": (survival_curves, lifetimes_and_rates, exponents),
    "wedge": (maps_plane.apexes, maps_plane.pairs, maps_plane.regions),
    "candidates": (candidates,),
    "window": (window,),
    "headline": (headline,),
}

if __name__ == "__main__":
    names = sys.argv[1:] or ["planes", "basins", "transients", "candidates", "wedge"]
    if unknown := [name for name in names if name not in MAPS]:
        sys.exit(f"{' '.join(unknown)}: must be among {', '.join(MAPS)}")
    for name in names:
        for draw in MAPS[name]:
            draw()
