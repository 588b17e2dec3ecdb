"""Command line shared by the studies: number of runs, processes, and the JSON file they write."""

import argparse
import json
import platform
import sys
from functools import partial
from importlib.metadata import version
from pathlib import Path

from slamlab.parallel import RunError

TABLES = Path(__file__).parent.parent / "data" / "studies"  # the stored tables


def stored(name):
    """The stored table of a study.

    Parameters
    ----------
    name : str, of the study's module

    Returns
    -------
    dict
    """
    return json.loads((TABLES / f"{name}.json").read_text(encoding="utf-8"))


def parser(name, runs):
    """Argument parser of a study's command line.

    Parameters
    ----------
    name : str, of its module and of the file it writes
    runs : int, the default

    Returns
    -------
    argparse.ArgumentParser
    """
    made = argparse.ArgumentParser(prog=f"python -m slamlab.studies.{name}")
    made.add_argument("--runs", type=int, default=runs, help=f"how many runs ({runs})")
    made.add_argument("--jobs", type=int, help="processes, every core by default")
    made.add_argument("--scheduler", help="a Dask scheduler in their place, tcp://host:port")
    made.add_argument("--out", type=Path, default=TABLES / f"{name}.json", help="the file to write")
    return made


def seeds(runs, least=3):
    """Random seeds 0 to runs − 1.

    Parameters
    ----------
    runs, least : int

    Returns
    -------
    range

    Raises
    ------
    ValueError : fewer runs than the least of which a table can be made
    """
    if runs < least:
        raise ValueError(f"--runs is at least {least}, not {runs}")
    return range(runs)


def package_versions():
    """Package versions that a table depends on, by name."""
    return {"python": platform.python_version()} | {
        name: version(name) for name in ("slamlab", "numpy", "scipy")
    }


def rounded(table):
    """Round: rows of plain numbers with four decimals, by name."""
    return {
        name: {key: round(float(value), 4) for key, value in numbers.items()}
        for name, numbers in table.items()
    }


def main(name, runs, study, argv=None):
    """Run a study's command line, for a study with no options of its own.

    Parameters
    ----------
    name : str, of its module and of the file it writes
    runs : int, the default
    study : callable(runs, jobs=, scheduler=) -> dict, the table
    argv : list of str, the command's arguments; those of this process by default

    Returns
    -------
    int, what the command ends with: 0 when written, 2 when something is wrong with what was asked
    """
    argv = sys.argv[1:] if argv is None else argv
    command = parser(name, runs)
    asked = command.parse_args(argv)
    make = partial(study, asked.runs, jobs=asked.jobs, scheduler=asked.scheduler)
    return write(command.prog, argv, asked.out, make)


def write(prog, argv, out, make):
    """Write a table as JSON with its command, or say in one line why not.

    Parameters
    ----------
    prog : str
    argv : list of str, the command's arguments
    out : Path
    make : callable() -> dict

    Returns
    -------
    int, what the command ends with
    """
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
