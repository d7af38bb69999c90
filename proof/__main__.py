"""`python -m proof [p ...]`: finds every proof anew, writes the certificates, and says each theorem in one line."""

import json
import sys
from concurrent.futures import ProcessPoolExecutor

from tqdm import tqdm

from duffing import Duffing, critical_amplitude

from .check import CERTIFICATES, check
from .oscillator import Oscillator, exact


def lines(certificate):
    """JSON with one piece a line."""
    text = json.dumps(certificate, separators=(",", ":"))
    return text.replace(",[[", ",\n[[").replace("],[", "],\n[").replace('\n["', '["') + "\n"


def main(exponents):
    """Prove and write; the workers are two processes."""
    from .theorems import prove

    said = []
    for p in exponents:
        osc = Oscillator(p)
        guess = exact("mu", f"{float(critical_amplitude(Duffing(p=float(p)))):.12f}")
        with ProcessPoolExecutor(2) as pool, tqdm(desc=f"p = {p}", unit=" pieces") as bar:
            certificate = prove(osc, guess, lambda task, todo: pool.map(task, todo, chunksize=4), bar.update)
        (CERTIFICATES / f"p{p}.json").write_text(lines(certificate))
        low, high, least = check(certificate)
        said.append(f"p = {p}: {float(low):.16f} < mu_t < {float(high):.16f}, gap {float(least):.1e}")
    print(*said, sep="\n")


if __name__ == "__main__":
    main([int(p) for p in sys.argv[1:]] or [1, 3])
