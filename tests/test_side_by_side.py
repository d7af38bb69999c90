"""The page that sets the paper's numbers beside the book's."""

import numpy as np

from book.claims.dependence import USED
from book.claims.text import CLAIMS
from book.studies import side_by_side
from duffing import paper


def test_each_row_belongs_to_a_claim_and_has_a_number():
    keys = {claim.key for claim in CLAIMS}
    for row in side_by_side.rows():
        assert row.claim in keys
        assert row.same is not None or row.exact is not None
        assert all(value is None or np.isfinite(value) for value in row[2:5])


def test_both_printed_exponents_stand_in_it_and_are_said_to_be_used():
    rows = {row.claim: row for row in side_by_side.rows()}
    assert {"lambda-027", "lambda-025"} <= rows.keys() & USED.keys()
    assert abs(rows["lambda-027"].exact - paper.LAMBDA_CHAOTIC) < 0.03
    assert rows["lambda-025"].exact < -0.1 < rows["lambda-025"].same  # the paper's step misses the contraction


def test_the_tangency_stands_within_some_per_cent_of_equation_13():
    for row in side_by_side.rows():
        if row.claim == "eq-13":
            assert abs(row.exact / row.same - 1) < 0.03
