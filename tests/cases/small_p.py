"""Cases of the figures of the exponents at small p: made-up arrays, as `case` says."""

import numpy as np

from book.figures import small_p as figures

from .case import Case, to_roundoff

P = np.array([0.1, 0.5, 1.0, 2.0])

MU = np.linspace(0.0, 0.5, 51)


def _exponents():
    return {"mu": MU, "coarse": 0.2 * np.sin(9 * MU) - 0.1, "mu_exact": MU[5:40], "exact": 0.1 - MU[5:40]}


def _starts():
    exponents = np.array([0.1 - MU, 0.05 * np.cos(20 * MU), MU - 0.3])
    return {"mu": MU, "exponents": exponents, "paper": 0.15 * np.sin(12 * MU)}


def _limit():
    return {"p": P, "mu": np.array([0.1, 0.2, 0.3, 0.4]), "exponents": np.subtract.outer(P / 10, [0.02, 0.1, 0.2, 0.5])}


CASES = {
    "resolved_exponents": Case(
        _exponents,
        lambda d: figures.resolved_exponents(d["mu"], d["coarse"], d["mu_exact"], d["exact"], 0.1),
        to_roundoff,
    ),
    "many_starts": Case(
        _starts, lambda d: figures.many_starts(d["mu"], d["exponents"], d["mu"], d["paper"]), to_roundoff
    ),
    "dry_limit": Case(_limit, lambda d: figures.dry_limit(d["p"], d["exponents"], d["mu"]), to_roundoff),
}
