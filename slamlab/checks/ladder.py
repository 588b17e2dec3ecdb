"""The ladder of hints: what ``hint`` says of a task, one rung further at each call."""

import numpy as np

from slamlab.exercises import case_text, cases
from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.input_sets import run_sets
from slamlab.exercises.task import OPEN_SEED
from slamlab.exercises.time_limit import time_limit

_climbed = {}  # (task's id, law's name) to how often a hint was asked for here, and of what last

_STEP = "a step on the way"
_LATER = "Hints go on once there is an answer to judge."
_LAST = "That was the last hint on this law."
_ONLY = "That is the only hint on this law: check tells all else that is known of it."


def offered(task, verdict) -> str:
    """What ``hint`` would say next of a task, as the end of a sentence; "" where nothing is new.

    Parameters
    ----------
    task : Task
    verdict : Verdict of that task, not full
    """
    broken = {result.name for result in verdict.laws if result.failed}
    law = next((law for law in task.all_laws if law.name in broken), None)
    if law is None:
        return ""
    climbed, _ = _climbed.get((task.id, law.name), (0, None))
    if climbed == 0:
        return "asks a question that leads on"
    return f"shows {_STEP}" if climbed == 1 and law.step else ""


def next_rung(task, namespace) -> str:
    """What to say next of the first law that a student's functions break: a question, then a step.

    Parameters
    ----------
    task : Task
    namespace : the student's names

    Returns
    -------
    str

    Raises
    ------
    TimeLimitExceeded : where the functions take longer than a check lets them
    """
    sets = task.draw(OPEN_SEED)
    try:
        with time_limit(task.drive.seconds):
            answers = run_sets(task.drive, namespace, sets)
    except StudentError as error:
        first = task.laws[0]
        begin = (
            f"A question to begin with: {first.asks}" if first.asks else f"It asks: {first.says}"
        )
        return case_text.wrapped(f"{error.message}\n{begin}\n{_LATER}")
    try:
        with time_limit(2 * task.drive.seconds):
            case = cases.smallest(task, sets, answers, lambda inputs: task.drive(namespace, inputs))
    except KeyboardInterrupt:  # the time limit, perhaps: a case that is not shrunk will do
        case = cases.smallest(task, sets, answers)
    if case is None:
        return f"{task.id} breaks no law: there is nothing to hint at"
    rung, answer = _climbed.get((task.id, case.law.name), (0, None)), _trace(answers)
    rung = 0 if rung[0] > 1 and rung[1] != answer else rung[0]  # another answer: from the beginning
    _climbed[task.id, case.law.name] = rung + 1, answer
    asks = case.law.asks or f"Where does your answer leave this law: {case.law.says}?"
    asks = case_text.wrapped(f"A question: {asks}")
    text, step = case_text.format_case(task, case), _step(case)
    if not (text or step):
        return f"{asks}\n{_ONLY}"
    if rung == 0:
        more = _STEP if step else "the case that fails" if case.one else "what came out of it all"
        return f"{asks}\nCalled again, hint shows {more}."
    if rung > 1:  # the case was shown: check shows it, too
        return "\n".join(filter(None, [asks, step, _LAST]))
    return "\n".join(filter(None, ["" if step else asks, text, step, _LAST]))


def _trace(answers):
    """What tells one answer from another: all that came back."""
    return hash(
        tuple(
            str(of) if isinstance(of, StudentError) else b"".join(a.tobytes() for a in of.values())
            for of in answers.values()
        )
    )


def _step(case):
    """What a right solution finds on the way, at the smallest case; "" where no law tells it."""
    quantities = case.law.step(case.inputs) if case.law.step else {}
    shown = [
        "      " + case_text.format_numbers(name, _first(value, case.one)).replace("\n", "\n      ")
        for name, value in quantities.items()
    ]
    return "\n".join(["    On the way a right solution finds", *shown]) if shown else ""


def _first(value, one):
    value = np.asarray(value, dtype=float)
    return value[0] if one and value.ndim and len(value) == 1 else value
