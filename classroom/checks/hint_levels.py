"""Hint levels: each call of ``hint`` shows the next level (scaffolding) of what ``run_task`` chose
for a mistake: a question about it, a step on the way, and the sentence that names it."""

import time
import tomllib

import numpy as np

from classroom.checks.timed_runs import too_slow
from classroom.coursework.folder import course_folder
from classroom.exercises import failing_case_text, failing_cases, run_task
from classroom.exercises.function_calls import StudentError
from classroom.exercises.function_calls.run_and_pack import call_on_sets
from classroom.exercises.references import in_place
from classroom.exercises.task import OPEN_SEED, UNCHANGED
from classroom.exercises.time_limit import TimeLimitExceeded, time_limit

_shown_levels = {}  # (task id, mistake or law) to number of hints shown, and the answer's hash
_last_problems = {}  # task id to the problem of the last check that hint cannot find itself

_STEP, _NAMED = "a step on the way", "a sentence about your answer"
_BEGIN = "More hints follow once your functions return an answer that can be judged."
_LAST = "This is the last hint. check shows all other details."
COURSE_FILE = "course.toml"


def shows_hint_at_once():
    """Whether ``check`` shows the last hint at once: the course file in the course folder contains
    ``hints = "at once"``."""
    folder = course_folder()
    try:
        text = (folder / COURSE_FILE).read_text("utf-8-sig") if folder else ""
        return tomllib.loads(text).get("hints") == "at once"
    except (OSError, ValueError):
        return False


def describe_next_hint(task, verdict) -> str:
    """Describe what the next ``hint`` shows, as the end of a sentence; "" if nothing is new."""
    broken = {result.name for result in verdict.laws if result.failed}
    law = next((law for law in task.all_laws if law.name in broken), None)
    level, _ = _shown_levels.get(_key(task, verdict, law), (0, None))
    if law is None:
        return "asks a question to begin with" if not level and verdict.problem else ""
    if level == 0:
        known = "a mistake that the check recognised"
        return f"asks about {'the first broken law' if verdict.question is None else known}"
    kinds = [_STEP] * bool(law.step) + [_NAMED] * bool(verdict.hint)
    return f"shows {kinds[level - 1]}" if level <= len(kinds) else ""


def remember_check(task, verdict):
    """Remember the problem of a check, because ``hint`` may have more time or find no mistake."""
    found = verdict.problem if verdict.kind in ("time", "stopped", "borrowed") else None
    _last_problems[task.id] = found


def _key(task, verdict, law):
    known = verdict.question is not None
    return task.id, verdict.diagnosis if known else law.name if law else "begin"


def next_hint(task, namespace, references=()) -> str:
    """Return the next hint.

    references : replace functions of earlier tasks"""
    with in_place(namespace, references):
        return _next_hint(task, namespace)


def _next_hint(task, namespace):
    sets, began = task.draw_inputs(OPEN_SEED), []

    def timed_call(*arguments):
        began.append(time.perf_counter())
        return task.call(*arguments)

    try:  # twice the time, because the machine may have become busier since a check
        with time_limit(task.call.seconds * (1 if _last_problems.get(task.id) else 2)):
            answers = call_on_sets(timed_call, namespace, sets)
    except StudentError as error:
        return _begin(task, error.message)
    except TimeLimitExceeded:
        return _begin(task, too_slow(task), _slowest(sets, began, time.perf_counter()))
    end = time.perf_counter()
    verdict = task.judge(sets, answers)
    if verdict.problem:
        return _begin(task, verdict.problem)
    verdict = run_task.add_mistake_and_hint(task, verdict, lambda: (sets, answers))
    case = _smallest_case(task, namespace, sets, answers)
    if case is None and not verdict.full:  # a degenerate answer
        return _begin(task, f"A question: {verdict.question}", f"Hint: {verdict.hint}")
    if case is None and (problem := _last_problems.get(task.id)):
        lines = [f"The last check: {problem}"]
        lines += [_slowest(sets, began, end)] * (problem == too_slow(task))
        return _begin(task, *lines, "If you have changed your functions since, call check again.")
    if case is None:
        return f"Your answer to {task.id} breaks no law, so there is no hint."
    rungs = list(_rungs(task, verdict, case))
    key, answer = _key(task, verdict, case.law), _hash(answers)
    level, last = _shown_levels.get(key, (0, None))
    if level >= len(rungs):  # the last hint stays; another answer starts again
        level = len(rungs) - 1 if last == answer else 0
    _shown_levels[key] = level + 1, answer
    text, more = rungs[level][1], [name for name, _ in rungs[level + 1 :]]
    return f"{text}\n{f'Call hint again to see {more[0]}.' if more else _LAST}"


def _rungs(task, verdict, case):
    """Yield (name, text) of each hint."""
    asks = verdict.question or case.law.asks or f"Where is this broken: {case.law.says}?"
    yield "a question", failing_case_text.wrapped(f"A question: {asks}")
    if step := _step(case):
        yield _STEP, step
    if verdict.hint:
        yield _NAMED, failing_case_text.wrapped(f"Hint: {verdict.hint}")
    elif case.law is UNCHANGED:
        yield _NAMED, "Hint: Work on a copy of the argument, such as x = x.copy() or list(ids)."


def _begin(task, *lines):
    level, last = _shown_levels.get((task.id, "begin"), (0, None))
    _shown_levels[task.id, "begin"] = level + 1, lines
    shown = () if len(lines) == 1 and lines == last else lines  # an error's message once
    return failing_case_text.wrapped("\n".join([*shown, _question_to_begin(task, level)]))


def _slowest(sets, began, end):
    """Describe the inputs on which the functions took longest."""
    spent = np.diff([*began, end])
    name = list(sets)[spent.argmax()] or "the random inputs"
    return f"Your functions take longest with {name}: {spent.max():.2g} s."


def _question_to_begin(task, level):
    """Return the next question for a function that returns no answer yet."""
    questions = list(dict.fromkeys([*task.begins, *(law.asks for law in task.laws if law.asks)]))
    if not questions:
        return f"The first law is: {task.laws[0].says}\n{_BEGIN}"
    asked = questions[level % len(questions)]
    again = "Call hint again for another question.\n" if len(questions) > 1 else ""
    return f"A question to begin with: {asked}\n{again}{_BEGIN}"


def _smallest_case(task, namespace, sets, answers):
    try:
        with time_limit(2 * task.call.seconds):
            return failing_cases.smallest_failing_case(
                task, sets, answers, lambda inputs: task.call(namespace, inputs)
            )
    except KeyboardInterrupt:  # perhaps the time limit: take a case that is not shrunk
        return failing_cases.smallest_failing_case(task, sets, answers)


def _hash(answers):
    return hash(
        tuple(
            str(of) if isinstance(of, StudentError) else b"".join(a.tobytes() for a in of.values())
            for of in answers.values()
        )
    )


def _step(case):
    """Format a law's step: a sentence, or the intermediate results of a correct solution for the
    smallest failing case."""
    if isinstance(case.law.step, str):
        return case.law.step and failing_case_text.wrapped(f"A step: {case.law.step}")
    quantities = case.law.step(case.inputs)
    shown = [
        "      "
        + failing_case_text.format_numbers(name, _first(value, case.one)).replace("\n", "\n      ")
        for name, value in quantities.items()
    ]
    title = "    Intermediate results of a correct solution for the case that check shows:"
    return "\n".join([title, *shown]) if shown else ""


def _first(value, one):
    value = np.asarray(value, dtype=float)
    return value[0] if one and value.ndim and len(value) == 1 else value
