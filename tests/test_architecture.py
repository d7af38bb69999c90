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
    "powers", "forcing", "rk4", "companion",
    "elementary", "lanes", "friction_time", "dop853", "creep", "frame", "landing", "judge",
    "follow", "flight", "friction", "turning",
    "flow",
    "progress", "checkpoint", "workers", "sweep",
    "poincare", "lyapunov", "cost", "shooting", "saddle", "manifolds", "tangency", "correction", "sticking",
    "precision", "paper", "remember", "reproduction", "small_p",
    "diagram",
    "periodic", "continuation", "bifurcations", "followed", "bifurcation_study", "resonance_study",
    "trapping", "attractors", "basins", "fates", "uncertainty", "boundary", "contact", "basin_study",
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
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            inside |= {node.module} if node.module else {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            outside.add(node.module.partition(".")[0])
        elif isinstance(node, ast.Import):
            outside |= {alias.name.partition(".")[0] for alias in node.names}
    return inside, outside


def modules():
    return [path.stem for path in sorted(PACKAGE.glob("*.py")) if path.stem != "__init__"]


def test_every_module_has_its_place_in_the_order():
    assert sorted(modules()) == sorted(ORDER)


@pytest.mark.parametrize("name", modules())
def test_a_module_imports_only_modules_left_of_it(name):
    inside, _ = imports(PACKAGE / f"{name}.py")
    later = {other for other in inside if ORDER.index(other) >= ORDER.index(name)}
    assert not later


@pytest.mark.parametrize("name", modules())
def test_only_the_figure_modules_draw(name):
    _, outside = imports(PACKAGE / f"{name}.py")
    assert ("matplotlib" in outside) == (name == "page_figure")


def test_figures_compute_nothing():
    assert imports(PACKAGE / "figures.py")[0] == {"page_figure"}
    for path in PACKAGE.glob("figures_*.py"):
        assert imports(path)[0] == {"page_figure", "figures"}
    assert imports(PACKAGE / "figures_speed.py")[0] == {"page_figure", "figures"}


@pytest.mark.parametrize("name", modules())
def test_a_module_holds_one_idea_and_says_which(name):
    text = (PACKAGE / f"{name}.py").read_text()
    assert ast.get_docstring(ast.parse(text))
    assert text.count("\n") <= 250


@pytest.mark.parametrize("name", modules())
def test_every_public_function_and_class_is_documented(name):
    module = importlib.import_module(f"duffing.{name}")
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
