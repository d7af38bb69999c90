"""The list of deliberate errors (tools/mutants.py) fits the code: each of them can be made, at one place."""

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
TOOL = runpy.run_path(ROOT / "tools" / "mutants.py")
MUTANTS = TOOL["MUTANTS"]


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: f"{mutant.module}: {mutant.what}")
def test_the_error_can_be_put_into_the_code_at_one_place(mutant):
    path = ROOT / f"{mutant.module.replace('.', '/')}.py"
    assert path.read_text(encoding="utf-8").count(mutant.good) == 1
    assert mutant.bad != mutant.good


def test_there_are_at_least_thirty_and_none_twice():
    assert len({(mutant.module, mutant.good, mutant.bad) for mutant in MUTANTS}) == len(MUTANTS) >= 30


def test_a_module_without_errors_is_no_success():
    with pytest.raises(SystemExit, match=r"duffing\.flw: no deliberate error"):
        TOOL["main"](["duffing.oscillator", "duffing.flw"])
