"""Find submissions in a folder (flat, nbgrader, Moodle, Canvas) and read their notebooks."""

import os
import re
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from slamlab.exercises import catalogue
from slamlab.grading.notebooks import Notebook, SubmissionError, parse

MAX_NOTEBOOK_BYTES = 20 << 20  # size of a file [bytes]
MAX_TIMESTAMP_CHARACTERS = 100  # of nbgrader's note on the time
MAX_FOLDER_DEPTH = 10  # folders in folders

_MOODLE = re.compile(r"(?P<student>.+?)_(?P<number>\d+)_assignsubmission_file_?(?P<file>.*)", re.S)
_CANVAS = re.compile(r"(?P<student>[^_]+)_(LATE_)?(?P<number>\d+)_\d+_(?P<file>.+)", re.S)


@dataclass(frozen=True)
class Submission:
    """One submission: a notebook file, or the reason why there is none.

    Parameters
    ----------
    name : str, the path in the folder graded
    student : str, told by the path
    path : Path
    problem : str or None, why there is nothing to read
    number : str or None, of the student in Moodle or Canvas
    has_trusted_time : bool, whether nbgrader, not the student, wrote the note on the time beside it
    """

    name: str
    student: str
    path: Path
    problem: str | None = None
    number: str | None = None
    has_trusted_time: bool = False

    @property
    def handed_in(self):
        """The time of submission (ISO 8601): nbgrader's timestamp, else the file's."""
        note = self.path.parent / "timestamp.txt"
        try:
            if self.has_trusted_time and note.is_file() and not note.is_symlink():
                with open(note, encoding="utf-8", errors="replace") as file:
                    return _time(file.read(MAX_TIMESTAMP_CHARACTERS).strip())
            return datetime.fromtimestamp(self.path.stat().st_mtime, UTC).isoformat()
        except (OSError, ValueError, OverflowError):
            return None


def _time(text):
    when = datetime.fromisoformat(text.removesuffix(" UTC").strip())
    return (when if when.tzinfo else when.replace(tzinfo=UTC)).isoformat()


def find_submissions(folder: Path, out: Path | None = None) -> list[Submission]:
    """Find all submissions in a folder, whatever their layout, sorted by name.

    Flat files, ``STUDENT/EXERCISE/`` folders, nbgrader's ``submitted/STUDENT/ASSIGNMENT/``, and
    Moodle's and Canvas' downloads; a student's folder without a notebook is one with a problem.

    Parameters
    ----------
    folder : Path
    out : Path or None, a folder that is not looked into

    Raises
    ------
    SubmissionError : when the folder is none
    """
    if not folder.is_dir():
        raise SubmissionError(f"{folder} is no folder")
    if (folder / "submitted").is_dir():
        folder = folder / "submitted"
    skipped = out.resolve() if out else None
    found, empty = [], []
    for place, folders, files in os.walk(folder):
        place = Path(place)
        folders[:] = [f for f in folders if _is_searched(place / f, skipped)]
        empty += [place / f for f in folders if place == folder or f.lower().endswith(".ipynb")]
        if len(place.relative_to(folder).parts) >= MAX_FOLDER_DEPTH:
            folders.clear()
        notebooks = [f for f in files if f.lower().endswith(".ipynb") and not f.startswith(".")]
        found += [_submission(folder, place / file) for file in notebooks]
        if place == folder:  # what Moodle or Canvas put there is somebody's, whatever it is
            others = (_submission(folder, place / f, "not a notebook") for f in files
                      if f not in notebooks)  # fmt: skip
            found += [other for other in others if other.number]
    handed_in = {parent for submission in found for parent in submission.path.parents}
    reason = "a folder without a notebook in it"
    found += [_submission(folder, place, reason) for place in empty if place not in handed_in]
    return sorted(found, key=lambda submission: submission.name)


def read_notebook(submission: Submission) -> Notebook:
    """Read and parse the notebook of a submission.

    Raises
    ------
    SubmissionError : with the reason, in words for the grader
    """
    if submission.problem:
        raise SubmissionError(submission.problem)
    try:
        if submission.path.is_symlink():
            raise SubmissionError("a link, not a file")
        if not submission.path.is_file():
            raise SubmissionError("not a file")
        size = submission.path.stat().st_size
        if size > MAX_NOTEBOOK_BYTES:
            megabytes = f"{size / 2**20:.0f} MB, more than {MAX_NOTEBOOK_BYTES >> 20}"
            raise SubmissionError(f"the file has {megabytes}: hand it in with its outputs cleared")
        data = submission.path.read_bytes()
    except OSError as error:
        raise SubmissionError(f"cannot be read: {error.strerror}") from None
    return parse(data)


def identify_exercise(submission: Submission, notebook: Notebook, default=None):
    """Identify the exercise: by the notebook's metadata, else its path, else a default.

    Parameters
    ----------
    default : str or None, an exercise's number

    Returns
    -------
    Exercise

    Raises
    ------
    SubmissionError : when nothing tells it
    """
    known = list(catalogue.EXERCISES)
    if notebook.exercise in known:
        return catalogue.exercise(notebook.exercise)
    parts = Path(submission.name).parts
    for part in (_original(parts[-1]), *reversed(parts[:-1])):
        for id in re.findall(r"(?<!\d)(\d\d)(?=[_\-. ]|$)", part):
            if id in known:
                return catalogue.exercise(id)
    if default is None:
        raise SubmissionError(
            "which exercise it is stands neither in it nor in its name: say --exercise"
        )
    return catalogue.exercise(default)


def _is_searched(folder, skipped):
    if folder.name.startswith(".") or folder.name == "__MACOSX" or folder.is_symlink():
        return False
    return skipped is None or folder.resolve() != skipped


def _submission(folder, path, problem=None):
    relative = path.relative_to(folder)
    first = relative.parts[0]
    match = _MOODLE.fullmatch(first) or (len(relative.parts) == 1 and _CANVAS.fullmatch(first))
    own = relative.stem if len(relative.parts) == 1 else first
    student, number = (match["student"], match["number"]) if match else (own, None)
    name = _printable(relative.as_posix())
    has_trusted_time = folder.name == "submitted" and len(relative.parts) == 3
    return Submission(name, _printable(student), path, problem, number, has_trusted_time)


def _original(name):
    """A file's name before Moodle or Canvas put the student's into it."""
    match = _MOODLE.fullmatch(name) or _CANVAS.fullmatch(name)
    return match["file"] if match else name


def _printable(text):
    # names on disk may hold bytes that are no text
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")
