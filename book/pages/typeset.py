"""Numbers as a journal prints them: a true minus, powers of ten, a thin space before the per cent sign.

One function for all: prose (Sphinx calls it for every glued number, see `book/sphinx/typeset_numbers.py`) and tables.
"""

import re

MINUS, THIN, TIMES = "\u2212", "\u202f", "\u00d7"
_SUPERSCRIPT = str.maketrans("-0123456789", "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079")
_POWER = re.compile(r"(?<![\w.])([+-]?)(\d+(?:\.\d+)?)e([+-]?)0*(\d+)\b")
_SIGN = re.compile(r"(?<![\w\u2070-\u209f)\]-])-(?=\.?\d)")
_PERCENT = re.compile(r"(\d)\s*%")


def typeset(text):
    """The text with its numbers typeset: "-1.4e-03" gets a true minus and a power of ten, "29%" a thin space.

    A hyphen within a word or between two numbers stays, and so does all that is no number.
    """
    text = _POWER.sub(_power, text)
    return _PERCENT.sub(rf"\1{THIN}%", _SIGN.sub(MINUS, text))


def _power(match):
    sign, mantissa, minus, exponent = match.groups()
    if exponent == "0" or not exponent:
        return sign + mantissa
    ten = f"10{(minus.strip('+') + exponent).translate(_SUPERSCRIPT)}"
    return f"{sign}{ten}" if float(mantissa) == 1 and "." not in mantissa else f"{sign}{mantissa} {TIMES} {ten}"


def times(count):
    """How often, in words where English has them: "never", "once", "twice", "3 times"."""
    return {0: "never", 1: "once", 2: "twice"}.get(count, f"{count} times")
