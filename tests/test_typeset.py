"""Numbers as a journal prints them, in prose and tables."""

import pytest

from book.pages.typeset import times, typeset
from book.pages.values import values


@pytest.mark.parametrize(
    ("typed", "printed"),
    [
        ("1.36e-03", "1.36 × 10⁻³"),
        ("-1.4e-12", "−1.4 × 10⁻¹²"),
        ("1e-08", "10⁻⁸"),
        ("2.5e+05", "2.5 × 10⁵"),
        ("3.0e+00", "3.0"),
        ("-0.0016", "−0.0016"),
        ("(-0.5, -1)", "(−0.5, −1)"),
        ("0.1-0.2", "0.1-0.2"),
        ("2026-11-28", "2026-11-28"),
        ("half-period", "half-period"),
        ("x-1", "x-1"),
        ("5.5%", "5.5\u202f%"),
        ("10.9 %", "10.9\u202f%"),
        ("0.151 ± 0.011", "0.151 ± 0.011"),
        ("fig-3b", "fig-3b"),
        ("a1e-3b", "a1e-3b"),
    ],
)
def test_a_number_is_typeset_and_nothing_else(typed, printed):
    assert typeset(typed) == printed


def test_what_is_typeset_already_stays():
    for text in ("−1.4 × 10⁻¹²", "29\u202f%", "10⁻⁸"):
        assert typeset(text) == text


def test_how_often_is_said_in_words():
    assert [times(n) for n in range(4)] == ["never", "once", "twice", "3 times"]


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), [1.0], None, {"a": 1}])
def test_prose_takes_numbers_words_and_tables_alone(bad):
    with pytest.raises(ValueError, match=r"^onset = "):
        values(onset=bad)
