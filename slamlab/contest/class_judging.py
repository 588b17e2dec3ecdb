"""All students in all worlds: each world of each student is kept as soon as it is driven."""

import re
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed, wait
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path

from slamlab.contest.drive_files import late_drive, read_drive, write_drive
from slamlab.contest.ranking import by_families
from slamlab.contest.sandbox_judging import drive_in_sandbox
from slamlab.exercises.drives.student_estimator import GraderFault
from slamlab.grading.submissions import SubmissionError, by_name, read_notebook
from slamlab.project.driving import Budget, Drive
from slamlab.project.scores import Arena, Result
from slamlab.project.streamed_drive import NAME

NOT_THEIRS = "no fault of the student's, run it again"
_CLASS = re.compile(rf"^(class\s+{NAME}\b|{NAME}\s*=[^=])", re.MULTILINE)


@dataclass(frozen=True)
class Entry:
    """What became of a submission.

    Parameters
    ----------
    student, submission : str
    sha256 : str or None, of the notebook
    reason : str or None, why it could not be judged
    drives : tuple of Drive, one for each world
    results : tuple of Result, one for each world
    failed : bool, whether it was the judge that failed
    """

    student: str
    submission: str
    sha256: str | None = None
    reason: str | None = None
    drives: tuple[Drive, ...] = field(default=(), repr=False)
    results: tuple[Result, ...] = ()
    failed: bool = False

    @property
    def table(self):
        """Points, (families, worlds)."""
        families = [result.family for result in self.results]
        return by_families([result.points for result in self.results], families)


@dataclass(frozen=True)
class Course:
    """What all submissions of a contest are driven through, and under which rules.

    Parameters
    ----------
    arenas : list of Arena
    folder : Path, of the drives
    budget : callable that makes a student's Budget, for all worlds, and for each recorded log
    over : bool, whether the worlds are known by now: what was not driven before is not any more
    carried : dict, (SHA-256 of a notebook, number of the world) to the points it has, where a
        limit of time had ended the drive when it was judged first
    """

    arenas: list[Arena]
    folder: Path
    budget: Callable[[], Budget]
    over: bool = False
    carried: dict = field(default_factory=dict)


def judge_submission(submission, course, start, stop=None, told=None):
    """Judge a submission in all worlds; what was driven before is not driven again.

    Parameters
    ----------
    submission : Submission
    course : Course
    start : exercise -> worker
    stop : threading.Event or None
    told : callable that is given the submission's name after each world, or None

    Returns
    -------
    Entry
    """
    names, for_worlds = (submission.student, submission.name), course.budget()
    try:
        notebook = read_notebook(submission)
        own = f"{notebook.sha256[:16]}-{sha256(submission.student.encode()).hexdigest()[:8]}"
        drives, results = [], []
        for k, arena in enumerate(course.arenas):
            file = course.folder / own / f"{k:03}.npz"
            carried = course.carried.get((notebook.sha256, k))
            # a recorded log is far longer than a world: it has a budget of its own
            budget = for_worlds if arena.world.truth is not None else course.budget()
            driven = read_drive(file)
            if driven is None and course.over:
                raise SubmissionError("it came after the worlds had been revealed")
            if driven is None and carried is not None:
                driven = late_drive(len(arena.readings))
            elif driven is None:
                driven = drive_in_sandbox(notebook.cells, arena.readings, start, budget, stop)
                write_drive(file, driven)
            else:
                budget.spent += driven.seconds
            result = arena.judge(driven)
            drives.append(driven)
            results.append(result if carried is None else replace(result, points=carried))
            if told:
                told(submission.name)
    except SubmissionError as error:
        return Entry(*names, reason=str(error))
    except GraderFault as error:
        return Entry(*names, notebook.sha256, f"{NOT_THEIRS}: {error}", failed=True)
    return Entry(*names, notebook.sha256, None, tuple(drives), tuple(results))


def judge_class(found, course, workers, jobs=1, told=None):
    """Judge a class, several at once; one that hangs holds up one job.

    Parameters
    ----------
    found : list of Submission
    course : Course
    workers : WorkerPool, closed in the end
    jobs : int
    told : callable that is given a submission's name after each of its worlds, or None

    Yields
    ------
    Entry, as they are done
    """
    stop = threading.Event()
    with ThreadPoolExecutor(max(1, jobs)) as pool:
        futures = [
            pool.submit(judge_submission, s, course, workers.start, stop, told) for s in found
        ]
        try:
            yield from (future.result() for future in as_completed(futures))
        finally:
            stop.set()
            for future in futures:
                future.cancel()
            wait(futures)
            workers.close()  # before the threads end that they would die with


def entrants(found):
    """The submissions that take part: of each student the last notebook with the class in it.

    Parameters
    ----------
    found : list of Submission

    Returns
    -------
    list of Submission, sorted by name; who handed in nothing of the kind is one with a problem
    """
    last = {}
    for submission in sorted(found, key=lambda s: (s.handed_in or "", by_name(s.name))):
        problem = _problem(submission)
        if problem is None or submission.student not in last or last[submission.student].problem:
            last[submission.student] = replace(submission, problem=problem)
    return sorted(last.values(), key=lambda submission: submission.name)


def _problem(submission):
    try:
        cells = read_notebook(submission).cells
    except SubmissionError as error:
        return str(error)
    if any(_CLASS.search(source) for _, source in cells):
        return None
    return f"there is no class {NAME} in it"
