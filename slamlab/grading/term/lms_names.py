"""What Moodle and Canvas write into the names of a download, each in a place of its own.

Moodle:  Ana Kos_123_assignsubmission_file/…  or, without folders, …_file_NAME
Canvas:  kosana_1021_55031_NAME  or  kosana_LATE_1021_55031_NAME

Moodle takes underscores out of the full name; Canvas takes what looks like its numbers out of its
own. So the first number behind an underscore is theirs: whatever looks like one later on stands in
a file's name, which students choose.
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
    """What a name in a download tells.

    Parameters
    ----------
    lms : str, MOODLE or CANVAS
    student : str, the name as it stands there
    number : str, Moodle's of the participant (another one in every assignment), Canvas' of the user
    prefix : str, what comes before the file's own name; feedback is taken in under the same
    file : str, the name that the student gave the file; "" where it is a folder's name
    late : bool, whether Canvas marked it as late
    """

    lms: str
    student: str
    number: str
    prefix: str
    file: str
    late: bool = False


def lms_name(name):
    """Parse the first part of a path in a download.

    Parameters
    ----------
    name : str, of a submission: its path in the folder graded

    Returns
    -------
    LmsName or None, for another name
    """
    first, slash, _ = name.partition("/")
    if match := _MOODLE.fullmatch(first):
        return LmsName(MOODLE, match["student"], match["number"], match["prefix"], match["file"])
    # Canvas makes no folders; a zip that was opened is one
    is_file = not slash or first.lower().endswith(".zip")
    if is_file and (match := _CANVAS.fullmatch(first)):
        told = {name: match[name] for name in ("student", "number", "prefix", "file")}
        return LmsName(CANVAS, **told, late=match["late"] is not None)
    return None
