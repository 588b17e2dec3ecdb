"""What the checks tell a student about an answer, and a report on all programs of one task."""

import warnings
from collections import Counter

from classroom.exercises import catalogue
from classroom.exercises.mistake_families import MISTAKE_FAMILIES
from classroom.exercises.run_task import run_and_explain
from classroom.exercises.task import IDLE
from classroom.exercises.time_limit import TimeLimitExceeded, capture_output, time_limit
from course.answers import INDEPENDENT
from course.fingerprints import asked_about
from course.task_programs import Programs, namespace, programs


def explained(one: Programs, source):
    """Judge an answer as ``check`` does in a notebook.

    Parameters
    ----------
    one : Programs
    source : str

    Returns
    -------
    Verdict
    """
    limit = time_limit(one.task.call.seconds, cpu=True)  # a busy machine makes no answer wrong
    try:
        with capture_output(), warnings.catch_warnings(action="ignore"), limit:
            return run_and_explain(one.task, namespace(one.exercise.id, source))
    except TimeLimitExceeded:
        return one.task.failed("time", "still running")
    except Exception as error:
        return one.task.failed("raised", f"the cell itself: {type(error).__name__}: {error}")


def kind(one: Programs, verdict) -> str:
    """Classify what a student learns from the verdict on a wrong answer.

    *passed*: full marks. *not judged*: with the reason. *named*: the hint of a mistake. *family*,
    *property*, *pattern*: the hint of a family of mistakes, of a property of the answer, of where
    or how it is wrong. *case*: no hint, but a case with the wrong output. *silent*: nothing.
    """
    if verdict.full:
        return "passed"
    if verdict.problem:
        return "not judged"
    changed = [law.name for law in verdict.laws if law.failed] == ["unchanged"]
    if changed or verdict.diagnosis in {mistake.name for mistake in one.mistakes}:
        return "named"
    if verdict.diagnosis in MISTAKE_FAMILIES:
        return "family"
    if verdict.diagnosis:
        properties = {IDLE.name, *(found.name for found in one.task.diagnoses)}
        return "property" if verdict.diagnosis in properties else "pattern"
    return "case" if verdict.case else "silent"


def lacking(exercise_id) -> list[str]:
    """List the content that an exercise lacks for ``hint``: questions about its known mistakes,
    steps of its laws, and questions to begin with.
    """
    found = [
        f"{one.task.id}: a question about {mistake.name!r}"
        for one in programs(exercise_id)
        for mistake in one.mistakes
        if not any(asked_about(one, mistake))
    ]
    for task in catalogue.exercise(exercise_id).tasks:
        found += [f"{task.id}: asks of {each.name!r}" for each in task.diagnoses if not each.asks]
        found += [f"{task.id}: step of {law.name!r}" for law in task.laws if not law.step]
        found += [f"{task.id}: begins"] * (not task.begins)
    return found


def is_misjudged(one: Programs, answer, verdict) -> bool:
    """Whether a right independent answer loses points, or a wrong one has an unexpected verdict.

    In the open last task of an exercise, a right answer may use a method that is not the best.
    """
    if answer.kind == "right":
        least = 0.5 if one.task is one.exercise.tasks[-1] else 1
        return verdict.points < least * one.task.points
    return verdict.full != (answer.kind == "passes")


def answers_report(one: Programs):
    """Judge the independent answers of a task.

    Returns
    -------
    list of (Answer, Verdict), Counter : answers that are misjudged, and the kinds of wrong ones
    """
    misjudged, kinds = [], Counter()
    for answer in one.answers:
        if answer.kind not in INDEPENDENT:
            continue
        verdict = explained(one, answer.source)
        if answer.kind == "wrong":
            kinds[kind(one, verdict)] += 1
        if is_misjudged(one, answer, verdict):
            misjudged.append((answer, verdict))
    return misjudged, kinds
