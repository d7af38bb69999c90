"""The live laboratory: a page that integrates the equation in the reader's browser, offline and without a server.

The integrator is a script of its own (laboratory.js) and not the package's kernels compiled to WebAssembly: numba's
code for them calls Python and the processor's own vector unit, so that it would have to be rewritten and linked for a
browser by tools that nothing else here needs. A test in a browser holds the script to the package's solutions.
"""

import json
from dataclasses import asdict
from pathlib import Path

import numpy as np
from scipy.integrate import DOP853

from duffing import paper
from duffing.integrators.friction_time import radau

LEAST_P, MOST_P = 0.02, 10.0
SCAN = tuple(np.round(np.arange(0.01, 0.401, 0.01), 2).tolist())  # forcing amplitudes of a scan, as Fig. 4 shows them
_PARTS = ("_creep", "", "_values", "_run", "_panel", "_pictures", "_view")  # the scripts, in the order they are needed


def coefficients():
    """The coefficients of both methods: SciPy's of the explicit one, the package's of the implicit one."""
    return {
        "explicit": [*(row.tolist() for row in DOP853.A[1:]), DOP853.B.tolist()],
        "error3": DOP853.E3.tolist(),
        "error5": DOP853.E5.tolist(),
        "nodes": radau._C.tolist(),
        "implicit": radau._A.tolist(),
        "difference": radau._DIFFERENCE.tolist(),
        "fine": radau._FINE.tolist(),
    }


def presets():
    """What the buttons load, a list of dict: name, values, periods, scan (whether over mu), from the paper."""
    after = round(paper.SETTLED / paper.OSCILLATOR.period)
    return [
        _preset("Fig. 5a", paper.P_SMALL, paper.MU_CHAOTIC, transient=after),
        _preset("Fig. 5b", paper.P_SMALL, paper.MU_REGULAR, transient=after),
        _preset("Fig. 4a", paper.P_SMALL, SCAN[0], scan=True),
        _preset("Fig. 4b", paper.P_LINEAR, SCAN[0], scan=True),
    ]


def _preset(name, p, mu, transient=0, scan=False):
    x, v = paper.START
    values = asdict(paper.OSCILLATOR) | {"p": p, "mu": mu, "x": x, "v": v, "transient": transient}
    return {"name": name, "values": values, "periods": paper.PERIODS, "scan": scan}


def laboratory():
    """The laboratory as an IPython HTML object: one piece that needs nothing else."""
    from IPython.display import HTML  # only a notebook calls this

    here = Path(__file__).parent
    data = {
        "table": coefficients(),
        "presets": presets(),
        "periods": paper.PERIODS,
        "threshold": paper.THRESHOLD,
        "scan": SCAN,
        "least_p": LEAST_P,
        "most_p": MOST_P,
    }
    # Nothing in the data may end the script that holds it.
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    page = (here / "laboratory.html").read_text(encoding="utf-8").replace("PERIODS", str(paper.PERIODS))
    scripts = "\n".join((here / f"laboratory{part}.js").read_text(encoding="utf-8") for part in _PARTS)
    return HTML(page.replace("DATA", text).replace("SCRIPTS", scripts))
