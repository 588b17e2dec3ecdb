"""Benchmark utilities: interleaved timing, rows, the table, the command line.

A benchmark is a module with ``TITLE`` and ``run(quick) -> rows``. Compare only ratios from one run:
methods are timed in turn, so that the machine's load affects all of them equally.
"""

import argparse
import json
import statistics
import sys
import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

from slamlab.files import SourceError

# shortest turn of a method: in its first milliseconds its code and data are not in the caches,
# which would be a tenth of a short call's time [s]
TURN = 0.02


def row(name, value, unit, reference, ratio):
    """Make one row of a benchmark's result.

    Parameters
    ----------
    name : str, what was measured
    value : float
    unit : str
    reference : str, what it is compared with
    ratio : float, how many times better than the reference (faster, or smaller in error)

    Returns
    -------
    dict
    """
    ratio = float(ratio)
    return dict(name=name, value=float(value), unit=unit, reference=reference, ratio=ratio)


def cpu_times(methods, quick, seconds=6.0):
    """Measure the median CPU time of each method's call; the methods take turns.

    Parameters
    ----------
    methods : {name: function without arguments}, which the caller has checked for equal results
    quick : bool, True for an eighth of the time
    seconds : float, CPU time to spend, at least three turns each (one when quick) [s]

    Returns
    -------
    {name: float} [s]
    """
    samples = {name: [] for name in methods}
    least, seconds = (1, seconds / 8) if quick else (3, seconds)
    begin = time.process_time()
    while len(next(iter(samples.values()))) < least or time.process_time() - begin < seconds:
        for name, method in methods.items():
            samples[name].append(_turn(method))
    return {name: statistics.median(values) for name, values in samples.items()}


def _turn(method):
    """Measure the mean CPU time of the calls in one turn [s]."""
    start, calls = time.process_time(), 0
    while True:
        method()
        calls += 1
        spent = time.process_time() - start
        if spent >= TURN:
            return spent / calls


def speed_rows(label, times, compared=()):
    """Make rows that compare each method's time with that of the first method, and some with
    others.

    Parameters
    ----------
    label : str, the case
    times : {method: float} [s], the reference first
    compared : (method, reference) pairs; those without a time are skipped

    Returns
    -------
    list of rows, in milliseconds
    """
    first = next(iter(times))
    pairs = [(method, first) for method in times]
    pairs += [pair for pair in compared if times.keys() >= set(pair)]
    return [
        row(f"{label}: {m}", 1e3 * times[m], "ms", reference, times[reference] / times[m])
        for m, reference in pairs
    ]


def table(title, rows):
    """Print rows as a table."""
    shown = Table(title=title)
    shown.add_column("name")
    shown.add_column("value", justify="right")
    shown.add_column("unit")
    shown.add_column("reference")
    shown.add_column("ratio", justify="right")
    for r in rows:
        ratio = f"{r['ratio']:.3g} x"
        shown.add_row(r["name"], f"{r['value']:.4g}", r["unit"], r["reference"], ratio)
    Console().print(shown)


class Missing(Exception):
    """A peer of a benchmark is not installed; the message states how to install it."""


def main(benchmarks, prog, argv=None, last=None):
    """Run the command line of one or more benchmarks.

    Parameters
    ----------
    benchmarks : {title: run}, with run(quick) -> rows
    prog : str, name of the command
    argv : list of str or None for the process' own
    last : function of all rows, called after the last table

    Returns
    -------
    int, exit code: 0 done, 2 a benchmark was skipped, or broke off, or the file cannot be written
    """
    parser = argparse.ArgumentParser(prog=prog, description=", ".join(benchmarks))
    parser.add_argument("--json", type=Path, metavar="FILE", help="file to write the rows to")
    parser.add_argument(
        "--quick", action="store_true", help="fewer repetitions, less than 40 s per benchmark"
    )
    options = parser.parse_args(argv)
    rows, code = [], 0
    if not _stored(options.json, rows):
        return 2
    for title, run in benchmarks.items():
        try:
            found = run(options.quick)
        except (Missing, SourceError) as error:
            print(f"skipped: {title}: {error}", file=sys.stderr)
            code = 2
            continue
        table(title, found)
        rows += found
        if not _stored(options.json, rows):
            code = 2
    if last is not None:
        last(rows)
    return code


def _stored(file, rows):
    """Write rows if a file is given, after each benchmark, so that none is lost if one fails."""
    try:
        if file:
            file.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    except OSError as error:
        print(f"cannot write {file}: {error.strerror}", file=sys.stderr)
        return False
    return True
