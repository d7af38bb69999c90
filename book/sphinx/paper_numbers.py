"""Equations and figures carry the paper's own numbers, read from their labels.

The label `eq-13` shows as (13) and `fig-4a` as Fig. 4a, wherever they stand; what the paper does not number is E1, E2,
... in reading order. A number used twice, missing, or unknown to the paper is a warning, which fails the build.
Sphinx counts in reading order and would shift every number after an insertion; a reader looks for the paper's.
"""

import re
from collections import Counter

from sphinx.util import logging

LABELS = {"displaymath": re.compile(r"equation-eq-(\d+)"), "figure": re.compile(r"fig-(\d+[a-z]?)")}
NAMES = {"displaymath": "equation", "figure": "figure"}
logger = logging.getLogger(__name__)


def number_from_labels(env):
    """Replace Sphinx's counts by the numbers in the labels; the extra ones get E1, E2, ... Returns Counters of both."""
    used = {kind: Counter() for kind in LABELS}
    for numbers_of in env.toc_fignumbers.values():
        for kind, pattern in LABELS.items():
            for label in numbers_of.get(kind, {}):
                match = pattern.fullmatch(label)
                number = match[1] if match else f"E{1 + sum(n.startswith('E') for n in used[kind].elements())}"
                used[kind][number] += 1
                numbers_of[kind][label] = (number,)
    return used


def complaints(kind, used, expected):
    """What is wrong with the numbers used, one sentence each. A figure without a letter stands for all its panels."""
    known = set(expected) | {re.match(r"\d+", number)[0] for number in expected}
    for number, times in used.items():
        if times > 1:
            yield f"{kind} {number} of the paper is numbered {times} times"
        if number not in known and not number.startswith("E"):
            yield f"{kind} {number} does not exist in the paper"
    for number in expected:
        whole = re.match(r"\d+", number)[0]
        if number not in used and whole not in used:
            yield f"{kind} {number} of the paper is missing"
        if number != whole and number in used and whole in used:
            yield f"{kind} {whole} and its panel {number} are both numbered"


def use_paper_numbers(app, env):
    used = number_from_labels(env)
    expected = {
        "displaymath": [str(n + 1) for n in range(app.config.paper_equations)],
        "figure": app.config.paper_figures,
    }
    for kind, name in NAMES.items():
        for complaint in complaints(name, used[kind], expected[kind]):
            logger.warning(complaint, type="paper_numbers", subtype=name)
    return list(env.toc_fignumbers)


def setup(app):
    app.add_config_value("paper_equations", 0, "env")
    app.add_config_value("paper_figures", [], "env")
    # After Sphinx's own numbering (priority 500).
    app.connect("env-get-updated", use_paper_numbers, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
