"""Parse the file names of Moodle and Canvas downloads.

Moodle:  Ana Kos_123_assignsubmission_file/…  or, without folders, …_file_NAME
Canvas:  kosana_1021_55031_NAME  or  kosana_LATE_1021_55031_NAME

Moodle removes underscores from full names, and Canvas removes text that resembles its numbers.
Therefore, the first number after an underscore is from the LMS. Later numbers belong to the file's
name, which students choose.
"""

import re
from dataclasses import dataclass

MOODLE, CANVAS = "Moodle", "Canvas"
_MOODLE = re.compile(
    r"(?P<prefix>(?P<student>[^_]+)_(?P<number>\d+)_assignsubmission_[a-z]+)_?(?P<file>.*)", re.S
)
_CANVAS = re.compile(
    r"(?P<prefix>(?P<student>(?:(?!_\d+_).)+?)(?P<late>_LATE)?_(?P<number>\d+)_\d+)_(?P<file>.+)",
    re.S,
)


@dataclass(frozen=True)
class LmsName:
    """The parts of a file or folder name in a download."""

    lms: str  # MOODLE or CANVAS
    student: str  # the student's name in the file name
    number: str  # the participant in this assignment (Moodle) or the user (Canvas)
    prefix: str  # before the student's file name; feedback files need the same prefix
    file: str  # as named by the student; "" for a folder
    late: bool = False  # whether Canvas marked it as late


def lms_name(name):
    first, slash, _ = name.partition("/")
    if match := _MOODLE.fullmatch(first):
        return LmsName(MOODLE, match["student"], match["number"], match["prefix"], match["file"])
    # Canvas creates no folders, but an unpacked zip is one
    is_file = not slash or first.lower().endswith(".zip")
    if is_file and (match := _CANVAS.fullmatch(first)):
        parts = {name: match[name] for name in ("student", "number", "prefix", "file")}
        return LmsName(CANVAS, **parts, late=match["late"] is not None)
    return None
