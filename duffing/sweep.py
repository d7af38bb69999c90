"""Families over cores or a cluster: cut into blocks, mapped, and put together again."""

from dataclasses import fields, replace

import numpy as np

BLOCK = 256  # members: some milliseconds of work even for the cheapest kernel, far above the cost of a task


def over_blocks(function, osc, state, options, executor=None, progress=None):
    """function(osc, state, **options) over a family of N members, block by block.

    state : (2, N); function returns an array whose last axis is the members' (N long)
    executor : any concurrent.futures executor; None runs here, on the integrators' own threads
    progress : called as progress(done, total) with numbers of members after each block; None is silent

    Returns the concatenated array, the same bit for bit whatever the executor.
    """
    if executor is None and progress is None:
        return function(osc, state, **options)
    total = state.shape[1]
    columns = osc.columns()
    names = [field.name for field in fields(osc)]
    futures, results = [], []
    for start in range(0, total, BLOCK):
        members = slice(start, min(start + BLOCK, total))
        part = replace(osc, **dict(zip(names, columns[:, members], strict=True)))
        if executor is None:
            results.append(function(part, state[:, members], **options))
            progress(members.stop, total)
        else:
            futures.append((members.stop, executor.submit(function, part, state[:, members], **options)))
    for done, future in futures:
        results.append(future.result())
        if progress is not None:
            progress(done, total)
    return np.concatenate(results, axis=-1)
