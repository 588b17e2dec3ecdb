"""What the studies' commands share: how many runs, where, and the file they write."""

import argparse
import json
import platform
import sys
from functools import partial
from importlib.metadata import version
from pathlib import Path

from slamlab.parallel import RunError

TABLES = Path(__file__).parent.parent / "data" / "studies"


def parser(name, runs):
    """The command line of a study.

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
    """Seeds 0 to runs − 1.

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


def made_with():
    """Versions that a table depends on, by name."""
    return {"python": platform.python_version()} | {
        name: version(name) for name in ("slamlab", "numpy", "scipy")
    }


def rounded(table):
    """Rows of plain numbers with four places, by name."""
    return {
        name: {key: round(float(value), 4) for key, value in numbers.items()}
        for name, numbers in table.items()
    }


def main(name, runs, study, words=None):
    """The whole command of a study that needs to know no more than how many runs, and where.

    Parameters
    ----------
    name : str, of its module and of the file it writes
    runs : int, the default
    study : callable(runs, jobs=, scheduler=) -> dict, the table
    words : list of str, the command's arguments; those of this process by default

    Returns
    -------
    int, what the command ends with: 0 when written, 2 when something is wrong with what was asked
    """
    words = sys.argv[1:] if words is None else words
    command = parser(name, runs)
    asked = command.parse_args(words)
    make = partial(study, asked.runs, jobs=asked.jobs, scheduler=asked.scheduler)
    return write(command.prog, words, asked.out, make)


def write(prog, words, out, make):
    """Make a table and write it with its command, or say in one line why not.

    Parameters
    ----------
    prog : str
    words : list of str, the command's arguments
    out : Path
    make : callable() -> dict

    Returns
    -------
    int, what the command ends with
    """
    try:
        table = {"command": " ".join([prog, *words])} | make()
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
