"""A stored record of measured ratios, as `make bench` writes it, turned into the arrays and rows that a page shows."""

import json
from pathlib import Path

import numpy as np

C_OVER_LANES = "C over lanes, gcc with libmvec"  # its name in the record


RECORD = Path(__file__).with_suffix(".json")  # the dated measurement that `make record` leaves, installed with the book


def record(path=RECORD):
    """The record in the JSON file at path: a dictionary with date, processor, versions and what was measured."""
    return json.loads(Path(path).read_text(encoding="utf-8"))


def medians(record, exponents=(0.1, 1.0)):
    """(names, dict p -> (n,) median times over the kernel's), nan where a variant gave no right answer."""
    tables = {p: record["sweep"][f"{p:g}"] for p in exponents}
    names = list(next(iter(tables.values())))
    return names, {p: np.array([table[name].get("median", np.nan) for name in names]) for p, table in tables.items()}


def sweep_rows(record, exponents=(0.1, 1.0)):
    """Rows (name, a cell for each exponent) of the paper's sweep: median and range, or what happened instead."""
    names, _ = medians(record, exponents)
    return [(name, *(cell(record["sweep"][f"{p:g}"][name]) for p in exponents)) for name in names]


def error_rows(record):
    """Rows (problem, error, a cell for each method) of the times to an error, and the methods: (methods, rows)."""
    problems = record["precision"]
    methods = list(dict.fromkeys(name for found in problems.values() for by in _errors(found).values() for name in by))
    methods = [name for name in methods if name != "friction time"]
    rows = []
    for key, found in problems.items():
        problem = "$p = {}$, {}".format(*key.split(", "))
        for error, by in _errors(found).items():
            cells = [cell(by[name]) if name in by else "" for name in methods]
            rows.append((problem, f"$10^{{{round(np.log10(float(error)))}}}$", *cells))
    return methods, rows


def growth_series(record):
    """dict (label, axis scale) -> dict kernel -> (values, costs), for the series that stand on an axis."""
    labels = {
        "trajectories": ("trajectories", "log"),
        "periods": ("forcing periods", "log"),
        "p": ("damping exponent $p$", "linear"),
        "tolerance": ("relative tolerance", "log"),
    }
    series = {}
    for name, costs in record["growth"].items():
        kernel, _, what = name.partition(", ")
        if what in labels:
            curve = np.array([float(value) for value in costs]), np.array(list(costs.values()))
            series.setdefault(labels[what], {})[kernel] = curve
    return series


def cell(entry):
    """ "median (least to greatest)" of one entry of the record, or its remark."""
    if "median" not in entry:
        return entry["remark"]
    return f"{short(entry['median'])} ({short(entry['least'])} to {short(entry['greatest'])})"


def _errors(found):
    return {key: value for key, value in found.items() if isinstance(value, dict)}


def short(value):
    """Three significant digits from 1 on, two below."""
    return f"{float(f'{value:.3g}'):g}" if value >= 1 else f"{value:.2g}"
