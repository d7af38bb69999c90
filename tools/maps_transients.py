"""Writes _build/maps/*.svg: the figures of the chapter on the contradiction from many more starts and finer grids.

Finished blocks of orbits are kept in _build/maps/blocks: an interrupted run goes on where it was. (The crises alone are
found anew: each step of their bisection depends on the one before.) A start that ends on an orbit of more than six
forcing periods, as a few do at p = 1 and mu = 0.08, counts as wandering and makes the mean lifetime too long there.
"""

from pathlib import Path

import numpy as np

from book.figures import contradiction as figures_transients
from book.studies import comparison as comparison_study
from book.studies import transients as transient_study
from duffing import critical_amplitude, paper
from duffing.oscillator import Duffing
from duffing.transients.survival import exponential, law_test, survival

MAPS = Path(__file__).parents[1] / "_build" / "maps"
KEPT = str(MAPS / "blocks")
SINCE = transient_study.SINCE


def write(name, figure):
    """Write one figure and say where."""
    MAPS.mkdir(parents=True, exist_ok=True)
    (MAPS / f"{name}.svg").write_bytes(figure.image("svg"))
    print(f"Written: {MAPS / name}.svg", flush=True)


def survival_curves():
    """Sixteen thousand starts at each of four forcings."""
    curves = {}
    for mu in (0.25, 0.26, 0.264, 0.2663):
        time, settled, _ = transient_study.sample(mu, columns=160, rows=100, periods=2000, checkpoint=KEPT)
        fit = exponential(time, settled, SINCE)
        chance = law_test(time, settled, SINCE, until=2000)[1]
        print(f"mu = {mu}: mean lifetime {fit.mean:.1f} +- {fit.error:.1f}, probability of the law {chance:.2f}")
        curves[rf"$\mu = {mu:g}$"] = (*survival(time, settled), SINCE, fit.mean)
    write("survival", figures_transients.survival_curves(curves, transient_study.sample_of_the_paper()[0]))


def lifetimes_and_rates():
    """A grid of 0.001 in mu from just above mu_c on, 2000 starts at each."""
    folds, _ = transient_study.folds()
    ends = {p: k for k, p in enumerate(transient_study.P_CRISIS)}
    crises = transient_study.crises(points=2000, steps=8)
    grid = {0.1: np.arange(0.146, 0.2901, 0.001), 1.0: np.arange(0.076, 0.2801, 0.001)}
    options = {"periods": 3000, "checkpoint": KEPT}
    found = {p: transient_study.escape(np.round(mu, 4), p, 50, 40, **options) for p, mu in grid.items()}
    lines = [{p: values[ends[p]] for p in grid} for values in (folds, crises)]
    means = {p: (one.mu, one.mean, one.error) for p, one in found.items()}
    bounds = {p: (one.mu, one.bound) for p, one in found.items()}
    write("mean_lifetimes", figures_transients.mean_lifetimes(means, *lines, bounds))
    rates = {p: (one.mu, one.small, one.large) for p, one in found.items()}
    write("capture_rates", figures_transients.capture_rates(rates, *lines))
    p = np.array(transient_study.P_CRISIS)
    critical = critical_amplitude(Duffing(alpha=paper.OSCILLATOR.alpha, p=p))
    write("order_of_events", figures_transients.order_of_events(p, critical, folds, crises))


def exponents():
    """Four times the starts of the book in each direction."""
    curves = {}
    for p, (columns, rows) in comparison_study.GRID.items():
        mu, ratio, w = comparison_study.compared(p, columns=4 * columns, rows=4 * rows, checkpoint=KEPT)
        curves[p] = (mu, ratio, w.dissipated, w.spread, w.exponent, w.error, w.share > 0.5)
    write("exponents_compared", figures_transients.exponents_compared(curves))
    strong = np.round(np.arange(0.30, 1.501, 0.01), 3)
    shares = {
        p: (strong, comparison_study.chaotic_starts(strong, p, checkpoint=KEPT).share) for p in comparison_study.P
    }
    write("strong_forcing", figures_transients.strong_forcing(shares))


survival_curves()
lifetimes_and_rates()
exponents()
