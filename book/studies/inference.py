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
AVERAGES = ("from t = 0", "from t = 1200")


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
WIDTH = 0.6  # interval of exponents over which a misprinted one is thought to lie


def probabilities(evidence, unit="nats", average=0, models=Models()):
    """Probability of each statement of `paper.STATEMENTS` for m candidates: dict key -> (m,).

    For the two printed exponents it is a density, per unit of the exponent. unit : of the paper's exponents, a key of
    `UNITS`; average : 0 from t = 0, 1 from t = 1200
    """
    scale = UNITS[unit]
    chaotic, regular, curves = evidence.chaotic, evidence.regular, evidence.curves
    small, linear = curves[paper.P_SMALL], curves[paper.P_LINEAR]
    share = {p: _chaotic(curve, scale) for p, curve in curves.items()}
    onset = {p: _onset(curves[p].mu, share[p]) for p in curves}
    below = small.mu < paper.MU_REGULAR - 1e-9
    ratio = np.array([onset[p] / evidence.critical[p] for p in curves])
    with np.errstate(invalid="ignore"):
        above, distance = np.all(~(ratio < 1), axis=0), np.nanmean(np.log(ratio) ** 2, axis=0)
    late = regular.amplitude[1] / regular.amplitude[0]
    jumps = (regular.crossings[0] >= models.jumps) & (regular.crossings[1] == 0)
    difference = scale * (_largest(small) - _largest(linear))
    weak = scale * small.exponent[small.mu < 0.045].mean(axis=1)
    observed = {
        "lambda-027": _density(paper.LAMBDA_CHAOTIC, scale * chaotic.exponent[average], models.kernel),
        "lambda-025": _density(paper.LAMBDA_REGULAR, scale * regular.exponent[average], models.kernel),
        "no-chaos-below": np.prod(1 - share[paper.P_SMALL][below], axis=0),
        "onset-027": _at_onset(small.mu, share[paper.P_SMALL], models.onset),
        "not-periodic": np.mean(chaotic.aperiodic > 0.01, axis=0),
        "transient": np.mean(jumps, axis=0),
        "weak-positive": np.any((weak > 0) & (weak < paper.THRESHOLD), axis=0).astype(float),
        "above-line": above.astype(float),
    }
    judged = {
        "much-smaller": np.mean(1 / (1 + (late / models.smaller) ** 4), axis=0),
        "agreement": np.exp(-np.nan_to_num(distance, nan=np.inf) / (2 * models.agreement**2)),
        "larger-lambda": ndtr(difference / models.larger),
        "sign-change": np.mean([_breadth(curves[p].mu, share[p], onset[p], models.range) for p in (0.1, 1.0)], axis=0),
    }
    floor = dict.fromkeys(observed, models.error) | {"weak-positive": models.weak}
    floor |= dict.fromkeys(NUMBERS, models.misprint) | dict.fromkeys(judged, models.judgement)
    elsewhere = dict.fromkeys(NUMBERS, 1 / WIDTH)  # the density of a misprinted exponent
    return {
        key: floor[key] * elsewhere.get(key, 1.0) + (1 - floor[key]) * value
        for key, value in (observed | judged).items()
    }


def _density(printed, exponents, kernel):
    return np.mean(np.exp(-(((printed - exponents) / kernel) ** 2) / 2), axis=0) / (kernel * np.sqrt(2 * np.pi))


def _chaotic(curve, scale):
    """Share of the starts with lambda_1 above the threshold in a motion that is not "very small": (k, m)."""
    return np.mean((scale * curve.exponent > paper.THRESHOLD) & curve.moving, axis=1)


def _onset(mu, share):
    """The least mu at which at least half of the starts are chaotic, nan where there is none: (m,)."""
    found = share >= 0.5
    return np.where(found.any(axis=0), mu[found.argmax(axis=0)], np.nan)


def _at_onset(mu, share, width):
    """Mean of the kernel about 0.27 over where chaos first appears from 0.25 on: (m,)."""
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


def log_likelihood(evidence, models=Models(), without=(), units=UNITS, averages=(0, 1)):
    """Log likelihood of each reading of the exponents: (len(units), len(averages), m), without some statements."""
    return np.array([
        [
            sum(np.log(p) for key, p in probabilities(evidence, unit, average, models).items() if key not in without)
            for average in averages
        ]
        for unit in units
    ])  # fmt: skip


def marginal(log_likelihoods):
    """Mean likelihood over the readings, each as probable as any other before: log, (m,)."""
    readings = np.reshape(log_likelihoods, (-1, np.shape(log_likelihoods)[-1]))
    return logsumexp(readings, axis=0) - np.log(len(readings))


def round_prior(alpha, omega, alpha_step, omega_step):
    """Probability of each candidate when round numbers are likelier: (m,), sums to 1.

    alpha is a multiple of 0.1, of 0.01 or any number, omega of 1, of 0.1 or any number, each with probability 1/3;
    multiples are equally probable among themselves. A candidate stands for the cell of the plane round it.
    """
    weight = np.ones(np.shape(alpha))
    for values, step, coarse, fine in ((alpha, alpha_step, 0.1, 0.01), (omega, omega_step, 1.0, 0.1)):
        axis = np.unique(np.round(values, 6))
        first, last = axis[0] - step / 2, axis[-1] + step / 2
        mass = np.full(axis.size, step / (last - first) / 3)
        for multiple in (coarse, fine):
            numbers = multiple * np.arange(np.ceil(first / multiple), np.floor(last / multiple) + 1)
            for number in numbers:
                mass[np.argmin(np.abs(axis - number))] += 1 / 3 / numbers.size
        weight = weight * mass[np.searchsorted(axis, np.round(values, 6))]
    return weight / weight.sum()


def posterior(log_likelihoods, prior=None):
    """Probability of each candidate after the text: (m,), sums to 1; prior : (m,), flat unless given."""
    logs = log_likelihoods + (0.0 if prior is None else np.log(prior))
    return np.exp(logs - logsumexp(logs))
