"""`python -m proof [p ...]` finds the proofs anew and writes the certificates; `--first` those for all smaller mu.

It ends with a line a theorem. The decimals are the bounds themselves, not rounded.
"""

import json
import sys
from concurrent.futures import ProcessPoolExecutor

from tqdm import tqdm

from duffing import Duffing, critical_amplitude

from .check import CERTIFICATES, check, load
from .first import check_first, prove_first
from .oscillator import Oscillator, exact
from .rational import decimal
from .theorems import prove

WORKERS = 2


def write(name, certificate):
    """Write a certificate as JSON with one piece a line."""
    text = json.dumps(certificate, separators=(",", ":"))
    text = text.replace("],[", "],\n[").replace(":[[", ":[\n[") + "\n"
    (CERTIFICATES / f"{name}.json").write_text(text, encoding="utf-8")


def statement(certificate):
    """The theorem of a certificate in one line."""
    low, high, least = check(certificate)
    p = certificate["oscillator"]["p"]
    return f"p = {p}: {decimal(low, 16)} < mu_t < {decimal(high, 16)}; x_s - x_u > {float(least):.1e} at the lower end"


def find(p):
    """Prove everything about the exponent p but what `find_first` does."""
    guess = exact("mu", f"{float(critical_amplitude(Duffing(p=float(p)))):.12f}")
    with ProcessPoolExecutor(WORKERS) as pool, tqdm(desc=f"p = {p}", unit=" pieces") as bar:
        certificate = prove(Oscillator(p), guess, lambda task, todo: pool.map(task, todo, chunksize=4), bar.update)
    write(f"p{p}", certificate)
    return statement(certificate)


def find_first(p):
    """Prove that there is no primary intersection for any mu up to mu_low; an interrupted run goes on."""
    certificate, path = load(f"p{p}"), CERTIFICATES / f"first{p}.json"
    records = load(f"first{p}") if path.exists() else []
    with ProcessPoolExecutor(WORKERS) as pool, tqdm(desc=f"first, p = {p}", unit=" intervals") as bar:
        for found in prove_first(certificate, pool.map, records):
            records = sorted([*records, *found], key=lambda record: float(exact("mu", record[0])))
            write(f"first{p}", records)
            bar.update(len(found))
    top, _ = check_first(certificate, records)
    return f"p = {p}: no primary intersection for 0 < mu <= {decimal(top, 16)}"


def main(arguments):
    """The command."""
    task = find_first if "--first" in arguments else find
    exponents = [int(p) for p in arguments if p != "--first"] or [1, 3]
    print(*[task(p) for p in exponents], sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
