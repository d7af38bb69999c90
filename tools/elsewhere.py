"""Runs the core of the tests and a small book as strangers would run them, and prints a table: make elsewhere

python tools/elsewhere.py [name ...] [--tests FILE ...]     only environments whose name holds one of the words; only
these tests instead of those of `make check`

Every environment runs what `make check` runs, in one copy of the checkout in a temporary folder. The last one runs
every chapter as a downloaded notebook beside an installed wheel. What cannot be had here (another user without being
root, another Python) is listed with the reason.
"""

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
NOBODY = 65534
PATIENCE = 3600  # seconds for one command
LINES = 60  # of what a failing command said
BOOK = "import sys; sys.path.append('tests'); import small_book; from pathlib import Path; root = Path(sys.argv[1]);"
BOOK += "code, said = small_book.build(small_book.make(root, real=True)); print(said); sys.exit(code)"
# What `make check` runs.
CORE = ("--numprocesses=2", "--dist=loadfile", "-m", "not slow")
NOTEBOOK = "import jupytext, sys; from nbclient import NotebookClient;"
NOTEBOOK += "NotebookClient(jupytext.read(sys.argv[1]), timeout=1200, kernel_name='python3').execute()"
PERSONAL = "savefig.bbox: tight\nfigure.dpi: 37\ntext.usetex: True\nbackend: tkagg\n"
# Brings up the loopback interface of a new network namespace, then becomes the command.
LOOPBACK = """import fcntl, os, socket, struct, sys
with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
    fcntl.ioctl(s, 0x8914, struct.pack("16sh14x", b"lo", 1))
os.execv(sys.argv[1], sys.argv[1:])"""


class Place(NamedTuple):
    """An environment: variables (None unsets), what the process does before it starts, and what it is started by."""

    name: str
    variables: dict = MappingProxyType({})
    before: object = None
    start: tuple = ()
    user: int | None = None
    missing: str = ""


def copied(folder):
    """What git knows of the checkout, in a folder that everybody may write to."""
    ignored = [line.rstrip("/") for line in (ROOT / ".gitignore").read_text(encoding="utf-8").split()]
    shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(".git", *ignored))
    for path in [folder, *folder.rglob("*")]:
        path.chmod(path.stat().st_mode | (0o777 if path.is_dir() else 0o666))
    return folder


def personal(home):
    """A home folder full of settings that would break the book and the tests if they were read."""
    for name, text in {
        ".config/matplotlib/matplotlibrc": PERSONAL,
        ".ipython/profile_default/startup/mine.py": "raise SystemExit('a personal start-up file was read')\n",
        ".jupyter/jupyter_config.py": "raise SystemExit('a personal configuration was read')\n",
        ".config/dask/mine.yaml": "distributed: {scheduler: {allowed-failures: 0}}\n",
        "path/duffing/__init__.py": "raise ImportError('another duffing was found')\n",
    }.items():
        (home / name).parent.mkdir(parents=True, exist_ok=True)
        (home / name).write_text(text, encoding="utf-8")
    return {
        "HOME": str(home),
        "MPLBACKEND": "tkagg",
        "MATPLOTLIBRC": str(home / ".config/matplotlib/matplotlibrc"),
        "IPYTHONDIR": str(home / ".ipython"),
        "JUPYTER_CONFIG_DIR": str(home / ".jupyter"),
        "PYTHONPATH": str(home / "path"),
        "MPLCONFIGDIR": str(home / ".config/matplotlib"),
    }


def is_root():
    return hasattr(os, "getuid") and os.getuid() == 0


def needs_another_user():
    """Why there is none: "" if there is one. An interpreter below a private home is of no use to another user."""
    if not is_root():
        return "needs root"
    try:
        subprocess.run([sys.executable, "-c", ""], user=NOBODY, group=NOBODY, capture_output=True, cwd="/", check=True)
    except (OSError, subprocess.CalledProcessError):
        return "needs a Python that others may run"
    return ""


def one_processor():
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def places(folder):
    """All environments that are tried, in the order of the table."""
    unshared = (
        shutil.which("unshare") and subprocess.run(["unshare", "-rn", "true"], capture_output=True).returncode == 0
    )
    (folder / "empty").mkdir()
    return [
        Place("as it is"),
        Place("HOME not writable", {"HOME": "/proc/nope", "MPLCONFIGDIR": "/proc/nope"}),
        Place("another user, HOME not writable", {"HOME": "/proc/nope"}, user=NOBODY, missing=needs_another_user()),
        Place("empty settings", {"HOME": str(folder / "empty")}),
        Place("personal settings", personal(folder / "personal")),
        Place("SIGINT ignored", before=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN)),
        Place(
            "one processor", before=one_processor,
            missing="" if hasattr(os, "sched_setaffinity") else "no affinity on this system",
        ),
        Place("C locale", {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}),
        Place(
            "no network, a user namespace", start=("unshare", "-rn", sys.executable, "-c", LOOPBACK),
            missing="" if unshared else "namespaces are not allowed here",
        ),
    ]  # a place a line, or a few  # fmt: skip


def run(command, place, folder):
    """Run a command there; returns (whether it went well, what it said)."""
    variables = {name: value for name, value in ({**os.environ, **place.variables}).items() if value is not None}
    try:
        done = subprocess.run(
            [*place.start, *command],
            cwd=folder, env=variables, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE,
            preexec_fn=place.before, user=place.user, group=place.user, umask=0,
        )  # what, where and how  # fmt: skip
    except subprocess.TimeoutExpired:
        return False, f"not done within {PATIENCE} seconds"
    return done.returncode == 0, done.stdout.decode("utf-8", "replace")


def pythons():
    """The tested Pythons other than this one: dict version -> path or None."""
    named = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["classifiers"]
    found = {}
    for version in (line.rpartition(" ")[2] for line in named):
        candidates = [shutil.which(f"python{version}"), *Path.home().glob(f".pyenv/versions/{version}.*/bin/python")]
        works = [
            path for path in candidates if path and subprocess.run([path, "-V"], capture_output=True).returncode == 0
        ]
        if version != "{}.{}".format(*sys.version_info):
            found[version] = str(works[0]) if works else None
    return found


def both(python, place, checkout, tests, book):
    """The tests and the small book in one environment: dict name -> (whether it went well, what it said)."""
    shutil.rmtree(checkout / "_build", ignore_errors=True)
    shutil.rmtree(book, ignore_errors=True)
    return {
        "tests": run([python, "-m", "pytest", "-p", "no:cacheprovider", *tests], place, checkout),
        "book": run([python, "-c", BOOK, str(book)], place, checkout),
    }


def in_another_python(python, checkout, tests, folder):
    """Both in a new environment of another Python."""
    own = folder / f"environment-{Path(python).name}-{time.time_ns()}"
    new = str(own / "bin" / "python")
    for command in (
        [python, "-m", "venv", str(own)],
        [new, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r", "environment.txt"],
    ):
        ok, said = run(command, Place(""), checkout)
        if not ok:
            return {"installation": (False, said)}
    results = both(new, Place(""), checkout, tests, folder / "book")
    shutil.rmtree(own)
    return results


def beside_a_wheel(checkout, folder):
    """Every chapter as a downloaded notebook in an empty folder, with a wheel installed where nobody may write and no
    home. Jupyter, IPython and Matplotlib have folders of their own: Jupyter cannot start a kernel without."""
    site, wheels = folder / "site", folder / "wheels"
    for command in (
        f"wheel --wheel-dir={wheels} .",
        f"install --no-index --find-links={wheels} --target={site} duffing",
    ):
        pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
        ok, said = run([*pip, *command.split(), "--no-deps"], Place(""), checkout)
        if not ok:
            return {"installation": (False, said)}
    for path in [site, *site.rglob("*")]:
        path.chmod(path.stat().st_mode & ~0o222)
    variables = {"PYTHONPATH": str(site), "HOME": "/proc/nope"}
    for name in ("IPYTHONDIR", "JUPYTER_RUNTIME_DIR", "JUPYTER_DATA_DIR", "JUPYTER_CONFIG_DIR", "MPLCONFIGDIR"):
        (folder / "tools" / name).mkdir(parents=True, exist_ok=True)
        (folder / "tools" / name).chmod(0o777)
        variables[name] = str(folder / "tools" / name)
    place = Place("", variables, user=NOBODY if is_root() else None)

    def downloaded(page):
        empty = Path(tempfile.mkdtemp(dir=folder))
        empty.chmod(0o777)
        shutil.copy(page, empty)
        return run([sys.executable, "-c", NOTEBOOK, page.name], place, empty)

    pages = {page.relative_to(checkout / "chapters").as_posix(): page for page in (checkout / "chapters").rglob("*.md")}
    notebooks = {name: page for name, page in pages.items() if "{code-cell}" in page.read_text(encoding="utf-8")}
    with ThreadPoolExecutor(2) as two:
        return dict(zip(notebooks, two.map(downloaded, notebooks.values()), strict=True))


def rows(folder, checkout, tests):
    """(name, what is missing, a function that runs all there, as `both`) of each environment."""
    for place in places(folder):
        yield place.name, place.missing, partial(both, sys.executable, place, checkout, tests, folder / "book")
    for version, python in pythons().items():
        missing = "" if python else "not installed here"
        yield f"Python {version}", missing, partial(in_another_python, python, checkout, tests, folder)
    missing = needs_another_user() if is_root() else ""  # nothing is read-only for root
    yield "downloads beside a wheel", missing, partial(beside_a_wheel, checkout, folder)


def main():
    options = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    options.add_argument("names", nargs="*", help="words of the names of the environments")
    options.add_argument("--tests", nargs="+", default=CORE, help="tests instead of those of `make check`")
    given, failed = options.parse_args(), []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o777)
        checkout = copied(folder / "checkout")
        for name, missing, run_all in rows(folder, checkout, given.tests):
            if given.names and not any(word in name for word in given.names):
                continue
            if missing:
                print(f"{name:34} not tried: {missing}", flush=True)
                continue
            start = time.monotonic()
            results = run_all()
            bad = {what: said for what, (well, said) in results.items() if not well}
            words = f"failed: {', '.join(bad)}" if bad else "passed"
            print(f"{name:34} {len(results) - len(bad)} of {len(results)} {words}", end="")
            print(f" {time.monotonic() - start:5.0f} s", flush=True)
            for what, said in bad.items():
                failed.append(name)
                print(f"  {what}:\n    " + "\n    ".join(said.rstrip().splitlines()[-LINES:]), flush=True)
    sys.exit(f"failed: {', '.join(dict.fromkeys(failed))}" if failed else None)


if __name__ == "__main__":
    main()
