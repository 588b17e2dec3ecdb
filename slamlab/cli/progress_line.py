"""Progress line of a run on the terminal."""

import sys
import time
from contextlib import contextmanager

INTERVAL = 0.1  # between two redrawn lines [s]


@contextmanager
def progress_line(total=0, what="running"):
    """Yield a function that counts one of ``total`` steps, or sets the count; 0 means unknown.

    The progress line appears only if stderr is a terminal, and it is erased at the end.
    """
    count, line, due, shown = 0, "", 0.0, sys.stderr.isatty()

    def advance(to=None):
        nonlocal count, line, due
        count = count + 1 if to is None else to
        if shown and time.monotonic() >= due:
            line = f"{what}: {100 * count // total} %" if total else f"{what}: {count} readings"
            print(f"\r{line}", end="", file=sys.stderr, flush=True)
            due = time.monotonic() + INTERVAL

    try:
        yield advance
    finally:
        if line:
            print(f"\r{' ' * len(line)}\r", end="", file=sys.stderr, flush=True)
