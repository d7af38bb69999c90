"""The paper's claims and the verdicts on them: each decided by a computation, each stated here by hand."""

import pytest

from book.claims import ledger
from book.claims.verdicts import CONFIRMED, LIMITED, NOT_CHECKABLE, NOT_CONFIRMED, VERDICTS, Finding, decide, finds
from duffing import paper

EXPECTED = {
    CONFIRMED: "eq-1-5 eq-2 saddle eq-8 eq-8-limits fig-2 eq-13 eq-14-15 above-line false-positive small-amplitude "
    "just-after fig-5a fig-5b-transient fig-5b-steady t-1200 mu-c2 transients algorithm",
    LIMITED: "dry-friction eq-4-7 eq-9 eq-10-11 eq-12 sufficient necessary monotone can-transit sign-change "
    "smaller-steps robust-onset threshold lambda-027 lambda-025 resonance",
    NOT_CONFIRMED: "eq-8-sides agreement larger-lambda contradiction",
    NOT_CHECKABLE: "dampers",
}


def test_every_claim_has_a_finding_and_every_finding_a_claim():
    keys = [claim.key for claim in paper.CLAIMS]
    assert len(set(keys)) == len(keys) > 25
    assert set(keys) == set(ledger.FINDINGS)


def test_every_verdict_is_what_the_book_says():
    found = {row.claim.key: row.finding.verdict for row in ledger.rows()}
    assert found == {key: verdict for verdict, keys in EXPECTED.items() for key in keys.split()}


def test_rows_come_in_the_papers_order_and_tables_have_a_line_each():
    rows = ledger.rows("saddle", "eq-2")
    assert [row.claim.key for row in rows] == ["eq-2", "saddle"]
    assert ledger.table("saddle", "eq-2").data.count("\n") == 3
    assert ledger.tally(rows) == {CONFIRMED: 2, LIMITED: 0, NOT_CONFIRMED: 0, NOT_CHECKABLE: 0}


def test_an_unknown_claim_is_named():
    with pytest.raises(ValueError, match=r"^key = 'eq-99'"):
        ledger.rows("eq-99")


def test_a_verdict_follows_the_computation():
    assert decide(True, "t") == Finding(CONFIRMED, "t")
    assert decide(True, "t", limited=True) == Finding(LIMITED, "t")
    assert decide(False, "t", limited=True) == Finding(NOT_CONFIRMED, "t")
    assert len(VERDICTS) == 4


def test_a_claim_cannot_have_two_findings():
    findings = {}
    finds(findings, "key")(lambda: decide(True, ""))
    with pytest.raises(ValueError, match="has a finding already"):
        finds(findings, "key")(lambda: decide(True, ""))
