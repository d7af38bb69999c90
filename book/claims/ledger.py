"""The ledger: every claim of the paper set against a computation, with a verdict that the computation decides."""

from typing import NamedTuple

import numpy as np

from ..pages import tables
from ..paper import LIKELY
from ..remember import remembered
from ..studies import inference, likely_pairs, missing_parameters
from . import contradiction as findings_contradiction
from . import exponents as findings_exponents
from . import motion as findings_motion
from . import theory as findings_theory
from .dependence import INDEPENDENT, USED, kind
from .text import CLAIMS, Claim
from .verdicts import VERDICTS, Finding

FINDINGS = {
    **findings_theory.FINDINGS,
    **findings_exponents.FINDINGS,
    **findings_motion.FINDINGS,
    **findings_contradiction.FINDINGS,
}


class Row(NamedTuple):
    """A claim of the paper and what was found."""

    claim: Claim
    finding: Finding


def rows(*keys):
    """Rows of the claims with these keys, in the paper's order; of all claims without keys. Computes the findings.

    Raises ValueError naming a key that no claim has.
    """
    known = [claim.key for claim in CLAIMS]
    for key in keys:
        if key not in known:
            raise ValueError(f"key = {key!r}: must be one of {', '.join(known)}")
    return [Row(claim, FINDINGS[claim.key]()) for claim in CLAIMS if not keys or claim.key in keys]


def table(*keys):
    """The rows as a Markdown table to be glued into a page; all of them without keys."""
    head = ("The paper says", "Kind", "We find", "Verdict", "Used to choose α, ω", "Depends on α, ω")
    found = rows(*keys)
    chance = over_pairs() if any(claim.key in USED for claim, _ in found) else {}
    cells = [
        (f"{c.where}: {c.says}", kind(c.key), f.text, f"**{f.verdict}**", *_pairs(c.key, chance)) for c, f in found
    ]
    return tables.table(head, cells)


def _pairs(key, chance):
    """The two last cells of a row."""
    if key in INDEPENDENT:
        return "no", "no"
    if key not in USED:
        part = " (by the order of the onsets alone)" if key == "contradiction" else ""
        return "no", f"yes; {under_rivals(key)}{part}"
    return "yes: circular", "; ".join(f"{letter}: {p:.2g}" for letter, p in chance[key].items())


def under_rivals(key):
    """What becomes of the verdict under the other likely pairs, in words: a claim that was not used to choose a pair."""
    adopted = FINDINGS[key]().verdict
    found = {pair.letter: FINDINGS[key](likely_pairs.oscillator(pair)).verdict for pair in LIKELY[1:]}
    if set(found.values()) == {adopted}:
        return f"the same under {' and '.join(found)}"
    return "; ".join(f"{letter}: {verdict}" for letter, verdict in found.items())


@remembered
def over_pairs():
    """dict: key of a claim that was used to choose alpha and omega -> dict: letter of a likely pair -> probability.

    That of what the paper says, under the pair, in the reading of the exponents that suits the pair best; of a printed
    exponent the probability of one within 0.01 of it. Claims used by several statements: the product.
    """
    alpha, omega = ([getattr(pair, name) for pair in LIKELY] for name in ("alpha", "omega"))
    evidence = missing_parameters.evidence(alpha, omega)
    reading = inference.best_reading(inference.log_likelihood(evidence))
    found = [inference.probabilities(evidence, *each) for each in reading]
    chance = {}
    for claim, statements in USED.items():
        width = 0.02 if statements[0] in inference.NUMBERS else 1.0  # a density over the interval
        chance[claim] = {
            pair.letter: min(1.0, width * float(np.prod([each[key][k] for key in statements])))
            for k, (pair, each) in enumerate(zip(LIKELY, found, strict=True))
        }
    return chance


def verdicts(*keys):
    """A line for each of these claims, to end a chapter with: what the paper says and the verdict; reasons: the ledger."""
    found = [(claim.says, f"[**{finding.verdict}**](ledger.md)") for claim, finding in rows(*keys)]
    return tables.table(("The paper says", "Verdict"), found)


def independent(found):
    """The rows whose verdict depends on nothing that was chosen, and those whose confirmation is circular: two lists."""
    return [row for row in found if row.claim.key in INDEPENDENT], [row for row in found if row.claim.key in USED]


def tally(found):
    """Number of rows with each verdict: dict in the order of VERDICTS."""
    return {verdict: sum(row.finding.verdict == verdict for row in found) for verdict in VERDICTS}
