"""Run a task: a student's functions on its inputs, judged, and what is wrong told."""

from dataclasses import replace

from slamlab.exercises import case_text, cases, clues, fingerprints
from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.input_sets import MAIN, run_sets
from slamlab.exercises.task import IDLE, OPEN_SEED, UNCHANGED, Task
from slamlab.exercises.verdict import Verdict


def run(task: Task, namespace, sets) -> Verdict:
    """Call a task's functions and judge their outputs in one process, as the grader's worker does.

    Parameters
    ----------
    task : Task
    namespace : the student's names
    sets : what ``task.draw`` made

    Returns
    -------
    Verdict
    """
    try:
        return task.judge(sets, run_sets(task.drive, namespace, sets))
    except StudentError as error:
        return task.failed(error.kind, error.message)


def run_and_tell(task: Task, namespace) -> Verdict:
    """As :func:`run` on the open inputs, with the mistake and the smallest failing case told.

    Parameters
    ----------
    task : Task
    namespace : the student's names

    Returns
    -------
    Verdict
    """
    sets = task.draw(OPEN_SEED)
    try:
        answers = run_sets(task.drive, namespace, sets)
        verdict = task.judge(sets, answers)
    except StudentError as error:
        verdict, answers = task.failed(error.kind, error.message), {MAIN: error}
    if verdict.full or verdict.kind not in (None, "raised", "malformed"):
        return verdict
    verdict = recognised(task, verdict, lambda: (sets, answers))

    def run_again(inputs):
        return task.drive(namespace, inputs)

    try:
        if isinstance(answers[MAIN], StudentError):
            case = cases.failing(task, sets, answers[MAIN], run_again)
        else:
            case = cases.smallest(task, sets, answers, run_again)
    except KeyboardInterrupt:  # the time limit, perhaps: what was judged stays judged
        return verdict
    return replace(verdict, case=case_text.format_case(task, case)) if case else verdict


def recognised(task: Task, verdict: Verdict, answered) -> Verdict:
    """A verdict with the mistake that its fingerprint tells, or else a clue.

    Parameters
    ----------
    task : Task
    verdict : Verdict, not full
    answered : () -> sets, answers, of the open inputs; called where they are needed only, may
        raise StudentError

    Returns
    -------
    Verdict
    """
    broken = {law.name for law in verdict.laws if law.failed}
    if verdict.problem or verdict.diagnosis == IDLE.name or broken == {UNCHANGED.name}:
        return verdict  # all is said
    try:
        sets, answers = answered()
    except StudentError:
        return verdict
    mistake = fingerprints.recognise(task, sets, answers)
    if verdict.diagnosis and (not mistake or mistake.family):  # a property says more
        return verdict
    mistake = mistake or clues.clue(task, sets, answers)
    return replace(verdict, diagnosis=mistake.name, hint=mistake.hint) if mistake else verdict
