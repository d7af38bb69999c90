"""Writes _build/maps/missing-parameters.png and prints the likeliest pairs: the plane of candidates in finer steps.

python tools/maps_missing_parameters.py [step of alpha, step of omega]; 0.005 and 0.00625 take minutes on two cores.
Runs are kept block by block in _build/maps/blocks: an interrupted run goes on where it was.
"""

import sys
from pathlib import Path

import numpy as np

from book.figures import missing_parameters as figures
from book.studies import inference
from book.studies import missing_parameters as study
from duffing import paper

FOLDER = Path(__file__).parents[1] / "_build" / "maps"
SHOWN = 12  # pairs of the list


def main(alpha_step=0.005, omega_step=0.00625):
    plane = study.plane(alpha_step, omega_step, progress=True, checkpoint=str(FOLDER / "blocks"))
    logs = inference.log_likelihood(plane.evidence)
    total = inference.marginal(logs)
    best = inference.best_reading(logs)
    mass = np.exp(total - total.max()) / np.exp(total - total.max()).sum()
    for k in np.argsort(-total)[:SHOWN]:
        unit, average = best[k]
        print(
            f"alpha = {plane.evidence.alpha[k]:g}, omega = {plane.evidence.omega[k]:g}: log likelihood {total[k]:.2f}, "
            f"probability {mass[k]:.1%}, in {unit} from t = {(0, 1200)[average]}"
        )
    for unit, row in zip(inference.UNITS, inference.readings(logs), strict=True):
        print(f"{unit}: {row[0]:.1%} from t = 0, {row[1]:.1%} from t = 1200")
    panels = {"all statements": (study.laid_out(plane, total) - total.max()) / np.log(10)}
    rings = {pair.letter: (pair.alpha, pair.omega) for pair in paper.LIKELY}
    figure = figures.likelihood_maps(plane.alpha, plane.omega, plane.exponent, panels, rings)
    path = FOLDER / "missing-parameters.png"
    path.write_bytes(figure.image("png"))
    print(f"Written: {path}")


if __name__ == "__main__":
    main(*map(float, sys.argv[1:3]))
