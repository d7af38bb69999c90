"""`python -m proof [p ...]` finds the proofs anew and writes the certificates; `--first` those for all smaller mu.

It ends with a line a theorem. The decimals are the bounds themselves, not rounded.
"""

import json
import sys
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from functools import partial
from math import floor, pi

from scipy.optimize import brentq, minimize_scalar
from tqdm import tqdm

from duffing import Duffing, homoclinic_tangency, splitting

from .check import CERTIFICATES, check, load
from .first import check_first, intervals, prove_interval
from .oscillator import Oscillator
from .rational import decimal, rounded
from .theorems import prove

WORKERS = 2
SHARE = 4.8e-9  # (mu_t - mu_low) / mu_t, and the same above
DIGITS = 12  # of mu_low and mu_high, so that they do not depend on the last bits of the package's tangency


def write(name, certificate):
    """Write a certificate as JSON with one piece a line."""
    text = json.dumps(certificate, separators=(",", ":"))
    text = text.replace("],[", "],\n[").replace(":[[", ":[\n[") + "\n"
    (CERTIFICATES / f"{name}.json").write_text(text, encoding="utf-8")


def statement(certificate):
    """The theorem of a certificate in one line."""
    low, high, least = check(certificate)
    p, (low, high) = certificate["oscillator"]["p"], (decimal(end, DIGITS) for end in (low, high))
    return f"p = {p}: {low} < mu_t < {high}; x_s - x_u > {rounded(least, floor):.1e} at the lower end"


def find(p):
    """Prove everything about the exponent p but what `find_first` does."""
    near = homoclinic_tangency(Duffing(p=float(p)))
    low, high = (Fraction(round(near * (1 + share) * 10**DIGITS), 10**DIGITS) for share in (-SHARE, SHARE))
    with ProcessPoolExecutor(WORKERS) as pool, tqdm(desc=f"p = {p}", unit=" pieces") as bar:
        each = partial(pool.map, chunksize=4)
        certificate = prove(Oscillator(p), low, high, crossing_phase(p, high), each, bar.update)
    found = statement(certificate)  # checked before it is written
    write(f"p{p}", certificate)
    return found


def crossing_phase(p, mu):
    """A phase at which the manifolds cross, from the package: it tells the proof where to look, and proves nothing."""

    def apart(phase):
        return -float(splitting(Duffing(p=float(p), mu=float(mu)), phase))

    nearest = minimize_scalar(apart, bounds=(pi / 4, 3 * pi / 4), method="bounded", options={"xatol": 1e-7}).x
    return round(brentq(apart, nearest, nearest + 0.1), 8)


def find_first(p):
    """Prove that there is no primary intersection for any mu up to mu_low."""
    certificate = load(f"p{p}")
    tasks = [(Oscillator(p), *ends) for ends in intervals(Fraction(certificate["low"]))]
    with ProcessPoolExecutor(WORKERS) as pool:
        found = pool.map(prove_interval, tasks)
        records = list(tqdm(found, desc=f"first, p = {p}", total=len(tasks), unit=" intervals"))
    check_first(certificate, records)
    write(f"first{p}", records)
    return f"p = {p}: no primary intersection for 0 < mu <= {decimal(Fraction(certificate['low']), DIGITS)}"


def main(arguments):
    """The command."""
    task = find_first if "--first" in arguments else find
    exponents = [int(p) for p in arguments if p != "--first"] or [1, 2, 3]
    print(*[task(p) for p in exponents], sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
