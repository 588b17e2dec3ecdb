"""Run a task: a student's functions on its inputs, judged, and what is wrong told."""

from dataclasses import replace

from slamlab.exercises import case_text, cases, fingerprints
from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.input_sets import MAIN, run_sets
from slamlab.exercises.task import IDLE, OPEN_SEED, Task
from slamlab.exercises.verdict import Verdict


def run(task: Task, namespace, sets, tell=False) -> Verdict:
    """Call a task's functions and judge their outputs in one process, as a notebook does.

    Parameters
    ----------
    task : Task
    namespace : the student's names
    sets : what ``task.draw`` made
    tell : bool, whether the mistake and the smallest failing case are looked for

    Returns
    -------
    Verdict
    """

    def drive(sets):
        return run_sets(task.drive, namespace, sets)

    try:
        answers = drive(sets)
    except StudentError as error:
        failed = task.failed(error.kind, error.message)
        if tell and error.kind == "raised":
            failed = _with_case(task, failed, {MAIN: sets[MAIN]}, {MAIN: error}, drive)
        return failed
    verdict = task.judge(sets, answers)
    if verdict.full or not tell:
        return verdict
    verdict = recognised(task, verdict, lambda _, open: drive(open))
    return _with_case(task, verdict, sets, answers, drive)


def recognised(task: Task, verdict: Verdict, run) -> Verdict:
    """A verdict with the mistake that its fingerprint tells.

    Parameters
    ----------
    task : Task
    verdict : Verdict, not full
    run : (task, sets) -> answers, asked for the open inputs; raises StudentError

    Returns
    -------
    Verdict
    """
    if verdict.problem or verdict.diagnosis == IDLE.name or task.id not in fingerprints.tables(task.id[:2]):
        return verdict
    sets = task.draw(OPEN_SEED)
    try:
        mistake = fingerprints.recognise(task, sets, run(task, sets))
    except StudentError:
        return verdict
    return replace(verdict, diagnosis=mistake.name, hint=mistake.hint) if mistake else verdict


def _with_case(task, verdict, sets, answers, drive):
    case = cases.smallest(task, sets, answers, lambda inputs: drive({MAIN: inputs})[MAIN])
    text = case and case_text.format_case(task, case)
    return replace(verdict, case=text) if text else verdict
