"""Record of an attempt: verdicts, seed, versions and times of one graded submission."""

import hashlib
import os
import re
from dataclasses import dataclass, field
from pathlib import Path

from classroom.exercises.verdict import Verdict


@dataclass(frozen=True)
class Record:
    """The result of grading one submission, as the gradebook stores it."""

    submission: str
    student: str
    exercise: str | None = None  # its number
    reason: str | None = None  # why it could not be graded, which differs from a score of 0
    verdicts: tuple[Verdict, ...] = ()  # one per task, in order
    cells: dict[int, str] = field(default_factory=dict)  # cell number to its error
    notes: tuple[str, ...] = ()  # irregularities of the file
    sha256: str | None = None  # of the file
    seed: str | None = None  # hexadecimal; a regrade with it gives the same inputs
    isolation: str | None = None  # the sandbox's level
    versions: dict[str, str] = field(default_factory=dict)  # of the grading software
    seconds: dict[str, float] = field(default_factory=dict)  # wall and CPU time [s] by stage
    titles: dict[str, str] = field(default_factory=dict)  # of tasks, by id
    number: str | None = None  # of the student in Moodle or Canvas
    handed_in: str | None = None  # ISO 8601
    failed: bool = False  # whether the grader failed: not stored, but graded again
    policy: dict | None = None  # the late policy that applied, see LatePolicy.stored
    judges: dict[str, str] = field(default_factory=dict)  # task to the digest of what judged it
    seen: int | None = None  # its number in the order of submissions, see submission_order
    kept: dict[str, str] = field(default_factory=dict)  # "cells" and "outputs" to their hashes
    contents: dict[str, bytes] = field(default_factory=dict, compare=False, repr=False)
    signs: tuple[str, ...] = ()  # see suspicious_code

    @property
    def graded(self):
        return self.reason is None

    @property
    def unsolved(self):
        """Whether no task was attempted, as in the notebook that students receive."""
        kinds = {"not attempted", "needs"}  # "needs" only in records of older versions
        return self.graded and {v.kind for v in self.verdicts} <= kinds

    @property
    def score(self):
        """Points earned, or None if the submission could not be graded."""
        return sum(v.points for v in self.verdicts) if self.graded else None

    @property
    def max_score(self):
        """The maximum score, or None if the submission could not be graded."""
        return sum(v.max_points for v in self.verdicts) if self.graded else None

    @property
    def note(self):
        """A one-line summary for graders and students: failures, and replaced functions."""
        if not self.graded:
            return f"could not be graded: {self.reason}"
        found = [
            f"{self.titles.get(v.task, v.task)}: {', '.join(filter(None, _findings(v)))}"
            for v in self.verdicts
            if v.replaced or not v.full
        ]
        return "; ".join([*self.notes, *found])

    @property
    def stem(self):
        """A unique and safe file name for a submission with any name."""
        return f"{self.stem_of_unknown}-{self.exercise}" if self.exercise else self.stem_of_unknown

    @property
    def stem_of_unknown(self):
        """The file name used while the exercise is unknown."""
        readable = re.sub(r"[^A-Za-z0-9]+", "-", self.submission.removesuffix(".ipynb")).strip("-")
        return f"{readable[:60]}-{hashlib.sha256(self.submission.encode()).hexdigest()[:8]}"


def _findings(verdict):
    failed = ", ".join(f"“{law.says}”" for law in verdict.laws if law.failed)
    return verdict.carried, verdict.problem or (failed and f"loses the points for {failed}")


def write_atomically(path: Path, text: str):
    """Write a file atomically; only its owner can read it."""
    private_folder(path.parent)
    # a killed grader may have left a partial file under this name
    partial = path.with_name(f".{path.name}.part")
    partial.unlink(missing_ok=True)
    handle = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    with open(handle, "w", encoding="utf-8", errors="backslashreplace", newline="") as file:
        file.write(text)
    os.replace(partial, path)


def private_folder(path: Path):
    """Create a folder that only its owner can read, and missing parent folders."""
    if not path.is_dir():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.mkdir(mode=0o700, exist_ok=True)
