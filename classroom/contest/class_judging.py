"""Judge all submissions in all worlds, and save each run immediately."""

import re
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed, wait
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path

from classroom.contest.ranking import by_families
from classroom.contest.run_files import read_run, run_ended_by_time_limit, write_run
from classroom.contest.sandbox_judging import run_in_sandbox
from classroom.exercises.function_calls.student_estimator import GraderFault
from classroom.grading.submissions import SubmissionError, by_name, read_notebook
from classroom.project.estimator_runs import Budget, EstimatorRun
from classroom.project.estimator_worker import NAME
from classroom.project.scores import PreparedWorld, WorldResult

NOT_THEIRS = "an error of the grader, not of the student; run the command again"
_CLASS = re.compile(rf"^(class\s+{NAME}\b|{NAME}\s*=[^=])", re.MULTILINE)


@dataclass(frozen=True)
class ContestEntry:
    """A submission and its results."""

    student: str
    submission: str
    sha256: str | None = None  # of the notebook
    reason: str | None = None  # why it could not be judged
    runs: tuple[EstimatorRun, ...] = field(default=(), repr=False)  # one for each world
    results: tuple[WorldResult, ...] = ()  # one for each world
    failed: bool = False  # whether the grader itself failed

    @property
    def table(self):
        """Points, (families, worlds)."""
        families = [result.family for result in self.results]
        return by_families([result.points for result in self.results], families)


@dataclass(frozen=True)
class ContestSetup:
    """The worlds and rules for all submissions of a contest.

    carried : maps (SHA-256 of a notebook, number of the world) to the points of a run that was
    stopped by a time limit in the first judging."""

    prepared_worlds: list[PreparedWorld]
    folder: Path  # of the saved runs
    budget: Callable[[], Budget]  # for all worlds of a student, and for each log
    over: bool = False  # whether the worlds are published: no new runs are made
    carried: dict = field(default_factory=dict)


def judge_submission(submission, setup, start, stop=None, report=None):
    """Judge a submission in all worlds, reuse saved runs, and return a ContestEntry.

    start : exercise -> worker. stop : Event that stops the judging, or None. report : called with
    the submission's name after each world."""
    names, for_worlds = (submission.student, submission.name), setup.budget()
    try:
        notebook = read_notebook(submission)
        own = f"{notebook.sha256[:16]}-{sha256(submission.student.encode()).hexdigest()[:8]}"
        runs, results = [], []
        for k, prepared_world in enumerate(setup.prepared_worlds):
            file = setup.folder / own / f"{k:03}.npz"
            carried = setup.carried.get((notebook.sha256, k))
            # a recorded log is far longer than a world and has its own budget
            budget = for_worlds if prepared_world.world.truth is not None else setup.budget()
            run = read_run(file)
            if run is None and setup.over:
                raise SubmissionError("it was submitted after the worlds were revealed")
            if run is None and carried is not None:
                run = run_ended_by_time_limit(len(prepared_world.readings))
            elif run is None:
                run = run_in_sandbox(notebook.cells, prepared_world.readings, start, budget, stop)
                write_run(file, run)
            else:
                budget.spent += run.seconds
            result = prepared_world.judge(run)
            runs.append(run)
            results.append(result if carried is None else replace(result, points=carried))
            if report:
                report(submission.name)
    except SubmissionError as error:
        return ContestEntry(*names, reason=str(error))
    except GraderFault as error:
        return ContestEntry(*names, notebook.sha256, f"{NOT_THEIRS}: {error}", failed=True)
    return ContestEntry(*names, notebook.sha256, None, tuple(runs), tuple(results))


def judge_class(found, setup, workers, jobs=1, report=None):
    """Judge several submissions in parallel, and yield a ContestEntry when each is finished.

    workers : WorkerPool; closed at the end. report : as in :func:`judge_submission`."""
    stop = threading.Event()
    with ThreadPoolExecutor(max(1, jobs)) as pool:
        futures = [
            pool.submit(judge_submission, s, setup, workers.start, stop, report) for s in found
        ]
        try:
            yield from (future.result() for future in as_completed(futures))
        finally:
            stop.set()
            for future in futures:
                future.cancel()
            wait(futures)
            workers.close()  # before their threads end, which would kill them


def last_submissions(found):
    """Return each student's last notebook that defines the class, sorted by name.

    If no notebook of a student defines the class, return a submission with a problem for this
    student."""
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
    return f"it does not define the class {NAME}"
