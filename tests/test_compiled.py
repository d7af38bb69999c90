"""The disk cache of compiled code: used again while the package is the same, never after an edit."""

import io
import shutil
import subprocess
import sys
from pathlib import Path

import numba
import pytest

import duffing
from vectorized import compiled as compiling
from vectorized.compiled import ROOM, announced, compiled, fingerprint

PACKAGE = Path(duffing.__file__).parent
RUN = """
import duffing
osc = duffing.Duffing(p=0.5, mu=0.3)
print(float(duffing.trajectory(osc, (0.45, 0.1), [0.0, 2.0], method="rk4")[0, 1]))
"""


@pytest.mark.parametrize(
    ("module", "changes"), [("integrators/friction_time/equations", True), ("integrators/rk4", True), ("paper", False)]
)
def test_the_cache_folder_changes_with_an_edit_of_compiled_code_and_with_no_other(module, changes, tmp_path):
    copy = tmp_path / "duffing"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    assert fingerprint(copy) == fingerprint(PACKAGE)
    path = copy / f"{module}.py"
    path.write_text(path.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    assert (fingerprint(copy) != fingerprint(PACKAGE)) == changes


def test_every_module_with_compiled_code_counts(tmp_path):
    """A module that a kernel takes code from is compiled code itself, and says so by its imports."""
    for path in [*PACKAGE.rglob("*.py"), *ROOM.rglob("*.py")]:
        text = path.read_text(encoding="utf-8")
        if "@compiled" in text or "njit" in text or "intrinsic" in text:
            assert "numba" in text or ".compiled import" in text, path.name


def test_an_edit_in_a_called_function_is_not_answered_from_the_cache(tmp_path):
    """The Runge-Kutta kernel stands in another file than the power |v|^(p-1) that it calls."""
    copy = tmp_path / "duffing"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))

    def run():
        return float(subprocess.run([sys.executable, "-c", RUN], cwd=tmp_path, check=True, capture_output=True).stdout)

    before = run()
    module = copy / "integrators" / "powers.py"
    text = module.read_text(encoding="utf-8")
    edited = text.replace("return take(q.table, cell) *", "return 2 * take(q.table, cell) *")
    assert edited != text
    module.write_text(edited, encoding="utf-8")
    assert abs(run() - before) > 1e-3


def test_compiling_leaves_the_callers_settings_alone():
    before = numba.config.CACHE_DIR

    @compiled
    def double(x):
        return 2 * x

    assert double(2.0) == 4.0
    assert before == numba.config.CACHE_DIR


@pytest.mark.parametrize("terminal", [True, False])
def test_a_kernel_that_compiles_for_long_says_so_once_and_on_a_terminal_only(terminal, monkeypatch, tmp_path):
    monkeypatch.setattr(compiling, "_folder", lambda package: str(tmp_path))  # an empty cache

    @compiled
    def twice(x):
        return 2 * x

    stream = io.StringIO()
    stream.isatty = lambda: terminal
    monkeypatch.setattr(sys, "stderr", stream)
    announced(twice, "a function of the tests")
    assert [twice(2.0), twice(3.0)] == [4.0, 6.0]
    assert stream.getvalue().count("compiling a function of the tests") == terminal
