"""Deliberate errors, one at a time: each must turn the suite red.

    python tools/mutants.py                      all of them, some minutes each where a kernel is compiled anew
    python tools/mutants.py duffing.melnikov     those of some modules

Each error is put into a copy of the repository. The tests of the module concerned run first, the whole suite only if these
stay green; both pass without the error. Prints which test caught what; the exit code is the number of survivors.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
PATIENCE = 1200  # seconds; the whole suite takes some minutes, a loop without end for ever

# Tests of the repository and of builds are no tests of the package, and the copy is no clone.
SUITE = (
    "tests",
    *(
        f"--ignore=tests/{name}"
        for name in (
            "browser",
            "test_book.py",
            "test_repository.py",
            "test_reproducible.py",
            "test_interrupted_build.py",
            "test_extensions.py",
            "test_figure_files.py",
        )
    ),
)


class Mutant(NamedTuple):
    """An error: in a module ("duffing.flow") the text `good`, which occurs once, becomes `bad`. tests : files to try first."""

    module: str
    what: str
    good: str
    bad: str
    tests: tuple = ()


MUTANTS = (
    Mutant("duffing.oscillator", "sign of the linear force", "return -self.delta * x", "return self.delta * x"),
    Mutant("duffing.oscillator", "lost |v| in the damping", "sign(v) * abs(v) ** self.p", "sign(v) * v ** self.p"),
    Mutant("duffing.oscillator", "factor of the quartic potential", "self.gamma * x**4 / 4", "self.gamma * x**4 / 2"),
    Mutant("duffing.oscillator", "power of alpha's unit", "(osc.p - 1.5)", "(osc.p - 0.5)"),
    Mutant("duffing.oscillator", "a copy can be written to", "self.__post_init__()", "pass"),
    Mutant("duffing.melnikov", "sign of the homoclinic velocity", "* osc.delta * lib.tanh(u)", "* -osc.delta * lib.tanh(u)"),
    Mutant("duffing.melnikov", "argument of the Beta function", "(osc.p + 2) / 2, (osc", "(osc.p + 1) / 2, (osc"),
    Mutant("duffing.melnikov", "factor of the forcing integral", "lib.pi * osc.omega / 2 /", "lib.pi * osc.omega /"),
    Mutant("duffing.melnikov", "damping term enters with the wrong sign", "- osc.alpha * damping", "+ osc.alpha * damping"),
    Mutant("duffing.melnikov", "alpha forgotten in mu_c", "osc.alpha * damping_integral(osc) /", "damping_integral(osc) /"),
    Mutant("duffing.integrators.rk4", "weight of the third stage", "cosines[k + 1], cosines[k + 2]", "cosines[k], cosines[k + 2]"),
    Mutant("duffing.integrators.rk4", "sign of the damping", "fma(-friction, v, force)", "fma(friction, v, force)"),
    Mutant("duffing.integrators.rk4", "p forgotten in the tangent's damping", "osc[P, c] * friction", "friction"),
    Mutant("duffing.integrators.rk4", "factor of the cubic stiffness in the tangent", "fma(3.0, stiffness", "fma(1.0, stiffness"),
    Mutant("duffing.integrators.rk4", "Runge-Kutta's last weight", "(1.0 / 6.0)", "(1.0 / 6.001)"),
    Mutant("duffing.integrators.rk4", "side of the second tangent", "where(height >= 0.0, 1.0, -1.0)", "where(height >= 0.0, -1.0, 1.0)"),
    Mutant("duffing.integrators.powers", "one cell of the table off", "_mp.mpf(j) + 0.5", "_mp.mpf(j) + 0.4"),
    Mutant("duffing.integrators.powers", "lost absolute value", "max(abs(v), q.least)\n    cell", "max(v, q.least)\n    cell"),
    Mutant("duffing.integrators.forcing", "phase of the steps' middles", "np.arange(2 * count + 1) / (2 * count)", "np.arange(2 * count + 1) / (2 * count + 1)"),
    Mutant("duffing.integrators.forcing", "cosine beyond the quarter turn", "part > 0.25, -total", "part > 0.25, total"),
    Mutant("duffing.integrators.forcing", "no time under a slow forcing", "(spans > 0) & (spans % GRID == 0)", "spans % GRID == 0", ("tests/test_rk4.py",)),
    Mutant("duffing.integrators.companion", "d0 lost on the way", "if not before.all():", "if i == 0 and not before.all():"),
    Mutant("duffing.integrators.companion", "distance not reset", "apart * (d0 / distance)", "apart"),
    Mutant("duffing.integrators.friction_time.adaptive", "rotation of the second frame", "-np.sin(a)], [np.sin(a)", "np.sin(a)], [-np.sin(a)"),
    Mutant("duffing.integrators.friction_time.adaptive", "shear forgotten in the propagator", "r11 * results[R12]", "0 * results[R12]"),
    Mutant("duffing.integrators.friction_time.tangent_frame", "two tangents' area", "now[ETA2, l] - now[ETA1, l] * now[XI2, l] if", "now[ETA2, l] + now[ETA1, l] * now[XI2, l] if", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.radau", "sign of the relaxation", "h * alpha * _A[i, j] - h * h", "-h * alpha * _A[i, j] - h * h", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.radau", "a passage through zero does not annihilate", "return math.inf\n    for g", "return 0.0\n    for g", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.equations", "factor of phi forgotten", "phi = m * speed", "phi = speed", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.equations", "phase of the forcing", "(osc[START, l] + t)", "t", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.equations", "lost |w|", "logarithm(max(abs(w), 2.0**-1022))", "logarithm(max(w, 2.0**-1022))", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.elementary", "the whole part of the exponent", "fma(q, e, -whole))", "fma(q, e, whole))"),
    Mutant("duffing.integrators.friction_time.dop853", "a stage at the time of the one before", "_NODES[stage], now[T, c]", "_NODES[stage - 1], now[T, c]", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.dop853", "friction time stands where the damping is linear", "new[S, c] = fma(h[c], _NODES[stage], now[S, c])", "new[S, c] = now[S, c]", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.dop853", "short and long form differ in a bit", "np.cumsum(_TABLE, axis=1)[:, -1]", "np.cumsum(_TABLE, axis=1)[:, -1] * (1 + 2**-52)", ("tests/test_lanes.py",)),
    Mutant("duffing.integrators.friction_time.step_control", "rejected steps are taken", "taken = (step[REJECTED, c] == 0.0) & (", "taken = (step[REJECTED, c] >= 0.0) & (", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.step_control", "an error is taken for small", "fits = e <= 1.0", "fits = e <= 1e4", ("tests/test_friction.py",)),
    Mutant("duffing.integrators.friction_time.scheduler", "a lane that moves leaves its parameters behind", "range(0, BLOCK, WIDTH)", "range(0, 8 * WIDTH, WIDTH)", ("tests/test_lanes.py",)),
    Mutant("duffing.integrators.friction_time.event_location", "the last shift the wrong way", "shift * rate[row, l]", "-shift * rate[row, l]", ("tests/test_friction.py", "tests/test_lanes.py")),
    Mutant("duffing.orbits.periodic", "the half map's change of sign", "sign = (-1) ** halves", "sign = 1 ** halves"),
    Mutant("duffing.basins.attractors", "regular motion is chaotic", "np.maximum(3 * spectrum.error, least)", "3 * spectrum.error"),
    Mutant("duffing.basins.attractors", "chaotic attractors without damping", "osc.alpha == 0 or caught", "caught"),
    Mutant("duffing.basins.capture", "a capture one period too early", "done - points.shape[1] + 1 + when", "done - points.shape[1] + when", ("tests/test_attractors.py",)),
    Mutant("duffing.sweep.families", "members come back to other places", "self.result[..., self.members(start)] = array", "self.result[..., start : start + array.shape[-1]] = array"),
    Mutant("duffing.sweep.checkpoint", "a damaged file is trusted", "if seal != _seal(key, content):", "if not seal:"),
    Mutant("vectorized.vectors", "no number chosen otherwise than Python does", "builder.fcmp_ordered(\">\", b, a), b, a", "builder.fcmp_unordered(\">\", b, a), b, a"),
    Mutant("duffing.integrators.friction_time.scheduler", "a lane that has moved steps on with old slopes", "if moved:\n", "if moved and waiting == 0:\n", ("tests/test_friction.py",)),
    Mutant("vectorized.memory", "memory that is not empty", "array, zfill=True)", "array)", ("tests/test_vectors.py",)),
    Mutant("duffing.basins.trapping", "the disk need not shrink", "MARGIN = 0.98", "MARGIN = 1.98"),
    Mutant("duffing.basins.attractors", "an orbit's mirror image forgotten", "[: 1 + (halves % 2 == 0)]", "[:1]"),
    Mutant("duffing.basins.fates", "wells exchanged", "RIGHT, np.where(np.all(x < 0, axis=0), LEFT, crossing)", "LEFT, np.where(np.all(x < 0, axis=0), RIGHT, crossing)", ("tests/test_uncertainty.py", "tests/test_basin_study.py")),
    Mutant("duffing.transients.lifetimes", "a near miss counts as captured", "int(away[-1]) + 1", "int(away[0]) + 1"),
    Mutant("duffing.basins.boundary", "dimension of the line instead of the plane", "Dimension(float(2 - np.polyfit", "Dimension(float(1 - np.polyfit"),
    Mutant("book.studies.survival", "those not captured count as captured", "events, exposure = int(np.sum(settled & late))", "events, exposure = int(np.sum(late))"),
    Mutant("duffing.basins.uncertainty", "dimension of the wrong space", "Dimension(float(2 - slope)", "Dimension(float(1 - slope)"),
    Mutant("duffing.transients.crisis", "inside and outside exchanged", "found, **options) > 0\n", "found, **options) < 0\n"),
    Mutant("book.studies.wandering", "power instead of force times velocity", "np.abs(v) ** (p + 1), dx", "np.abs(v) ** p, dx"),
    Mutant("book.studies.comparison", "regular starts count as chaotic", "mean_ratio(np.where(chaotic, found, 0.0), 1 * chaotic)", "mean_ratio(found, 1 + 0 * chaotic)", ("tests/test_comparison.py",)),
    Mutant("book.studies.comparison", "the lead over the farthest", "float(np.min((exponents[1:]", "float(np.max((exponents[1:]", ("tests/test_comparison.py",)),
    Mutant("book.studies.resonance", "a branch may end anywhere", "if one.end != BOUND:", "if one.end == BOUND + \"x\":"),
    Mutant("book.studies.basins", "strips by fixed steps at small p", "rk4 if p >= 0.5 else", "rk4 if p >= 0.0 else"),
    Mutant("book.studies.basins", "one number of starts for all forcings", "strips(p, ratio, number)", "strips(p, ratio, most[0])"),
    Mutant("book.studies.basins", "the step of all pictures", "picture(1.0, ratio, size=size, steps=n)", "picture(1.0, ratio, size=size)"),
    Mutant("book.studies.basins", "the section beside the axis", "x[:, None], np.zeros(mu.size)", "x[:, None], np.ones(mu.size)"),
    Mutant("book.studies.transients", "captures by all orbits count as those by small ones", "settled & ~large, since", "settled, since"),
    Mutant("book.studies.transients", "those captured soon are at risk too", "found[8, k] = value, late.sum()", "found[8, k] = value, late.size"),
    Mutant("book.studies.transients", "chance of the bound", "np.log(20)", "np.log(2)"),
    Mutant("book.studies.transients", "any orbit round both wells is the large one", "(lived.multiple == 1)", "(lived.multiple > 0)"),
    Mutant("book.studies.transients", "the first flip taken for the fold", "one.kind == FOLD", "one.kind != FOLD"),
    Mutant("book.studies.transients", "periods off by one", "left.argmax(axis=0) + 1", "left.argmax(axis=0)"),
    Mutant("duffing.integrators.friction_time.turning_points", "derivative of the time", "b * r11 * last[R12] + a * r22", "b * r11 * last[R12] - a * r22", ("tests/test_friction.py", "tests/test_tangency.py")),
    Mutant("duffing.flow", "stroboscopic times off by one", "np.arange(checks.count(\"periods\", periods) + 1)", "1 + np.arange(checks.count(\"periods\", periods) + 1)"),
    Mutant("duffing.poincare", "points off by one", "states[:, -periods:]", "states[:, -periods - 1 : -1]"),
    Mutant("duffing.lyapunov", "transient not thrown away", "growth[None, transient:]", "growth[None, :periods]", ("tests/test_companion.py",)),
    Mutant("duffing.lyapunov", "per period instead of per unit time", "history = history / period", "history = history * 1"),
    Mutant("duffing.lyapunov", "exponents in the wrong order", "np.argsort(-history[:, -1]", "np.argsort(history[:, -1]"),
    Mutant("duffing.lyapunov", "errors not reordered with the exponents", "np.take_along_axis(error, order, axis=0)", "error"),
    Mutant("duffing.manifolds.shooting", "the half period's mirror", "-= np.eye(2) if j + 1 < segments else -np.eye(2)", "-= np.eye(2)", ("tests/test_periodic.py", "tests/test_saddle.py")),
    Mutant("duffing.manifolds.saddle", "stable direction not inverted", "[[maps[1, 1, j], -maps[0, 1, j]]", "[[maps[1, 1, j], maps[0, 1, j]]"),
    Mutant("duffing.manifolds.saddle", "multipliers swapped", "np.array([unstable, np.exp(log_area) / unstable])", "np.array([np.exp(log_area) / unstable, unstable])"),
    Mutant("duffing.manifolds.curves", "launch on the wrong side", "offset = side *", "offset = -side *"),
    Mutant("duffing.manifolds.curves", "flight in the wrong sense", "section - flight if kind == UNSTABLE", "section + flight if kind == UNSTABLE"),
    Mutant("duffing.manifolds.tangency", "sign of the splitting", "(unstable - stable).reshape", "(stable - unstable).reshape"),
    Mutant("duffing.manifolds.tangency", "least instead of greatest splitting", "height.argmax(axis=0)", "height.argmin(axis=0)"),
    Mutant("duffing.manifolds.tangency", "W^S followed backward through creeps", "(osc.p < 0.5) & (osc.alpha > 0)", "(osc.p < 0.05) & (osc.alpha > 0)", ("tests/test_threshold.py",)),
    Mutant("duffing.manifolds.passage", "over the hump for back into the well", "return -across * np.exp", "return across * np.exp", ("tests/test_threshold.py",)),
    Mutant("duffing.manifolds.passage", "turned back, but not yet seen as fallen", "(~entered & (orbit.states[1, 1:] > 0))", "(~entered & (orbit.states[1, 1:] > 9))", ("tests/test_threshold.py",)),
    Mutant("duffing.manifolds.threshold", "sign of the splitting", "crossing(frame, each, member) - threshold(frame, each, member)", "threshold(frame, each, member) - crossing(frame, each, member)", ("tests/test_threshold.py",)),
    Mutant("duffing.manifolds.threshold", "no zoom on the greatest", "_ZOOMS = 8", "_ZOOMS = 0", ("tests/test_threshold.py",)),
    Mutant("book.studies.dry_friction", "released where the force falls", "phase = -direction * math.acos(cosine)", "phase = direction * math.acos(cosine)", ("tests/test_threshold.py",)),
    Mutant("duffing.manifolds.correction", "the return forgotten", "for y in (leaving, -leaving):", "for y in (leaving,):", ("tests/test_tangency.py",)),
    Mutant("duffing.manifolds.sticking", "bracket's wrong end", "low, high = np.where(stuck, middle, low), np.where(stuck, high, middle)", "low, high = np.where(stuck, low, middle), np.where(stuck, middle, high)", ("tests/test_saddle.py",)),
    Mutant("book.studies.reproduction", "stroboscopic points off by one", "path[:, kept::kept]", "path[:, 1 + kept :: kept]"),
    Mutant("book.studies.reproduction", "onset below the threshold", "chaotic = exponents > threshold\n", "chaotic = exponents > 0.5 * threshold\n"),
    Mutant("book.remember", "results may be written into", "result.flags.writeable = False", "pass"),
    Mutant("book.figures.style", "transient and steady colours swapped", "TRANSIENT, STEADY = SKY, VERMILION", "TRANSIENT, STEADY = VERMILION, SKY"),
)  # a line each  # fmt: skip


def apply(mutant, root):
    """Put the error into the copy; returns the file's good text."""
    path = root / f"{mutant.module.replace('.', '/')}.py"
    text = path.read_text(encoding="utf-8")
    if text.count(mutant.good) != 1:
        raise ValueError(f"{mutant.module}: {mutant.good!r} must occur once, not {text.count(mutant.good)} times")
    path.write_text(text.replace(mutant.good, mutant.bad), encoding="utf-8")
    return path, text


def first_failure(root, files):
    """Name of the first test that fails, or None; a suite that cannot even be collected has failed."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "--no-header", "--tb=no", "-p", "no:cacheprovider", *files]
    # Found first, so that the installed package is not the one tested.
    environment = {**os.environ, "PYTHONPATH": str(root)}
    try:
        run = subprocess.run(
            command, cwd=root, env=environment, capture_output=True, text=True, timeout=PATIENCE, encoding="utf-8"
        )
    except subprocess.TimeoutExpired:
        return f"the tests do not end within {PATIENCE} s"
    if run.returncode == 0:
        return None
    found = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", run.stdout, re.M)
    return found[1] if found else f"pytest ended with {run.returncode}"


def main(modules):
    if unknown := set(modules) - {mutant.module for mutant in MUTANTS}:
        sys.exit(f"{', '.join(sorted(unknown))}: no deliberate error is listed for it")
    chosen = [mutant for mutant in MUTANTS if not modules or mutant.module in modules]
    survivors, sound = 0, set()
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        listed = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]  # a new module, too
        for name in subprocess.check_output(listed, cwd=ROOT, text=True, encoding="utf-8").splitlines():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, root / name)
        for mutant in chosen:
            own = f"tests/test_{mutant.module.rpartition('.')[2]}.py"
            caught = None
            for files in filter(None, (mutant.tests or ((own,) if (root / own).exists() else ()), SUITE)):
                # A test that the copy fails without an error would be said to catch each.
                if files not in sound and (broken := first_failure(root, files)):
                    sys.exit(f"the tests are red before any error is made: {broken}")
                sound.add(files)
                path, good = apply(mutant, root)
                caught = first_failure(root, files)
                path.write_text(good, encoding="utf-8")
                if caught:
                    break
            survivors += caught is None
            print(f"{mutant.module:45} {mutant.what:50} {caught or 'SURVIVED'}", flush=True)
    print(f"{len(chosen) - survivors} of {len(chosen)} caught")
    return survivors


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
