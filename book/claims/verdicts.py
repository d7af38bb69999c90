"""What a finding is: a verdict decided by a computation, and the numbers in a sentence."""

from functools import cache
from typing import NamedTuple

CONFIRMED, LIMITED, NOT_CONFIRMED, NOT_REPRODUCED, RESOLVED, NOT_CHECKABLE = VERDICTS = (
    "confirmed",
    "confirmed with limits",
    "not confirmed",
    "not reproduced",
    "resolved",
    "not checkable",
)


class Finding(NamedTuple):
    """verdict : one of VERDICTS; text : what was computed, as Markdown"""

    verdict: str
    text: str


def finds(findings, key):
    """Register a function without arguments as the finding on the claim `key`; it is computed once a process."""

    def register(function):
        if key in findings:
            raise ValueError(f"key = {key!r}: has a finding already")
        findings[key] = cache(function)
        return findings[key]

    return register


def decide(holds, text, *, limited=False, otherwise=NOT_CONFIRMED):
    """A Finding: confirmed (with limits if `limited`) when the computation holds, else `otherwise`."""
    return Finding((LIMITED if limited else CONFIRMED) if holds else otherwise, text)
