"""The paper's claims and the verdicts on them: each decided by a computation, each stated here by hand."""

import pytest

from book.claims import ledger
from book.claims.dependence import INDEPENDENT, OBSERVED, USED, kind
from book.claims.text import CLAIMS
from book.claims.verdicts import (
    CONFIRMED,
    LIMITED,
    NOT_CHECKABLE,
    NOT_CONFIRMED,
    NOT_REPRODUCED,
    RESOLVED,
    VERDICTS,
    Finding,
    decide,
    finds,
)
from book.paper import LIKELY, STATEMENTS

EXPECTED = {
    CONFIRMED: "eq-1-5 eq-2 saddle eq-4-7 eq-8 eq-8-limits fig-2 eq-10-11 eq-13 eq-14-15 sufficient above-line "
    "false-positive small-amplitude just-after fig-5a fig-5b-transient fig-5b-steady t-1200 mu-c2 transients algorithm",
    LIMITED: "dry-friction eq-9 eq-12 necessary monotone can-transit sign-change robust-onset threshold lambda-027 "
    "lambda-025 resonance larger-lambda",
    NOT_CONFIRMED: "eq-8-sides agreement",
    NOT_REPRODUCED: "smaller-steps",
    RESOLVED: "contradiction",
    NOT_CHECKABLE: "dampers",
}


def test_what_was_used_to_choose_alpha_and_omega_is_said_of_each_claim():
    keys, statements = {claim.key for claim in CLAIMS}, {s.key for s in STATEMENTS}
    assert USED.keys() | INDEPENDENT | OBSERVED <= keys
    assert not USED.keys() & INDEPENDENT
    assert {s for each in USED.values() for s in each} == statements
    assert {kind(key) for key in keys} == {"equation", "observation", "inference"}


def test_confirmations_that_depend_on_nothing_chosen_are_the_equations():
    independent, circular = ledger.independent(ledger.rows())
    assert {kind(row.claim.key) for row in independent if row.finding.verdict == CONFIRMED} == {"equation"}
    assert len(circular) == len(USED)


def test_the_probability_of_each_used_claim_is_given_for_each_likely_pair():
    chance = ledger.over_pairs()
    assert chance.keys() == USED.keys()
    assert all(each.keys() == {pair.letter for pair in LIKELY} for each in chance.values())
    assert all(0 < p <= 1 for each in chance.values() for p in each.values())
    assert chance["agreement"]["A"] < chance["agreement"]["B"]  # nearer to the line under the likelier pair


def test_verdicts_that_depend_on_the_pair_are_the_same_under_the_rivals_but_for_one():
    """Smaller steps cure the false positives at B, as the paper says, and not at the adopted pair."""
    rest = {claim.key for claim in CLAIMS} - INDEPENDENT - USED.keys()
    words = {key: ledger.under_rivals(key) for key in rest}
    assert len(rest) > 10
    assert {key: each for key, each in words.items() if each != "the same under B and C"} == {
        "smaller-steps": f"B: {LIMITED}; C: {NOT_REPRODUCED}"
    }


def test_every_claim_has_a_finding_and_every_finding_a_claim():
    keys = [claim.key for claim in CLAIMS]
    assert len(set(keys)) == len(keys) > 25
    assert set(keys) == set(ledger.FINDINGS)


def test_every_verdict_is_what_the_book_says():
    found = {row.claim.key: row.finding.verdict for row in ledger.rows()}
    assert found == {key: verdict for verdict, keys in EXPECTED.items() for key in keys.split()}


def test_rows_come_in_the_papers_order_and_tables_have_a_line_each():
    rows = ledger.rows("saddle", "eq-2")
    assert [row.claim.key for row in rows] == ["eq-2", "saddle"]
    assert ledger.table("saddle", "eq-2").data.count("\n") == 3
    assert ledger.tally(rows) == {verdict: 2 * (verdict == CONFIRMED) for verdict in VERDICTS}


def test_an_unknown_claim_is_named():
    with pytest.raises(ValueError, match=r"^key = 'eq-99'"):
        ledger.rows("eq-99")


def test_a_verdict_follows_the_computation():
    assert decide(True, "t") == Finding(CONFIRMED, "t")
    assert decide(True, "t", limited=True) == Finding(LIMITED, "t")
    assert decide(False, "t", limited=True) == Finding(NOT_CONFIRMED, "t")
    assert decide(False, "t", otherwise=NOT_REPRODUCED) == Finding(NOT_REPRODUCED, "t")
    assert len(set(VERDICTS)) == 6


def test_a_claim_cannot_have_two_findings():
    findings = {}
    finds(findings, "key")(lambda: decide(True, ""))
    with pytest.raises(ValueError, match="has a finding already"):
        finds(findings, "key")(lambda: decide(True, ""))
