"""Unsupported file formats, which ``unsupported_formats.tsv`` lists with a remedy for each.

A pattern matches the beginning of a file or of a line, or the number of columns of a table.
"""

import re
from pathlib import Path

TABLE = Path(__file__).with_suffix(".tsv")
CONVERT = "convert it to a ROS bag, a CARMEN log or a table angle_deg,distance_mm"
FIRST_LINES, MAX_QUOTED = 30, 60  # lines that are checked, characters that are quoted


def describe(head):
    """Describe the format of a file that begins with these bytes, and what the user can do."""
    if found := _row("file", head):
        return f"looks like {found[0]}: {found[1]}"
    if b"\0" in head[:1000]:
        return f"has an unknown binary format: {CONVERT}"
    lines = [line.strip() for line in head.splitlines() if line.strip()]
    first = f"line 1 is {_quoted(lines[0])}" if lines else "it has no lines"
    for line in lines[:FIRST_LINES]:
        if found := _row("line", line) or _row("columns", _columns(line)):
            return f"looks like {found[0]} ({first}): {found[1]}"
    return f"is text of an unknown format ({first}): {CONVERT}"


def is_binary(head):
    """Return whether a file has a binary format of the table, such as an archive with a log."""
    return b"\0" in head[:1000] and _row("file", head) is not None


def _row(place, text):
    """Return the format and the remedy of the first row whose pattern matches, or None."""
    for line in TABLE.read_text("utf-8").splitlines():
        where, pattern, *found = line.split("\t")
        if where == place and re.match(pattern.encode(), text, re.DOTALL):
            return found
    return None


def _columns(line):
    """Return the number of columns of a line of numbers, as bytes, or b""."""
    words = line.replace(b",", b" ").replace(b";", b" ").split()
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        return b""
    return b"%d" % len(numbers) if len(numbers) > 1 else b""


def _quoted(line):
    text = line.decode("utf-8", "replace")
    return repr(text if len(text) <= MAX_QUOTED else text[:MAX_QUOTED] + "…")
