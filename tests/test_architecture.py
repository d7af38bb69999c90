"""The house rules: three floors, imports go down only, one module draws, public names are documented.

Floors: `duffing` simulates, `book` computes, draws and judges what chapters show, `chapters` call both. Rooms are
folders; a new module takes part by being in one.
"""

import ast
import inspect
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import duffing

ROOT = Path(__file__).parents[1]
# From the ground up: a room imports from itself and from the rooms before it. The second line is the core.
ROOMS = (
    ("vectorized",),
    ("duffing", "duffing.integrators"),
    ("duffing.integrators.friction_time",),
    ("duffing.sweep",),
    ("duffing.manifolds",),
    ("duffing.orbits",),
    ("duffing.basins",),
    ("duffing.transients",),
    ("book",),
    ("book.studies",),
    ("book.figures",),
    ("book.pages",),
    ("book.claims",),
)
PACKAGES = ("vectorized", "duffing", "book")
FLOOR = {room: number for number, rooms in enumerate(ROOMS) for room in rooms}
PATHS = {
    ".".join(path.relative_to(ROOT).with_suffix("").parts): path
    for package in PACKAGES
    for path in sorted((ROOT / package).rglob("*.py"))
    if path.stem != "__init__" and "sphinx" not in path.parts
}


def imports(name, nodes=ast.walk):
    """Modules of the project, and other packages, that a module imports: two sets of dotted names.

    nodes : which of the tree's nodes count; `ast.walk` for imports inside functions, too
    """
    inside, outside = set(), set()
    for node in nodes(ast.parse(PATHS[name].read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            outside |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = name.split(".")[: -node.level] if node.level else []
            source = ".".join([*base, *([node.module] if node.module else [])])
            if source.partition(".")[0] not in PACKAGES:
                outside.add(source.partition(".")[0])
            elif source in PATHS:
                inside.add(source)
            else:  # names of a room: its modules, or what the package itself offers
                inside |= {f"{source}.{a.name}" for a in node.names if f"{source}.{a.name}" in PATHS}
    return inside, outside


def statements(tree):
    """Those of the module itself: what it needs to be imported."""
    return tree.body


def room(name):
    return name.rpartition(".")[0]


def test_every_folder_of_modules_is_a_room():
    assert {room(name) for name in PATHS} == set(FLOOR)


def test_imports_go_down():
    # What a function of the core imports when it is called for (an integrator, a sweep) is no arrow of the core's own.
    up = set()
    for name in PATHS:
        level = FLOOR[room(name)]
        called = imports(name, nodes=statements if level == FLOOR["duffing"] else ast.walk)[0]
        up |= {(name, other) for other in called if FLOOR[room(other)] > level}
    assert not up


def test_compiled_code_calls_none_of_another_package_than_vectorized():
    """The cache of compiled code of a package follows that package and `vectorized` (`vectorized.compiled`)."""
    holds = {name for name in PATHS if "vectorized.compiled" in imports(name)[0]}
    assert {name.partition(".")[0] for name in holds} == {"duffing", "book"}
    for name in holds:
        others = imports(name)[0] & holds
        assert {other.partition(".")[0] for other in others} <= {name.partition(".")[0]}, name


def test_no_modules_import_each_other_in_a_circle():
    left = {name: imports(name, nodes=statements)[0] for name in PATHS}
    while left:
        free = {name for name, needs in left.items() if not needs & left.keys()}
        assert free, sorted(left)
        left = {name: needs for name, needs in left.items() if name not in free}


def test_the_package_draws_nothing_and_one_room_of_the_book_does():
    drawing = {room(name) for name in PATHS if "matplotlib" in imports(name)[1]}
    assert drawing == {"book.figures"}


def test_figures_compute_nothing():
    for name in PATHS:
        if room(name) == "book.figures":
            inside, outside = imports(name)
            assert {room(other) for other in inside} <= {"book.figures"}, name
            assert "scipy" not in outside, name


def test_a_module_holds_one_idea_and_says_which():
    for name, path in PATHS.items():
        text = path.read_text(encoding="utf-8")
        assert ast.get_docstring(ast.parse(text)), name
        assert text.count("\n") <= 250, name


def test_every_public_function_and_class_is_documented():
    for name in PATHS:
        module = import_module(name)
        silent = [
            key
            for key, value in vars(module).items()
            if not key.startswith("_")
            and (inspect.isfunction(value) or inspect.isclass(value))
            and value.__module__ == name
            and not inspect.getdoc(value)
        ]
        assert silent == [], name


def test_nothing_takes_a_private_name_from_another_room():
    for name, path in PATHS.items():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and any(alias.name.startswith("_") for alias in node.names):
                base = ".".join(name.split(".")[: -node.level]) if node.level else ""
                source = ".".join(filter(None, (base, node.module)))
                assert room(source) == room(name) or source == room(name), (name, source)


# Kernels shown or taken apart: coefficients against their conditions, steps of an algorithm one by one.
INSIDE_OF_KERNELS = {
    ("speed.md", "friction_time._slopes"),
    ("speed.md", "rk4._stage"),
    ("test_forcing.py", "forcing._cosine_of_turns"),
    ("test_friction.py", "_A"),
    ("test_friction.py", "_C"),
    ("test_tangency.py", "_highest"),
    ("test_tangency.py", "_split"),
    ("test_vectors.py", "dop853._combine"),
}


def private_names(text):
    """What code takes from the project under a private name: by "from duffing.x import _y", or by "x._y"."""
    tree, modules, found = ast.parse(text), set(), set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] in PACKAGES:
            modules |= {alias.asname or alias.name for alias in node.names if f"{node.module}.{alias.name}" in PATHS}
            found |= {alias.name for alias in node.names if alias.name.startswith("_")}
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id in modules:
            found |= {f"{node.value.id}.{node.attr}"} if re.match("_[^_]", node.attr) else set()
    return found


def test_chapters_tests_and_tools_use_public_names():
    paths = [path for room in ("tests", "tools") for path in (ROOT / room).rglob("*.py")]
    texts = {path: path.read_text(encoding="utf-8") for path in paths}
    for path in (ROOT / "chapters").rglob("*.md"):
        # After a cell's options, between two rules or a line each.
        cell = r"^```\{code-cell\}[^\n]*\n(?:---\n.*?^---\n|(?::[^\n]*\n)*)(.*?)^```"
        texts[path] = "".join(re.findall(cell, path.read_text(encoding="utf-8"), re.M | re.S))
    found = {(path.name, name) for path, text in texts.items() for name in private_names(text)}
    assert found <= INSIDE_OF_KERNELS


def test_public_names_are_sorted_and_importable():
    assert duffing.__all__ == sorted(duffing.__all__)
    assert all(hasattr(duffing, name) for name in duffing.__all__)


def test_importing_the_package_loads_no_drawing_library():
    code = "import sys, duffing; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT).returncode == 0
