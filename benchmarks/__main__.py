"""Side by side with other software: python -m benchmarks [--quick] [--record FILE], or make bench.

Prints ratios only: times depend on the machine. What is not installed is named and left out.
"""

import argparse
import json
import os
import platform
import shutil
import subprocess
import sys
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from . import floor, growth, precision, sweep

SOFTWARE = ("numpy", "scipy", "numba", "llvmlite", "pynamicalsys", "diffrax", "jax", "jitcode", "heyoka")


def main(arguments=None):
    """Measure, print, and write the record where one is asked for."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument(
        "--quick", action="store_true", help="two rounds of small families: a minute or two, less certain"
    )
    parser.add_argument("--record", type=Path, help="write what was measured to this JSON file, with date and versions")
    options = parser.parse_args(arguments)
    rounds, size = (2, 64) if options.quick else (5, 512)
    record = circumstances(rounds)
    for line in ("date", "processor", "compiler"):
        print(f"{line}: {record[line]}")
    print("versions:", ", ".join(f"{name} {number}" for name, number in record["versions"].items()))
    with_one_processor(lambda: alone(record, rounds, size, options.quick))
    record["growth"] = growth.measure(min(rounds, 3), options.quick)
    print("\nHow cost grows")
    for name, costs in record["growth"].items():
        kernel, _, series = name.partition(", ")
        print(f"  {kernel}, {growth.TITLES[series]}:")
        print("    " + "   ".join(f"{value:g}: {cost:.3g}" for value, cost in costs.items()))
    if options.record:
        options.record.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def alone(record, rounds, size, quick):
    """What is measured on one processor: the sweep, its floor, the time to an error. Printed, and put in the record."""
    record |= {"sweep": {}, "floor": {}, "precision": {}}
    for p in (0.1, 1.0):
        print(f"\nThe paper's sweep, p = {p}: time for a trajectory and period over the kernel's; median (range)")
        results = sweep.measure(p, rounds, size)
        show(results)
        record["sweep"][f"{p:g}"] = {result.name: result.record() for result in results}
        share, powers = floor.measure(p, rounds, size)
        print(f"  The floor, the arithmetic alone: {share:.0%} of the kernel's time, of which powers {powers:.0%}")
        record["floor"][f"{p:g}"] = {"share": round(share, 2), "powers": round(powers, 2)}
    cases = [(0.1, False)] if quick else [(0.1, False), (0.5, False), (1.0, False), (1.0, True)]
    for p, tangent in cases:
        what = "state and tangent" if tangent else "state"
        print(f"\nTime to an error of the {what}, p = {p}, over that in friction time; median (range)", flush=True)
        found, confirmed = precision.measure(p, tangent, rounds)
        record["precision"][f"{p:g}, {what}"] = {
            "reference confirmed to": float(f"{confirmed:.1g}"),
            **{f"{error:.0e}": {r.name: r.record() for r in results} for error, results in found.items()},
        }
        for error, results in found.items():
            print(f" error {error:.0e}")
            show(results[1:])


def show(results):
    """A line a result."""
    for result in results:
        print(f"  {result.name:32} {result.summary()}", flush=True)


def circumstances(rounds):
    """Date, machine and versions."""
    return {
        "what": "A stored measurement, not computed when the book is built. All numbers are ratios of times.",
        "date": f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC",
        "processor": processor(),
        "system": f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors",
        "compiler": compiler(),
        "rounds": rounds,
        "versions": {"python": platform.python_version()} | versions(),
    }


def versions():
    """Of what takes part and is installed: dict."""
    found = {}
    for name in SOFTWARE:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def processor():
    """The processor's model, as the system names it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def compiler():
    """The first line with which gcc names itself."""
    gcc = shutil.which("gcc")
    return subprocess.check_output([gcc, "--version"], text=True, encoding="utf-8").splitlines()[0] if gcc else "no gcc"


def with_one_processor(measure):
    """Run on one processor where the system can hold a process to one: nobody gains by threads of its own."""
    if not hasattr(os, "sched_setaffinity"):
        return measure()
    all_of_them = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(all_of_them)})
    try:
        return measure()
    finally:
        os.sched_setaffinity(0, all_of_them)


if __name__ == "__main__":
    sys.exit(main())
