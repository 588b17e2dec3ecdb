"""Find submissions in a folder (flat, nbgrader, Moodle, Canvas) and read their notebooks."""

import os
import re
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from slamlab.exercises import catalogue
from slamlab.grading.notebooks import Notebook, SubmissionError, parse
from slamlab.grading.term.lms_names import lms_name

MAX_NOTEBOOK_BYTES = 20 << 20  # size of a file [bytes]
MAX_TIMESTAMP_CHARACTERS = 100  # of nbgrader's note on the time
MAX_FOLDER_DEPTH = 10  # folders in folders

_AT_THE_START = re.compile(r"(?:ex)?(\d\d)_", re.IGNORECASE)


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
    when : str or None, the time of submission (ISO 8601) where the file does not tell it, "" where
        nothing does
    note : str, what is odd about it; "" for nothing
    """

    name: str
    student: str
    path: Path
    problem: str | None = None
    number: str | None = None
    has_trusted_time: bool = False
    when: str | None = None
    note: str = ""

    @property
    def handed_in(self):
        """The time of submission (ISO 8601): nbgrader's timestamp, else the file's."""
        if self.when is not None:
            return self.when or None
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


def find_submissions(folder: Path, out: Path | None = None, zips=False) -> list[Submission]:
    """Find all submissions in a folder, whatever their layout, sorted by name.

    Flat files, ``STUDENT/EXERCISE/`` folders, nbgrader's ``submitted/STUDENT/ASSIGNMENT/``, and
    Moodle's and Canvas' downloads; a student's folder without a notebook is one with a problem.

    Parameters
    ----------
    folder : Path
    out : Path or None, a folder that is not looked into
    zips : bool, whether a zip anywhere is listed, as one with a problem

    Raises
    ------
    SubmissionError : when the folder is none
    """
    if not folder.is_dir():
        wrong = "is no folder, and no zip" if folder.exists() else "is not there"
        raise SubmissionError(f"{folder} {wrong}")
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
        zipped = [f for f in files if zips and f.lower().endswith(".zip") and not f.startswith(".")]
        found += [_submission(folder, place / file) for file in notebooks]
        found += [_submission(folder, place / file, "not a notebook") for file in zipped]
        if place == folder:  # what Moodle or Canvas put there is somebody's, whatever it is
            others = (_submission(folder, place / f, "not a notebook") for f in files
                      if f not in (*notebooks, *zipped))  # fmt: skip
            found += [other for other in others if other.number]
    handed_in = {parent for submission in found for parent in submission.path.parents}
    reason = "a folder without a notebook in it"
    found += [_submission(folder, place, reason) for place in empty if place not in handed_in]
    return in_order(found)


def in_order(found):
    """Submissions in the order of their names, see :func:`by_name`."""
    return sorted(found, key=lambda submission: by_name(submission.name))


def by_name(name):
    """The order of names, a sort key: "a" before its copy "a (1)", 2 before 10."""
    folder, _, file = name.rpartition("/")
    parts = re.split(r"(\d+)", file.removesuffix(".ipynb"))
    return folder, [int(part) if part.isdecimal() else part for part in parts], name


def read_notebook(submission: Submission) -> Notebook:
    """Read and parse the notebook of a submission.

    Raises
    ------
    SubmissionError : with the reason, in words for the grader
    """
    return parse(read_bytes(submission))


def read_bytes(submission: Submission) -> bytes:
    """Read the file of a submission.

    Raises
    ------
    SubmissionError : there is none, it is too large, or cannot be read
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
        return submission.path.read_bytes()
    except OSError as error:
        raise SubmissionError(f"cannot be read: {error.strerror}") from None


def identify_exercise(submission: Submission, notebook: Notebook, bound=None):
    """Identify the exercise: as bound, else by the metadata, else by the file's name.

    A name tells it by ``NN_`` or ``exNN_`` at its start. What tells another exercise is an error:
    a solution of one must not be taken for that of another.

    Parameters
    ----------
    bound : str or None, the number of the exercise that all are to be of

    Returns
    -------
    Exercise

    Raises
    ------
    SubmissionError : when nothing tells it, or two tell different ones
    """
    named = notebook.exercise
    if named is not None and named not in catalogue.EXERCISES:
        said = f"its metadata name exercise {named[:20]!r}, which there is not"
        raise SubmissionError(f"{said}; there are {', '.join(catalogue.EXERCISES)}")
    told = {"its metadata": named, "its name": None, "--exercise": bound and bound.zfill(2)}
    if not (named and bound):  # two that agree need no third
        told["its name"] = _exercise_by_name(submission.name)
    told = {way: id for way, id in told.items() if id}
    if not told:
        raise SubmissionError(
            "which exercise it is stands neither in it nor at its name's start: say --exercise"
        )
    if len(set(told.values())) > 1:
        said = "exercise " + ", ".join(f"{id} by {way}" for way, id in told.items())
        raise SubmissionError(said if bound else f"{said}; --exercise settles it")
    return catalogue.exercise(next(iter(told.values())))


def _exercise_by_name(name):
    """The exercise that a file's name begins with, as it was before an LMS put more before it."""
    parts = Path(name).parts
    of_lms = lms_name(name) if len(parts) == 1 else None
    match = _AT_THE_START.match(of_lms.file if of_lms else parts[-1])
    return match[1] if match and match[1] in catalogue.EXERCISES else None


def _is_searched(folder, skipped):
    if folder.name.startswith(".") or folder.name == "__MACOSX" or folder.is_symlink():
        return False
    return skipped is None or folder.resolve() != skipped


def _submission(folder, path, problem=None):
    relative = path.relative_to(folder)
    first = relative.parts[0]
    of_lms = lms_name(relative.as_posix())
    own = relative.stem if len(relative.parts) == 1 else first
    student, number = (of_lms.student, of_lms.number) if of_lms else (own, None)
    name = _printable(relative.as_posix())
    has_trusted_time = folder.name == "submitted" and len(relative.parts) == 3
    return Submission(name, _printable(student), path, problem, number, has_trusted_time)


def _printable(text):
    # names on disk may hold bytes that are no text
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")
