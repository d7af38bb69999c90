"""Kernels and tests see nothing personal: not the reader's settings, not what the machine says about itself.

Matplotlib, IPython, Jupyter, dask and others read files below the home folder and variables of the environment: a
personal style would change a figure, a home that cannot be written to makes Matplotlib complain in a cell. So what a
build starts has a home of its own, inside `_build`, and Python starts there as it does on every other machine. As an
extension this holds for `jupyter-book build .` as well.
"""

import os
import subprocess
import sys
from pathlib import Path

# Beginnings of the names of variables that bring in personal settings. Numba's stay: they tell of the machine.
PERSONAL = ("PYTHON", "IPYTHON", "JUPYTER", "MPL", "MATPLOTLIB", "DASK_", "LC_", "LANG", "XDG_", "SPHINXOPTS")
# How a kernel starts: without the advice on encrypted transport, once a chapter, which would bury what matters.
CONFIG = "c.IPKernelApp.log_level = 'ERROR'\n"
# What libraries log (a font cache being built, a folder that is temporary) tells of the machine and is no output of a
# cell. What the project logs, warns of or prints is one, and fails the build.
STARTUP = """import logging
import sys


class Machine(logging.StreamHandler):
    def emit(self, record):
        if record.name.partition(".")[0] in ("root", "__main__", "duffing", "vectorized", "book", "proof"):
            super().emit(record)
        else:
            with open({log!r}, "a", encoding="utf-8") as file:
                file.write(record.name + ": " + record.getMessage() + chr(10))


logging.lastResort = Machine(sys.stderr)
logging.lastResort.setLevel(logging.WARNING)
del logging, sys, Machine
"""


def surroundings(folder, root, given):
    """The environment (dict) of a process that sees nothing personal; given : the environment there is.

    What the process may look up at home lies in folder. Python finds packages in root first: chapters and tests compute
    with what lies beside them, whatever is installed. The language is C, the encoding UTF-8 whatever the locale.
    """
    folder = Path(folder).absolute()
    home = str(folder / "home")
    kept = {name: value for name, value in given.items() if not name.startswith(PERSONAL)}
    return kept | {
        "HOME": home,
        "USERPROFILE": home,
        "XDG_CONFIG_HOME": str(folder / "home" / ".config"),
        "XDG_CACHE_HOME": str(folder / "home" / ".cache"),
        "XDG_DATA_HOME": str(folder / "home" / ".local" / "share"),
        "MPLCONFIGDIR": str(folder / "matplotlib"),
        "IPYTHONDIR": str(folder / "ipython"),
        "JUPYTER_CONFIG_DIR": str(folder / "jupyter" / "config"),
        "JUPYTER_DATA_DIR": str(folder / "jupyter" / "data"),
        "JUPYTER_RUNTIME_DIR": str(folder / "jupyter" / "runtime"),
        "JUPYTER_PREFER_ENV_PATH": "1",
        "NUMBA_CACHE_DIR": given.get("NUMBA_CACHE_DIR", str(folder / "numba")),
        "PYTHONPATH": str(Path(root).absolute()),
        "PYTHONNOUSERSITE": "1",
        "PYTHONUTF8": "1",
        "LC_ALL": "C",
    }


def isolate(folder, root):
    """Put this process, and so all that it starts, into the surroundings of the folder, which is made ready."""
    changed = surroundings(folder, root, os.environ)
    sys.path.insert(0, changed["PYTHONPATH"])
    for name in os.environ.keys() - changed.keys():
        del os.environ[name]
    os.environ.update(changed)
    for name in ("HOME", "MPLCONFIGDIR", "NUMBA_CACHE_DIR", "JUPYTER_RUNTIME_DIR"):
        Path(changed[name]).mkdir(parents=True, exist_ok=True)
    profile = Path(changed["IPYTHONDIR"], "profile_default")
    (profile / "startup").mkdir(parents=True, exist_ok=True)
    (profile / "ipython_kernel_config.py").write_text(CONFIG, encoding="utf-8")
    log = str(Path(folder).absolute() / "messages.log")
    (profile / "startup" / "messages.py").write_text(STARTUP.format(log=log), encoding="utf-8")


def warm(folder):
    """Let Matplotlib find its fonts before the first kernel asks for one: on a slow machine it takes a minute."""
    if not any(Path(folder, "matplotlib").glob("fontlist*.json")):
        subprocess.run([sys.executable, "-c", "import matplotlib.font_manager"], capture_output=True)


def setup(app):
    folder = Path(app.outdir).parent / "kernels"
    isolate(folder, app.srcdir)
    warm(folder)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
