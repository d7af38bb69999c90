"""How probable the text of the paper is under each candidate alpha and omega, and what follows for the candidates.

A statement is an observation that the authors report. Its probability under a candidate is the share of the ensemble
for which it is true; a judgement ("good agreement") has a stated probability of being made. Every constant of these
models stands in `Models`, and the chapter varies them.
"""

from typing import NamedTuple

import numpy as np
from scipy.special import logsumexp, ndtr

from duffing import paper

UNITS = {"nats": 1.0, "bits": 1 / np.log(2)}  # Wolf et al. (1985) print exponents to base 2


class Models(NamedTuple):
    """kernel : width of the normal kernel round each exponent of the ensemble, in the unit of the exponents: half of
        their scatter, and Silverman's width for 24 of them; it also stands for details of the algorithm
    misprint : probability that a printed exponent comes from another average than the two read here, or from a slip;
        it then lies anywhere within `WIDTH`
    error : probability that what a whole figure shows, and the text describes, is not there
    judgement : probability that a judgement is made although nothing speaks for it
    weak : probability of small positive exponents near mu = 0 where the tangent vector gives none: the distance of two
        trajectories, which the paper may have used and does not give, decides their sign
    onset : standard deviation of "mu = 0.27" as a reading off Fig. 4a: half of a unit in the last digit
    agreement : standard deviation of the logarithm of onset / mu_c within which one speaks of good agreement
    larger : standard error of the difference of two largest exponents
    smaller : ratio of amplitudes that every second author would call "much smaller"
    range : interval of mu above the onset over which a transition to chaos is looked for
    jumps : least number of crossings of x = 0 before t = 1200 in "jumping between potential wells"
    """

    kernel: float = 0.006
    misprint: float = 0.05
    error: float = 0.002
    judgement: float = 0.1
    weak: float = 0.3
    onset: float = 0.005
    agreement: float = float(np.log(1.5))
    larger: float = 0.015
    smaller: float = 0.5
    range: float = 0.05
    jumps: int = 3


NUMBERS = ("lambda-027", "lambda-025")
JUDGEMENTS = ("much-smaller", "agreement", "larger-lambda", "sign-change")
STATED = Models()
WIDTH = 0.6  # interval of exponents over which a misprinted one is thought to lie


def probabilities(evidence, unit="nats", average=0, models=STATED):
    """Probability of each statement of `book.paper.STATEMENTS` for m candidates: dict key -> (m,).

    For the two printed exponents it is a density, per unit of the exponent. unit : of the paper's exponents, a key of
    `UNITS`; average : 0 from t = 0, 1 from t = 1200
    """
    scale, curves = UNITS[unit], evidence.curves
    small, linear = curves[paper.P_SMALL], curves[paper.P_LINEAR]
    share = {p: _chaotic(curve, scale) for p, curve in curves.items()}
    onset = {p: _onset(curves[p].mu, share[p]) for p in curves}
    below = small.mu < paper.MU_REGULAR - 1e-9
    ratio = np.array([onset[p] / evidence.critical[p] for p in curves])  # nan where no onset was found, and no circle
    above, found = np.all(~(ratio < 1), axis=0), np.isfinite(ratio)
    distance = np.sum(np.where(found, np.log(ratio) ** 2, 0.0), axis=0) / np.maximum(found.sum(axis=0), 1)
    distance = np.where(found.any(axis=0), distance, np.inf)
    weak = scale * small.exponent[small.mu < 0.045].mean(axis=1)
    breadth = [_breadth(curves[p].mu, share[p], onset[p], models.range) for p in (paper.P_SMALL, paper.P_LINEAR)]
    figures = {
        "no-chaos-below": np.prod(1 - share[paper.P_SMALL][below], axis=0),
        "onset-027": at_onset(small.mu, share[paper.P_SMALL], models.onset),
        "weak-positive": np.any((weak > 0) & (weak < paper.THRESHOLD), axis=0).astype(float),
        "above-line": above.astype(float),
        "agreement": np.exp(-distance / (2 * models.agreement**2)),
        "larger-lambda": ndtr(scale * (_largest(small) - _largest(linear)) / models.larger),
        "sign-change": np.mean(breadth, axis=0),
    }
    return quoted(evidence.chaotic, evidence.regular, unit, average, models) | _floored(figures, models)


def quoted(chaotic, regular, unit="nats", average=0, models=STATED):
    """Of `probabilities` those that the motions at mu = 0.27 and 0.25 decide: Runs (n, m) -> dict key -> (m,)."""
    scale = UNITS[unit]
    late = regular.amplitude[1] / regular.amplitude[0]
    jumps = (regular.crossings[0] >= models.jumps) & (regular.crossings[1] == 0)
    motions = {
        "lambda-027": _density(paper.LAMBDA_CHAOTIC, scale * chaotic.exponent[average], models.kernel),
        "lambda-025": _density(paper.LAMBDA_REGULAR, scale * regular.exponent[average], models.kernel),
        "not-periodic": np.mean(chaotic.aperiodic > 0.01, axis=0),
        "transient": np.mean(jumps, axis=0),
        "much-smaller": np.mean(1 / (1 + (late / models.smaller) ** 4), axis=0),
    }
    return _floored(motions, models)


def ceiling(chaotic, regular, models=STATED):
    """What the log likelihood of each candidate can reach at most, were all other statements certain: (m,)."""
    readings = [(unit, average) for unit in UNITS for average in (0, 1)]
    logs = [sum(map(np.log, quoted(chaotic, regular, *reading, models).values())) for reading in readings]
    return marginal(np.array(logs))


def _floored(probability, models):
    """No statement is impossible: each is made in error, or without a reason, with its probability in `models`."""
    floor = {key: models.error for key in probability}
    floor |= dict.fromkeys(NUMBERS, models.misprint) | dict.fromkeys(JUDGEMENTS, models.judgement)
    floor["weak-positive"] = models.weak
    elsewhere = dict.fromkeys(NUMBERS, 1 / WIDTH)  # the density of a misprinted exponent
    return {key: floor[key] * elsewhere.get(key, 1.0) + (1 - floor[key]) * p for key, p in probability.items()}


def _density(printed, exponents, kernel):
    return np.mean(np.exp(-(((printed - exponents) / kernel) ** 2) / 2), axis=0) / (kernel * np.sqrt(2 * np.pi))


def _chaotic(curve, scale):
    """Share of the starts with lambda_1 above the threshold in a motion that is not "very small": (k, m)."""
    return np.mean((scale * curve.exponent > paper.THRESHOLD) & curve.moving, axis=1)


def _onset(mu, share):
    """The least mu at which at least half of the starts are chaotic, nan where there is none: (m,)."""
    found = share >= 0.5
    return np.where(found.any(axis=0), mu[found.argmax(axis=0)], np.nan)


def at_onset(mu, share, width):
    """Mean of a normal kernel about 0.27 over where chaos first appears above 0.25: mu (k,), share (k, m) -> (m,)."""
    near = (mu > paper.MU_REGULAR + 1e-9) & (mu < paper.MU_CHAOTIC + 1e-9)
    probability, nothing_yet = 0.0, 1.0
    for value, chance in zip(mu[near], share[near], strict=True):
        weight = np.exp(-(((value - paper.MU_CHAOTIC) / width) ** 2) / 2)
        probability, nothing_yet = probability + nothing_yet * chance * weight, nothing_yet * (1 - chance)
    return probability


def _largest(curve):
    return np.max(np.mean(np.where(curve.moving, curve.exponent, 0.0), axis=1), axis=0)


def _breadth(mu, share, onset, reach):
    """Share of chaos from the onset over the range above it: (m,), 0 without an onset."""
    inside = (mu[:, None] > onset - 1e-9) & (mu[:, None] < onset + reach + 1e-9)
    return np.sum(share * inside, axis=0) / np.maximum(inside.sum(axis=0), 1)


def log_likelihood(evidence, models=STATED, without=(), units=UNITS, averages=(0, 1)):
    """Log likelihood of each reading of the exponents: (len(units), len(averages), m), without some statements."""
    return np.array(
        [
            [
                sum(
                    np.log(p) for key, p in probabilities(evidence, unit, average, models).items() if key not in without
                )
                for average in averages
            ]
            for unit in units
        ]
    )


def marginal(log_likelihoods):
    """Mean likelihood over the readings, each as probable as any other before: log, (m,)."""
    readings = np.reshape(log_likelihoods, (-1, np.shape(log_likelihoods)[-1]))
    return logsumexp(readings, axis=0) - np.log(len(readings))


def readings(log_likelihoods):
    """Probability of each unit (rows) and average (columns) after the text, over all candidates: (2, 2), sums to 1."""
    return np.exp(logsumexp(log_likelihoods, axis=2) - logsumexp(log_likelihoods))


def best_reading(log_likelihoods):
    """For each candidate the unit and the average under which the text is likeliest: list of (unit, 0 or 1)."""
    _, averages, size = np.shape(log_likelihoods)
    best = np.argmax(np.reshape(log_likelihoods, (-1, size)), axis=0)
    return [(list(UNITS)[k // averages], int(k % averages)) for k in best]


# What the models leave open, varied one at a time.
VARIATIONS = {
    "as stated": {},
    "kernel 0.003": {"kernel": 0.003},
    "kernel 0.012": {"kernel": 0.012},
    "misprint 0.01": {"misprint": 0.01},
    "misprint 0.2": {"misprint": 0.2},
    "error 0.02": {"error": 0.02},
    "error 0.0002": {"error": 0.0002},
    "judgement 0.03": {"judgement": 0.03},
    "judgement 0.3": {"judgement": 0.3},
    "onset 0.0025": {"onset": 0.0025},
    "onset 0.01": {"onset": 0.01},
    "agreement within 20 %": {"agreement": float(np.log(1.2))},
    "agreement within a factor 2": {"agreement": float(np.log(2.0))},
    "larger 0.03": {"larger": 0.03},
    "much smaller: 0.3": {"smaller": 0.3},
    "range 0.1": {"range": 0.1},
    "at least 8 changes of well": {"jumps": 8},
}


def posterior(log_likelihoods, plane, lattice, weight):
    """Probability of each followed candidate of a lattice of round numbers, and of each of the plane: (m,), (n,).

    The authors used a pair of the lattice with probability `weight`, else any of the plane, each as probable as any
    other there; candidates that were not followed have likelihood zero. log_likelihoods : of lattice and plane
    """
    priors = (weight / lattice.exponent.size, (1 - weight) / plane.exponent.size)
    masses = [prior * np.exp(logs) for prior, logs in zip(priors, log_likelihoods, strict=True)]
    total = sum(mass.sum() for mass in masses)
    return tuple(mass / total for mass in masses)


def index(evidence, pair):
    """Which of the candidates the pair is. Raises ValueError where it is none of them."""
    (found,) = np.nonzero(np.isclose(evidence.alpha, pair.alpha) & np.isclose(evidence.omega, pair.omega))
    if found.size != 1:
        raise ValueError(f"pair = {pair.alpha, pair.omega}: must be one of the candidates that were followed")
    return int(found[0])
