"""The ledger: every claim of `paper` set against a computation, with a verdict that the computation decides."""

from typing import NamedTuple

from duffing import paper

from ..pages import tables
from . import contradiction as findings_contradiction
from . import exponents as findings_exponents
from . import motion as findings_motion
from . import theory as findings_theory
from .verdicts import VERDICTS, Finding

FINDINGS = {
    **findings_theory.FINDINGS,
    **findings_exponents.FINDINGS,
    **findings_motion.FINDINGS,
    **findings_contradiction.FINDINGS,
}


class Row(NamedTuple):
    """A claim of the paper and what was found."""

    claim: paper.Claim
    finding: Finding


def rows(*keys):
    """Rows of the claims with these keys, in the paper's order; of all claims without keys. Computes the findings.

    Raises ValueError naming a key that no claim has.
    """
    known = [claim.key for claim in paper.CLAIMS]
    for key in keys:
        if key not in known:
            raise ValueError(f"key = {key!r}: must be one of {', '.join(known)}")
    return [Row(claim, FINDINGS[claim.key]()) for claim in paper.CLAIMS if not keys or claim.key in keys]


def table(*keys):
    """The rows as a Markdown table to be glued into a page; all of them without keys."""
    head = ("Where", "The paper says", "We find", "Verdict")
    found = rows(*keys)
    return tables.table(head, [(c.where, c.says, f.text, f"**{f.verdict}**") for c, f in found])


def tally(found):
    """Number of rows with each verdict: dict in the order of VERDICTS."""
    return {verdict: sum(row.finding.verdict == verdict for row in found) for verdict in VERDICTS}
