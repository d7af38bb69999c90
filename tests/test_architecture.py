"""The house rules: data flows one way, only the figure modules draw, public names are documented."""

import ast
import importlib
import inspect
from pathlib import Path

import pytest

import duffing

PACKAGE = Path(duffing.__file__).parent
# A module imports only from the rows above its own (and freely within a row's left part: see the test).
ORDER = [
    "compiled", "errors", "checks", "arithmetic", "oscillator", "orbit",
    "melnikov",
    "vectors", "powers", "forcing", "rk4", "companion",
    "elementary", "lanes", "friction_time", "dop853", "creep", "frame", "landing", "judge",
    "follow", "flight", "friction", "turning",
    "flow",
    "progress", "checkpoint", "workers", "sweep",
    "poincare", "lyapunov", "cost", "shooting", "saddle", "manifolds", "tangency", "correction", "sticking",
    "precision", "paper", "remember", "reproduction", "small_p",
    "diagram",
    "periodic", "continuation", "bifurcations", "followed", "bifurcation_study", "resonance_study",
    "trapping", "capture", "attractors", "basins", "fates", "uncertainty", "boundary", "contact", "basin_study",
    "lifetimes", "survival", "crisis", "comparison", "transient_study", "comparison_study",
    "explorer", "basin_explorer", "widgets", "maps",
    "verdicts", "findings_theory", "findings_exponents", "findings_motion", "findings_contradiction",
    "tables", "measured", "ledger",
    "page_figure", "figures", "figures_beyond", "figures_speed", "figures_bifurcations", "figures_basins",
    "figures_transients", "figures_maps",
]  # a row for each layer  # fmt: skip


def imports(path):
    """Names of the modules of the package, and of other packages, that a module imports anywhere in its text."""
    inside, outside = set(), set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level > 0:
            last = (node.module or "").rpartition(".")[2]
            inside |= {last} if last in ORDER else {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            outside.add(node.module.partition(".")[0])
        elif isinstance(node, ast.Import):
            outside |= {alias.name.partition(".")[0] for alias in node.names}
    return inside, outside


PATHS = [path for path in sorted(PACKAGE.rglob("*.py")) if path.stem != "__init__"]
MODULES = {path.stem: path for path in PATHS}


def test_every_module_has_its_place_in_the_order():
    assert sorted(path.stem for path in PATHS) == sorted(ORDER)


@pytest.mark.parametrize("name", MODULES)
def test_a_module_imports_only_modules_left_of_it(name):
    inside, _ = imports(MODULES[name])
    later = {other for other in inside if ORDER.index(other) >= ORDER.index(name)}
    assert not later


@pytest.mark.parametrize("name", MODULES)
def test_only_the_figure_modules_draw(name):
    _, outside = imports(MODULES[name])
    assert ("matplotlib" in outside) == (name == "page_figure")


def test_figures_compute_nothing():
    for name, path in MODULES.items():
        if name.startswith("figures"):
            assert imports(path)[0] == ({"page_figure"} if name == "figures" else {"page_figure", "figures"})


@pytest.mark.parametrize("name", MODULES)
def test_a_module_holds_one_idea_and_says_which(name):
    text = (MODULES[name]).read_text()
    assert ast.get_docstring(ast.parse(text))
    assert text.count("\n") <= 250


@pytest.mark.parametrize("name", MODULES)
def test_every_public_function_and_class_is_documented(name):
    module = importlib.import_module(".".join(("duffing", *MODULES[name].relative_to(PACKAGE).with_suffix("").parts)))
    public = [
        value
        for key, value in vars(module).items()
        if not key.startswith("_")
        and (inspect.isfunction(value) or inspect.isclass(value))
        and value.__module__ == module.__name__
    ]
    assert [value.__name__ for value in public if not inspect.getdoc(value)] == []


def test_public_names_are_sorted_and_importable():
    assert duffing.__all__ == sorted(duffing.__all__)
    assert all(hasattr(duffing, name) for name in duffing.__all__)
