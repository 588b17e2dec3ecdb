"""The ladder of hints: what ``hint`` says of a task, one rung further at each call."""

import numpy as np

from slamlab.exercises import case_text, cases
from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.input_sets import run_sets
from slamlab.exercises.task import OPEN_SEED

_climbed = {}  # (task's id, law's name) to how often a hint was asked for, in this kernel


def next_rung(task, namespace) -> str:
    """What to say next of the first law that a student's functions break: a question, then a step.

    Parameters
    ----------
    task : Task
    namespace : the student's names

    Returns
    -------
    str
    """
    sets = task.draw(OPEN_SEED)
    try:
        answers = run_sets(task.drive, namespace, sets)
    except StudentError as error:
        first = task.laws[0]
        begin = (
            f"A question to begin with: {first.asks}" if first.asks else f"It asks: {first.says}"
        )
        return f"{error.message}\n{begin}"
    try:
        case = cases.smallest(task, sets, answers, lambda inputs: task.drive(namespace, inputs))
    except KeyboardInterrupt:  # the time limit, perhaps: a case that is not shrunk will do
        case = cases.smallest(task, sets, answers)
    if case is None:
        return f"{task.id} breaks no law: there is nothing to hint at"
    rung = _climbed.get((task.id, case.law.name), 0)
    _climbed[task.id, case.law.name] = rung + 1
    asks = case.law.asks or f"Where does your answer leave this law: {case.law.says}?"
    if rung == 0:
        more = "\nCalled again, hint shows a step on the way." if case.law.step else ""
        return f"A question: {asks}{more}"
    return _step(task, case, asks)


def _step(task, case, asks):
    """What a right solution finds on the way, at the smallest case."""
    text = case_text.format_case(task, case) or ""
    quantities = case.law.step(case.inputs) if case.law.step else {}
    if not quantities:
        return f"A question: {asks}\n{text}"
    shown = [
        "      " + case_text.format_numbers(name, _first(value, case.one)).replace("\n", "\n      ")
        for name, value in quantities.items()
    ]
    return "\n".join([text, "    On the way a right solution finds", *shown])


def _first(value, one):
    value = np.asarray(value, dtype=float)
    return value[0] if one and value.ndim and len(value) == 1 else value
