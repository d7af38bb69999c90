"""Blocks of members that a kernel can advance side by side: with one law of damping and one table of the forcing.

The table holds cos(omega t) on the grid of steps. Phases are counted in turns and rounded once, and the cosine is
spelled out, so that it is the same on any machine and for every start that is later by whole periods.
"""

from concurrent.futures import ThreadPoolExecutor

import mpmath
import numpy as np

from .powers import power

# Below this speed |v|^(p-1) is held for p < 1: damping stays 0 at v = 0, the tangent's singularity finite.
LEAST_SPEED = 2.0**-50
# Forcing phases are rounded to 1/GRID turns: equal phases are then seen as equal, and none drifts over many periods.
GRID = 2.0**40

# Taylor coefficients of cos(2 pi u) in u^2: on a quarter turn the next one is below 1e-18.
with mpmath.workprec(100):
    _COSINE = tuple(float((-4 * mpmath.pi**2) ** k / mpmath.factorial(2 * k)) for k in range(13))


def map_chunks(run, columns, t, steps_per_period, threads, lanes, width):
    """Call run(members, padded, h, law, forcing) for blocks of members with one p and one sequence of forcing phases.

    Parameters
    ----------
    run : called on up to `threads` threads at once with the block's members, at most `lanes` indices; the same
        repeated up to a multiple of `width`; their steps h (n - 1, padded); |v|^(p-1) set up for `powers.evaluate`,
        None for p = 1; and the forcing as (cosines, offsets, counts): interval i has counts[i] steps, with
        cos(omega t) at their ends and middles from cosines[offsets[i]] on
    columns : (6, N) parameters as from `Duffing.columns`
    t : (n, 1) for all members or (n, N), increasing times; each interval is cut into the least number of equal steps
    steps_per_period : the least number of steps in a forcing period 2 pi / omega

    Raises ValueError for a p so large (about 200) that |v|^(p-1) has no table of reasonable size.
    """
    # With common times only the frequencies tell the members' clocks apart.
    own = t.shape[1] > 1
    omega, clock = (columns[3], np.arange(columns.shape[1])) if own else np.unique(columns[3], return_inverse=True)
    h, kinds, forcings = _steps(omega, t, steps_per_period)
    groups = {}
    for member, key in enumerate(zip(columns[1], kinds[clock], strict=True)):
        groups.setdefault(key, []).append(member)

    def run_block(p, kind, members):
        padded = np.resize(members, -(-len(members) // width) * width)
        run(members, padded, np.ascontiguousarray(h[:, clock[padded]]), _damping_law(p), forcings[kind])

    blocks = [(*key, np.array(m[i : i + lanes])) for key, m in groups.items() for i in range(0, len(m), lanes)]
    if len(blocks) == 1:  # in the caller's thread, where Ctrl-C reaches it
        return run_block(*blocks[0])
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(run_block, *zip(*blocks, strict=True)))


def _damping_law(p):
    try:
        return None if p == 1 else power(p - 1, LEAST_SPEED if p < 1 else 2.0**-1022)
    except ValueError:
        raise ValueError(f"p = {p}: must be below about 200, where |v|^(p-1) has a table of reasonable size") from None


def _steps(omega, t, steps_per_period):
    """For each clock the steps h (n - 1, clocks) and the index of its forcing in a list of different forcings."""
    turns = t * omega / (2 * np.pi)
    # A millionth of a step of slack: round-off in the times must not add a step.
    counts = np.maximum(np.ceil(np.diff(turns, axis=0) * steps_per_period - 1e-6), 1).astype(int)
    phases = np.rint(turns * GRID)
    spans = np.diff(phases, axis=0)
    # Whole periods are whole whatever the round-off in t: their step is the same at any time.
    lengths = np.where((spans > 0) & (spans % GRID == 0), spans / GRID * (2 * np.pi / omega), np.diff(t, axis=0))
    known, kinds, forcings = {}, [], []
    for c in range(len(omega)):
        key = (phases[:-1, c] % GRID).tobytes() + spans[:, c].tobytes() + counts[:, c].tobytes()
        if key not in known:
            known[key] = len(forcings)
            forcings.append(_forcing(phases[:-1, c], spans[:, c], np.ascontiguousarray(counts[:, c])))
        kinds.append(known[key])
    return lengths / counts, np.array(kinds, dtype=int), forcings


def _forcing(phases, spans, counts):
    """cos(omega t) at the ends and middles of all steps, the place of each interval in that table, and its steps."""
    tables, offsets, known, length = [np.empty(0)], [], {}, 0
    for interval in zip(phases % GRID, spans, counts, strict=True):
        if interval not in known:
            start, turn, count = interval
            known[interval] = length
            tables.append(_cosine_of_turns((start + turn * (np.arange(2 * count + 1) / (2 * count))) / GRID))
            length += 2 * count + 1
        offsets.append(known[interval])
    return np.concatenate(tables), np.array(offsets, dtype=int), counts


def _cosine_of_turns(turns):
    """cos(2 pi turns) by its Taylor series up to a quarter turn: a library's cosine differs between machines."""
    part = np.abs(turns - np.rint(turns))
    z = np.minimum(part, 0.5 - part) ** 2
    total = 0.0
    for coefficient in reversed(_COSINE):
        total = total * z + coefficient
    return np.where(part > 0.25, -total, total)
