"""Manual changes of marks: each change is checked and recorded as a row of the ledger."""

import math

from classroom.exercises import catalogue
from classroom.grading import remarks

MAX_LENGTH = 4000


class ChangeRefused(Exception):
    """A change is refused; the message explains why."""


def set_points(state, result, seen, task, points, reason):
    """Set a task's points with a reason for the student; raise ChangeRefused if they are invalid.

    points : None for the autograder's points. seen : number of manual changes when the submission
    was displayed."""
    known = {one.id: one for one in catalogue.exercise(result.exercise).tasks}
    if task not in known:
        raise ChangeRefused(f"exercise {result.exercise} has no task {task}")
    most = known[task].points
    number = isinstance(points, int | float) and not isinstance(points, bool)
    if points is not None and not (number and math.isfinite(points)):
        raise ChangeRefused("points must be a number such as 1.5")
    if points is not None and not 0 <= points <= most:
        raise ChangeRefused(f"{task} must have 0 to {most:g} points, not {points:g}")
    reason = _text(reason)
    if not reason:
        raise ChangeRefused("a reason is missing: the student reads it, and the ledger records it")
    state.book.override_points(_attempt(state, result, seen), task, points, reason)


def comment(state, result, seen, text):
    """Replace the comment, or remove it if the text is empty; raise ChangeRefused for a long
    text."""
    body = {"exercise": result.exercise, "text": _text(text)}
    state.book.change(remarks.COMMENT, _attempt(state, result, seen), **body)


def answer(state, result, seen, request, text):
    """Answer the regrade request with this key; raise ChangeRefused if this is not possible."""
    text, place = _text(text), (result.student.id, result.exercise)
    if request not in [body["request"] for body in state.requests_of(*place)]:
        raise ChangeRefused("this request does not exist")
    if not text:
        raise ChangeRefused("an answer is missing: the student reads it")
    body = {"exercise": result.exercise, "request": request, "text": text}
    state.book.change(remarks.ANSWER, _attempt(state, result, seen), **body)


def _attempt(state, result, seen):
    """Return the record of the attempt that counts; raise ChangeRefused if the submission has
    changed since it was displayed."""
    if result.mark is None:
        raise ChangeRefused("there is no submission")
    done = state.history_of(result)
    if len(done) != seen:
        who = f"{done[-1][0]['who']} has" if done else "somebody has"
        raise ChangeRefused(f"{who} changed the submission. Check the change, then save again")
    return result.mark.record


def _text(text):
    if not isinstance(text, str):
        raise ChangeRefused("a text is missing")
    text = text.replace("\r\n", "\n").strip()
    if len(text) > MAX_LENGTH:
        raise ChangeRefused(
            f"the text has {len(text)} characters; at most {MAX_LENGTH} are allowed"
        )
    return text
