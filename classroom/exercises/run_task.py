"""Run a task: call a student's functions, judge the outputs, add mistake, hint and failing case."""

from dataclasses import replace

from classroom.exercises import (
    failing_case_text,
    failing_cases,
    fingerprints,
    unrecognised_mistakes,
)
from classroom.exercises.function_calls import StudentError
from classroom.exercises.function_calls.run_and_pack import MAIN, call_on_sets
from classroom.exercises.references import in_place
from classroom.exercises.task import IDLE, OPEN_SEED, UNCHANGED, Task
from classroom.exercises.verdict import Verdict


def run(task: Task, namespace, sets, references=()) -> Verdict:
    """Call a task's functions and judge the outputs, both in this process.

    references : replace functions of earlier tasks"""
    try:
        with in_place(namespace, references):
            return task.judge(sets, call_on_sets(task.call, namespace, sets))
    except StudentError as error:
        return task.failed(error.kind, error.message)


def run_and_explain(task: Task, namespace, references=()) -> Verdict:
    """Run a task on the open inputs, and add the mistake and the smallest failing case."""
    with in_place(namespace, references):
        return _run_and_explain(task, namespace)


def _run_and_explain(task, namespace):
    sets = task.draw_inputs(OPEN_SEED)
    try:
        answers = call_on_sets(task.call, namespace, sets)
        verdict = task.judge(sets, answers)
    except StudentError as error:
        verdict, answers = task.failed(error.kind, error.message), {MAIN: error}
    if verdict.full or verdict.kind not in (None, "raised", "malformed"):
        return verdict
    verdict = add_mistake_and_hint(task, verdict, lambda: (sets, answers))

    def run_again(inputs):
        return task.call(namespace, inputs)

    try:
        if isinstance(answers[MAIN], StudentError):
            case = failing_cases.smallest_raising_case(task, sets, answers[MAIN], run_again)
        else:
            case = failing_cases.smallest_failing_case(task, sets, answers, run_again)
    except KeyboardInterrupt:  # perhaps the time limit: the verdict stays
        return verdict
    return replace(verdict, case=failing_case_text.format_case(task, case)) if case else verdict


def add_mistake_and_hint(task: Task, verdict: Verdict, answered) -> Verdict:
    """Choose the hint for a failed verdict by fingerprint, otherwise by error pattern.

    answered : () -> the open sets and the answers; called only if needed, may raise
    StudentError."""
    broken = {law.name for law in verdict.laws if law.failed}
    if verdict.problem or verdict.diagnosis == IDLE.name or broken == {UNCHANGED.name}:
        return verdict  # no hint is needed
    try:
        sets, answers = answered()
    except StudentError:
        return verdict
    mistake = fingerprints.find_mistake(task, sets, answers)
    if verdict.diagnosis and (not mistake or mistake.family):  # the diagnosis is more specific
        return verdict
    mistake = mistake or unrecognised_mistakes.describe_error_pattern(task, sets, answers)
    return verdict.explained_by(mistake) if mistake else verdict
