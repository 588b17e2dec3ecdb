"""Find submissions in a folder (flat, nbgrader, Moodle, Canvas) and read their notebooks."""

import hashlib
import os
import re
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from classroom.exercises import catalogue
from classroom.grading.notebooks import Notebook, SubmissionError, parse
from classroom.grading.term.lms_names import lms_name

MAX_NOTEBOOK_BYTES = 20 << 20  # size of a file [bytes]
MAX_TIMESTAMP_CHARACTERS = 100  # of nbgrader's note on the time
MAX_FOLDER_DEPTH = 10  # of nested folders
_AGAIN = "submit the file whose name ends in .ipynb"
_RENAME = "name the file as its exercise, such as ex03_kalman_filter.ipynb, and submit it again"
_REMEDIES = {
    ".py": f"it is a Python program: {_AGAIN}",
    **dict.fromkeys((".pdf", ".html", ".htm"), f"it is a printed copy: {_AGAIN}"),
    **dict.fromkeys((".url", ".webloc", ".desktop"), "it is a link: download the notebook, and "
                    "submit the downloaded file"),
    **dict.fromkeys((".7z", ".rar", ".tar", ".gz", ".tgz", ".xz", ".bz2"), "it is an archive that "
                    "cannot be opened here: submit the notebook itself"),
    ".zip": "it is a zip within a zip: submit the notebook itself",
}  # fmt: skip

_AT_THE_START = re.compile(r"(?:ex(?=\d\d(?!\d))|(?=\d\d_))(\d\d)", re.IGNORECASE)


@dataclass(frozen=True)
class Submission:
    """A submitted notebook file, or the reason why it is missing."""

    name: str  # the path within the graded folder
    student: str  # as named by the path
    path: Path
    problem: str | None = None  # why there is no notebook to read
    number: str | None = None  # of the student in Moodle or Canvas
    has_trusted_time: bool = False  # whether nbgrader, not the student, wrote timestamp.txt
    when: str | None = None  # ISO 8601, in place of the file's time; "": unknown
    note: str = ""  # its irregularity
    sha256: str | None = None  # of the file, also if it is not a notebook
    taken_as: str | None = None  # the exercise for which a grader took it, whatever it states

    @property
    def handed_in(self):
        """Time of submission (ISO 8601) from nbgrader's timestamp or the file's time."""
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
    """Return all submissions, sorted by name, from flat files, ``STUDENT/EXERCISE/``, nbgrader's
    ``submitted/STUDENT/ASSIGNMENT/``, or downloads from Moodle and Canvas. A student's folder
    without a notebook becomes a submission with a problem, and so does a zip file if ``zips``.
    Raises SubmissionError.
    """
    if not folder.is_dir():
        wrong = "is neither a folder nor a zip file" if folder.exists() else "does not exist"
        raise SubmissionError(f"{folder} {wrong}")
    if (folder / "submitted").is_dir():
        folder = folder / "submitted"
    skipped = out.resolve() if out else None
    found, empty = [], []
    for path, folders, files in os.walk(folder):
        path = Path(path)
        folders[:] = [f for f in folders if _is_searched(path / f, skipped)]
        empty += [path / f for f in folders if path == folder or f.lower().endswith(".ipynb")]
        if len(path.relative_to(folder).parts) >= MAX_FOLDER_DEPTH:
            folders.clear()
        notebooks = [f for f in files if f.lower().endswith(".ipynb") and not f.startswith(".")]
        zipped = [f for f in files if zips and f.lower().endswith(".zip") and not f.startswith(".")]
        found += [_submission(folder, path / file) for file in notebooks]
        found += [_submission(folder, path / f, problem_of([path / f])) for f in zipped]
        if path == folder:  # every file that Moodle or Canvas put there belongs to a student
            others = (_submission(folder, path / f, problem_of([path / f])) for f in files
                      if f not in (*notebooks, *zipped))  # fmt: skip
            found += [other for other in others if other.number]
    handed_in = {parent for submission in found for parent in submission.path.parents}
    for path in empty:
        if path not in handed_in:
            files = visible_files(path)
            found.append(_submission(folder, files[0] if files else path, problem_of(files)))
    return in_order(found)


def visible_files(folder):
    """Return the files in a folder without those that operating systems add; names that contain
    ".ipynb" come first.
    """
    found = []
    for path, folders, files in os.walk(folder):
        path = Path(path)
        deep = len(path.relative_to(folder).parts) >= MAX_FOLDER_DEPTH
        folders[:] = [f for f in folders if not deep and _is_searched(path / f, None)]
        found += [path / f for f in files if not f.startswith(".")]
    return sorted(found, key=lambda path: (".ipynb" not in path.name.lower(), path))


def problem_of(files):
    """Return why the first of some files is not a notebook, and what the student can do."""
    if not files:
        return (
            f"your submission contains no file: {_AGAIN}, and check that its status is not “draft”"
        )
    name, rest = _printable(files[0].name), files[0].suffix.lower()
    if name.lower().endswith((".ipynb.txt", ".ipynb.json")):
        return (
            f"the name “{name}” has a wrong ending: remove “{files[0].suffix}” from its end, which "
            "Windows may hide, and submit the file again"
        )
    return f"“{name}” is not a notebook; {_REMEDIES.get(rest, _AGAIN)}"


def content_hash(path):
    """Return the SHA-256 of a file of any size, or None if it cannot be read."""
    try:
        if path.is_symlink() or not path.is_file():
            return None
        with open(path, "rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return None


def in_order(found):
    return sorted(found, key=lambda submission: by_name(submission.name))


def by_name(name):
    """Return a sort key that puts "a" before its copy "a (1)", and 2 before 10."""
    folder, _, file = name.rpartition("/")
    parts = re.split(r"(\d+)", file.removesuffix(".ipynb"))
    return folder, [int(part) if part.isdecimal() else part for part in parts], name


def read_notebook(submission: Submission) -> Notebook:
    return parse(read_bytes(submission))


def read_bytes(submission: Submission) -> bytes:
    """Read the file of a submission. Raises SubmissionError."""
    if submission.problem:
        raise SubmissionError(submission.problem)
    try:
        if submission.path.is_symlink():
            raise SubmissionError(f"the submission is a symbolic link, not a file: {_AGAIN}")
        if not submission.path.is_file():
            raise SubmissionError(f"the submission is not a file: {_AGAIN}")
        size = submission.path.stat().st_size
        if size > MAX_NOTEBOOK_BYTES:
            raise SubmissionError(f"the file is too large: {too_large(size)}")
        return submission.path.read_bytes()
    except OSError as error:
        raise SubmissionError(f"the file cannot be read: {error.strerror}") from None


def too_large(size):
    most = MAX_NOTEBOOK_BYTES >> 20
    return (
        f"it has {size / 2**20:.0f} MB, and at most {most} MB are allowed: choose “Clear "
        "Outputs of All Cells” in JupyterLab's menu Edit, save the notebook, and submit it again"
    )


def identify_exercise(submission: Submission, notebook: Notebook, bound=None):
    """Return the exercise according to ``bound``, the metadata or the start of the file name.
    Raises SubmissionError if two of these differ or all are missing, because a submission must not
    be graded as another exercise.
    """
    if submission.taken_as:
        return catalogue.exercise(submission.taken_as)
    named = notebook.exercise
    if named is not None and named not in catalogue.EXERCISES:
        raise SubmissionError(
            f"the notebook's metadata (JupyterLab hides them) name exercise {named[:20]!r}, "
            "which does not exist: copy your solution into a new copy of the exercise's notebook, "
            "and submit this copy"
        )
    stated = {"its metadata": named, "its file name": None, "--exercise": bound and bound.zfill(2)}
    if not (named and bound):  # the file name matters only if one of them is missing
        stated["its file name"] = _exercise_by_name(submission.name)
    stated = {source: id for source, id in stated.items() if id}
    if not stated:
        raise SubmissionError(f"neither the file nor its name states the exercise: {_RENAME}")
    if len(set(stated.values())) > 1:
        source, other = next(iter(stated.items()))
        if bound:
            raise SubmissionError(
                f"this is exercise {other} according to {source}, but exercise {bound.zfill(2)} is "
                f"graded here: submit the notebook of exercise {bound.zfill(2)}"
            )
        by_name = stated["its file name"]
        raise SubmissionError(
            f"this was made from the notebook of exercise {other}, but is named as {by_name}: "
            f"if you solved exercise {other} in it, {_RENAME}; if you solved {by_name}, copy your "
            "solution into a new copy of that exercise's notebook, and submit this copy"
        )
    return catalogue.exercise(next(iter(stated.values())))


def _exercise_by_name(name):
    """Return the exercise that a file name states after any LMS prefix, or None."""
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
    # names on disk may contain bytes that are not text
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")
