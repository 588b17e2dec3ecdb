"""The record of an attempt: verdicts, seed, versions and times of one graded submission."""

import hashlib
import os
import re
from dataclasses import dataclass, field
from pathlib import Path

from slamlab.exercises.verdict import Verdict


@dataclass(frozen=True)
class Record:
    """The result of grading one submission, as the gradebook stores it.

    Parameters
    ----------
    submission, student : str
    exercise : str or None, its number
    reason : str or None, why it could not be graded; that is not the same as a score of 0
    verdicts : one a task, in order
    cells : what went wrong in which cell of the notebook
    notes : what was odd about the file
    sha256 : str or None, of the file
    seed : str, hexadecimal; a regrade with it gives the same inputs
    isolation : str, the isolation level of the sandbox
    versions : of the grading software
    seconds : wall and CPU time [s] by stage
    titles : task id to title
    number : str or None, of the student in Moodle or Canvas
    handed_in : str or None, the time in ISO's form
    failed : bool, whether it was the grader that failed: not kept, but tried again
    policy : the late policy that held, as :meth:`LatePolicy.stored` makes it; None for none
    judges : task to the digest of what judged it, see :mod:`slamlab.grading.course_digests`
    seen : int or None, the counter of when the judge first saw it
    kept : "cells" and "outputs" to the hash of what is kept of them
    contents : hash to bytes, of what is to be kept; stored apart from the record
    signs : what its code has that no exercise asks for, see :mod:`slamlab.grading.hostile_signs`
    """

    submission: str
    student: str
    exercise: str | None = None
    reason: str | None = None
    verdicts: tuple[Verdict, ...] = ()
    cells: dict[int, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    sha256: str | None = None
    seed: str | None = None
    isolation: str | None = None
    versions: dict[str, str] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    titles: dict[str, str] = field(default_factory=dict)
    number: str | None = None
    handed_in: str | None = None
    failed: bool = False
    policy: dict | None = None
    judges: dict[str, str] = field(default_factory=dict)
    seen: int | None = None
    kept: dict[str, str] = field(default_factory=dict)
    contents: dict[str, bytes] = field(default_factory=dict, compare=False, repr=False)
    signs: tuple[str, ...] = ()

    @property
    def graded(self):
        """Whether there is a score at all."""
        return self.reason is None

    @property
    def score(self):
        """Points earned, None when it could not be graded."""
        return sum(v.points for v in self.verdicts) if self.graded else None

    @property
    def max_score(self):
        """The most that could be earned, None when it could not be graded."""
        return sum(v.max_points for v in self.verdicts) if self.graded else None

    @property
    def note(self):
        """One line for the table of grades."""
        if not self.graded:
            return f"could not be graded: {self.reason}"
        said = [
            f"{v.task}: {v.problem or v.diagnosis or _failed_laws(v)}"
            for v in self.verdicts
            if not v.full
        ]
        return "; ".join([*self.notes, *said])

    @property
    def stem(self):
        """A unique and safe file name, whatever the submission is called; its exercise's own."""
        return f"{self.stem_of_unknown}-{self.exercise}" if self.exercise else self.stem_of_unknown

    @property
    def stem_of_unknown(self):
        """As :attr:`stem`, while nobody knows of which exercise it is."""
        readable = re.sub(r"[^A-Za-z0-9]+", "-", self.submission.removesuffix(".ipynb")).strip("-")
        return f"{readable[:60]}-{hashlib.sha256(self.submission.encode()).hexdigest()[:8]}"


def _failed_laws(verdict):
    return "broken: " + ", ".join(law.name for law in verdict.laws if law.failed)


def write_atomically(path: Path, text: str):
    """Write a file atomically, for its owner's eyes only: it is there whole or not at all."""
    private_folder(path.parent)
    # what a killed grader left half written is written again under the same name
    partial = path.with_name(f".{path.name}.part")
    partial.unlink(missing_ok=True)
    handle = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    with open(handle, "w", encoding="utf-8", errors="backslashreplace", newline="") as file:
        file.write(text)
    os.replace(partial, path)


def private_folder(path: Path):
    """Make a folder where it is missing, with those above it, that only its owner can look into."""
    if not path.is_dir():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.mkdir(mode=0o700, exist_ok=True)
