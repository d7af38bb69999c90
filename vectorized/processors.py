"""How many threads serve a process: the processors that it may use, not those that the machine has.

A batch system or a container gives a process some of them: by affinity, or as a share of time (Linux's control groups).
More threads than that take turns, and a share that is used up stops them all.
"""

import math
import os
from functools import cache
from pathlib import Path

GROUPS = Path("/sys/fs/cgroup")


def available():
    """The number of processors that this process may use, at least one."""
    if hasattr(os, "process_cpu_count"):  # Python 3.13 and later
        count = os.process_cpu_count()
    elif hasattr(os, "sched_getaffinity"):  # Linux
        count = len(os.sched_getaffinity(0))
    else:
        count = os.cpu_count()
    return max(1, math.ceil(min(count or 1, quota())))


@cache
def quota():
    """Processors' worth of time that all control groups of this process leave it; infinity without a limit."""
    return min(map(share, folders()), default=math.inf)


def folders(groups=GROUPS, own=Path("/proc/self/cgroup")):
    """The control groups that limit this process, its own and those above it, in both of Linux's forms."""
    try:
        lines = own.read_text(encoding="utf-8").splitlines()
    except OSError:
        return []
    found = []
    for line in lines:
        _, kinds, path = line.split(":", 2)
        if kinds == "" or "cpu" in kinds.split(","):
            top = groups / kinds if kinds else groups
            below = top.joinpath(*Path(path).parts[1:])
            found += [below, *(folder for folder in below.parents if folder.is_relative_to(top))]
    return found


def share(folder):
    """Processors' worth of time that a control group may use; infinity where it sets no limit."""
    try:
        if (folder / "cpu.max").is_file():
            quota, period = (folder / "cpu.max").read_text(encoding="utf-8").split()
        else:
            quota = (folder / "cpu.cfs_quota_us").read_text(encoding="utf-8")
            period = (folder / "cpu.cfs_period_us").read_text(encoding="utf-8")
        return int(quota) / int(period) if int(quota) > 0 else math.inf
    except (OSError, ValueError):  # no such limit, or "max"
        return math.inf
