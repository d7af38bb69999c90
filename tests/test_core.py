"""The core, the package without its other rooms, is small and reproduces the paper's figures but Fig. 2 on its own."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CORE = [*sorted((ROOT / "duffing").glob("*.py")), *sorted((ROOT / "duffing" / "integrators").glob("*.py"))]
FIGURES = ("1a", "1b", "3a", "3b", "4a", "4b", "5a", "5b", "6a", "6b")
MOST_OF_THE_CORE, MOST = 1525, 6225

# A process in which nothing of the project can be imported but the core, the study of the paper's figures and what
# draws them: then each figure's data against the baseline, as `test_figures` compares them.
SCRIPT = """
import sys
from pathlib import Path
import numpy as np

ALLOWED = {allowed!r}

class OnlyTheCore:
    def find_spec(self, name, path=None, target=None):
        ours = name.partition(".")[0] in ("duffing", "book")
        if ours and name not in ALLOWED and not name.startswith("book.figures"):
            raise ImportError(f"{{name}} is no part of the core")

sys.meta_path.insert(0, OnlyTheCore())
sys.path[:0] = [{root!r}, {tests!r}]
from cases.paper import CASES

for name in sys.argv[1:]:
    case = CASES[name]
    with np.load(Path({tests!r}, "baseline", f"{{name}}.npz")) as stored:
        reference = dict(stored)
    data = case.compute()
    assert data.keys() == reference.keys()
    case.compare(data, reference)
    print(name)
"""
STUDY = ["book", "book.remember", "book.studies", "book.studies.reproduction"]


def named(path):
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


def run(figures, allowed):
    script = SCRIPT.format(allowed=sorted(allowed), root=str(ROOT), tests=str(ROOT / "tests"))
    return subprocess.run(
        [sys.executable, "-c", script, *(f"fig{figure}" for figure in figures)],
        capture_output=True,
        text=True,
        encoding="utf-8",
    )


def test_the_core_alone_computes_the_data_of_all_figures_of_the_paper_but_the_second():
    done = run(FIGURES, [*map(named, CORE), *STUDY])
    assert done.stdout.split() == [f"fig{figure}" for figure in FIGURES], done.stderr


@pytest.mark.parametrize(("figures", "less"), [(["2"], None), (["4a"], "duffing.lyapunov"), (["5a"], "duffing.flow")])
def test_what_is_no_part_of_it_cannot_be_imported_there(figures, less):
    """The test above can fail: the manifolds are missing, and so is a module of the core that is taken away."""
    done = run(figures, {*map(named, CORE), *STUDY} - {less})
    assert done.returncode == 1
    assert "is no part of the core" in done.stderr


def lines(paths):
    return sum(path.read_text(encoding="utf-8").count("\n") for path in paths)


def test_the_core_and_the_package_are_small():
    assert lines(CORE) <= MOST_OF_THE_CORE
    assert lines((ROOT / "duffing").rglob("*.py")) <= MOST
