"""Command line of the studies: number of runs, number of processes, and the JSON file to write."""

import argparse
import json
import platform
import sys
from dataclasses import is_dataclass
from functools import partial
from importlib.metadata import version
from pathlib import Path

import numpy as np

import slamlab
from slamlab.parallel import RunError

TABLES = Path(__file__).parent  # the stored tables
STORED_RUNS = 3  # whose numbers stand in a table, beside those of all runs


def stored(name):
    """Load the stored table of a study's module."""
    return json.loads((TABLES / f"{name}.json").read_text(encoding="utf-8"))


def parser(name, runs):
    """Make the argument parser for the command of a study, which writes the table of that name."""
    made = argparse.ArgumentParser(prog=f"python -m course.studies.{name}")
    made.add_argument("--runs", type=int, default=runs, help=f"number of runs (default: {runs})")
    made.add_argument("--jobs", type=int, help="number of processes (default: all cores)")
    made.add_argument(
        "--scheduler", help="Dask scheduler to use instead of processes, tcp://host:port"
    )
    made.add_argument("--out", type=Path, default=TABLES / f"{name}.json", help="file to write")
    return made


def seeds(runs, least=3):
    """Return random seeds 0 to runs − 1; raise ValueError if runs < least."""
    if runs < least:
        raise ValueError(f"--runs must be at least {least}, not {runs}")
    return range(runs)


def package_versions():
    """Return the package versions that a table depends on, by name."""
    ours = {"python": platform.python_version(), "slamlab": slamlab.__version__}
    return ours | {name: version(name) for name in ("numpy", "scipy")}


def rounded(table):
    """Round the numbers in a table, {name: row of numbers}, to four decimals."""
    return {
        name: {key: round(float(value), 4) for key, value in numbers.items()}
        for name, numbers in table.items()
    }


def first_runs(results):
    """Return the numbers of the first three runs, so that they can be made again and compared.

    Parameters
    ----------
    results : list, by run nested dicts, sequences and dataclasses of numbers and arrays

    Returns
    -------
    list of {names: number}; for an array, the RMS of its finite numbers
    """
    return [dict(_numbers(result)) for result in results[:STORED_RUNS]]


def _numbers(found, name=""):
    if is_dataclass(found):
        found = vars(found)
    elif isinstance(found, (tuple, list)):
        found = dict(enumerate(found))
    if isinstance(found, dict):
        for key, each in found.items():
            yield from _numbers(each, f"{name} / {key}".removeprefix(" / "))
    elif found is not None:
        finite = np.ravel(found)[np.isfinite(np.ravel(found).astype(float))]
        if len(finite):
            number = finite[0] if np.ndim(found) == 0 else np.sqrt(np.mean(finite**2))
            yield name, float(f"{number:.6g}")


def main(name, runs, study, argv=None):
    """Run the command of a study, whose function ``study(runs, jobs=, scheduler=)`` returns the
    table; return the exit code."""
    argv = sys.argv[1:] if argv is None else argv
    command = parser(name, runs)
    options = command.parse_args(argv)
    make = partial(study, options.runs, jobs=options.jobs, scheduler=options.scheduler)
    return write(command.prog, argv, options.out, make)


def write(prog, argv, out, make):
    """Write the table that make() returns, with its command, as JSON, or print the error; return
    the exit code."""
    try:
        table = {"command": " ".join([prog, *argv])} | make()
        out.parent.mkdir(parents=True, exist_ok=True)
        text = json.dumps(table, indent=1, ensure_ascii=False)
        out.write_text(text + "\n", encoding="utf-8")
    except (ValueError, RunError, OSError) as error:
        print(f"{prog}: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    print(text)
    return 0
