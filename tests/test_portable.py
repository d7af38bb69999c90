"""The package and its tools on other systems: any encoding, no POSIX, as many threads as allowed, any environment."""

import ast
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numba
import pytest

from vectorized import processors

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "tools"))

import pins  # noqa: E402 - its folder is put on the path above

FOLDERS = ("benchmarks", "book", "duffing", "proof", "tests", "tools", "vectorized")
SOURCES = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]


def without_encoding(tree):
    """Lines of calls that read or write text in whatever encoding the locale names."""
    for call in ast.walk(tree):
        if not isinstance(call, ast.Call):
            continue
        name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
        given = {keyword.arg: keyword.value for keyword in call.keywords}
        if "encoding" in given:
            continue
        mode = given.get("mode", next((arg for arg in call.args[-1:] if isinstance(arg, ast.Constant)), None))
        binary = "b" in str(getattr(mode, "value", ""))
        pipe = name in ("run", "Popen", "check_output") and {"text", "universal_newlines"} & given.keys()
        if name in ("read_text", "write_text") or pipe or (name in ("open", "fdopen") and not binary):
            yield call.lineno


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_text_is_read_and_written_as_utf_8_whatever_the_locale(path):
    assert list(without_encoding(ast.parse(path.read_text(encoding="utf-8")))) == []


@pytest.mark.parametrize(
    ("code", "bad"),
    [
        ("path.read_text()", True),
        ("path.read_text(encoding='utf-8')", False),
        ("open(path, 'w')", True),
        ("open(path, 'wb')", False),
        ("path.open()", True),
        ("subprocess.run(x, text=True)", True),
        ("subprocess.run(x)", False),
    ],
)
def test_a_call_that_leaves_the_encoding_to_the_locale_is_found(code, bad):
    assert bool(list(without_encoding(ast.parse(code)))) == bad


def python(code, *arguments, cwd=ROOT, **variables):
    environment = {name: value for name, value in (os.environ | variables).items() if value is not None}
    return subprocess.run(
        [sys.executable, "-W", "default", "-c", code, *arguments],
        env=environment,
        cwd=cwd,
        capture_output=True,
        encoding="utf-8",
        timeout=300,
    )


ELSEWHERE = """
import os, signal, sys
for name in ("fcntl", "pwd", "grp", "resource", "termios"):
    sys.modules[name] = None
for module, names in ((os, ("getuid", "geteuid", "setuid", "fork", "kill", "killpg", "sched_getaffinity")),
                      (signal, ("SIGKILL", "SIGALRM", "SIGHUP", "alarm", "pthread_sigmask"))):
    for name in names:
        if hasattr(module, name):
            delattr(module, name)
if hasattr(os, "process_cpu_count"):
    os.process_cpu_count = os.cpu_count  # as it is where there is no affinity
import importlib, pkgutil
import numpy as np
import duffing
for found in pkgutil.walk_packages(duffing.__path__, "duffing."):
    importlib.import_module(found.name)
osc = duffing.Duffing(mu=np.linspace(0.1, 0.2, 20))
spectrum = duffing.lyapunov_spectrum(osc, periods=2, transient=0, method="rk4", checkpoint=sys.argv[1], progress=True)
print(spectrum.exponents.shape)
"""


def test_the_package_needs_nothing_that_only_posix_systems_have(tmp_path):
    done = python(ELSEWHERE, str(tmp_path / "kept"))
    assert done.stdout == "(2, 20)\n", done.stderr


def group(folder, **files):
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (folder / name.replace("_", ".", 1)).write_text(text, encoding="utf-8")


def test_a_control_groups_share_of_time_limits_the_threads_in_both_of_linuxs_forms(tmp_path):
    own = tmp_path / "self"
    group(tmp_path / "new" / "batch" / "job", cpu_max="150000 100000\n")
    group(tmp_path / "new" / "batch", cpu_max="max 100000\n")
    own.write_text("0::/batch/job\n", encoding="utf-8")
    assert [processors.share(folder) for folder in processors.folders(tmp_path / "new", own)] == [
        1.5,
        math.inf,
        math.inf,
    ]
    old = tmp_path / "old" / "cpu,cpuacct"
    group(old / "job", cpu_cfs_quota_us="400000\n", cpu_cfs_period_us="100000\n")
    group(old, cpu_cfs_quota_us="-1\n", cpu_cfs_period_us="100000\n")
    own.write_text("5:memory:/x\n4:cpu,cpuacct:/job\n", encoding="utf-8")
    assert [processors.share(folder) for folder in processors.folders(tmp_path / "old", own)] == [4.0, math.inf]
    assert processors.folders(tmp_path, tmp_path / "missing") == []


@pytest.mark.parametrize(("share", "threads"), [(math.inf, 8), (20.0, 8), (2.5, 3), (0.1, 1)])
def test_the_threads_are_the_processors_that_the_process_may_use_and_never_none(share, threads, monkeypatch):
    monkeypatch.setattr(processors, "quota", lambda: share)
    monkeypatch.setattr(os, "process_cpu_count", lambda: 8, raising=False)
    assert processors.available() == threads


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="no affinity on this system")
def test_a_process_that_is_bound_to_one_processor_takes_one_thread():
    code = (
        "import os; os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})\n"
        "from vectorized import processors; print(processors.available())"
    )
    assert python(code).stdout == "1\n"


def test_nothing_asks_how_many_processors_the_machine_has():
    asked = [
        path.relative_to(ROOT).as_posix()
        for path in SOURCES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Attribute) and node.attr == "cpu_count"
    ]
    assert asked == ["benchmarks/__main__.py", "vectorized/processors.py"], "the first describes the machine"


SOLVE = """
import duffing
print(float(duffing.trajectory(duffing.Duffing(mu=0.3), (0.45, 0.1), [0.0, 2.0], method="rk4")[0, 1]))
"""


def test_where_no_folder_may_be_written_to_kernels_compile_without_a_cache_and_say_so_once(tmp_path):
    """The folder of the package is hidden by a file: not even the superuser can put a cache there."""
    for name in ("duffing", "vectorized"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    for folder in [path for path in tmp_path.rglob("*") if path.is_dir()]:
        (folder / "__pycache__").write_text("", encoding="utf-8")
    done = python(
        SOLVE,
        cwd=tmp_path,
        PYTHONPATH=str(tmp_path),
        HOME="/proc/nope",
        XDG_CACHE_HOME="/proc/nope",
        NUMBA_CACHE_DIR=None,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("compiled code cannot be kept") == 1
    assert float(done.stdout) == float(python(SOLVE).stdout)


def test_a_switched_off_compiler_is_said_in_one_sentence_and_theory_needs_none():
    done = python(SOLVE, NUMBA_DISABLE_JIT="1")
    assert done.stderr.rstrip().endswith(
        "RuntimeError: NUMBA_DISABLE_JIT is set: the integrators only work compiled, unset it"
    )
    theory = "import duffing; print(duffing.critical_amplitude(duffing.Duffing()) > 0)"
    assert python(theory, NUMBA_DISABLE_JIT="1").stdout == "True\n"


def test_packages_that_are_not_those_of_the_pins_are_named():
    lines = [
        "# comment",
        f"numba=={numba.__version__}",
        "numpy==0.1",
        "no-such-package-anywhere==1.0",
        "pytest==0.1 ; sys_platform == 'nowhere'",
        "-e .",
    ]
    wrong, missing = pins.changed(lines)
    assert wrong.startswith("numpy is ") and wrong.endswith("pinned ==0.1")
    assert missing == "no-such-package-anywhere is missing, pinned ==1.0"


def test_a_browser_that_is_not_there_is_said_in_one_sentence(tmp_path):
    commands = ["-m", "pytest", "tests/browser", "-p", "no:cacheprovider"], ["tools/pdf.py"]
    for variables, sentence in (
        ({"CHROMIUM": "/no/such/program"}, "CHROMIUM = '/no/such/program': there is no such program\n"),
        ({"CHROMIUM": None, "PATH": str(tmp_path)}, "no Chromium found: `apt-get install chromium`, or name one"),
    ):
        environment = {name: value for name, value in (os.environ | variables).items() if value is not None}
        for command in commands:
            done = subprocess.run(
                [sys.executable, *command],
                cwd=ROOT, env=environment, capture_output=True, encoding="utf-8", timeout=120,
            )  # what, and how  # fmt: skip
            said = done.stdout + done.stderr
            assert done.returncode != 0
            assert said.removeprefix("ERROR: ").startswith(sentence) and said.strip().count("\n") == 0, said


@pytest.mark.parametrize("path", sorted((ROOT / "chapters").glob("*.md")), ids=lambda path: path.stem)
def test_a_chapter_runs_in_any_folder_it_names_no_file_by_a_relative_path(path):
    cells = re.findall(r"^```\{code-cell\}.*?\n(.*?)^```", path.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    assert [line for cell in cells for line in cell.splitlines() if re.search(r"""["']\.{1,2}/""", line)] == []
