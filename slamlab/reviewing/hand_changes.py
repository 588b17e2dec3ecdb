"""Changes by hand: each is checked, and becomes a row of the ledger with who made it."""

import math

from slamlab.exercises import catalogue
from slamlab.grading import remarks

MOST_LETTERS = 4000


class Refused(Exception):
    """A change is not made; the text says why."""


def set_points(state, standing, seen, task, points, reason):
    """Set the points of a task by hand.

    Parameters
    ----------
    state : ClassState, refreshed
    standing : Standing
    seen : int, how much had been done by hand to the submission when it was looked at
    task : str
    points : float
    reason : str, which the student reads

    Raises
    ------
    Refused
    """
    known = {one.id: one for one in catalogue.exercise(standing.exercise).tasks}
    if task not in known:
        raise Refused(f"exercise {standing.exercise} has no task {task}")
    most = known[task].points
    if isinstance(points, bool) or not isinstance(points, int | float) or not math.isfinite(points):
        raise Refused("points are a number such as 1.5")
    if not 0 <= points <= most:
        raise Refused(f"{task} has 0 to {most:g} points, not {points:g}")
    reason = _text(reason)
    if not reason:
        raise Refused("say why: the student reads it, and it stands in the ledger")
    submission = _submission(state, standing, seen)
    state.book.override_points(submission, standing.exercise, task, points, reason)


def comment(state, standing, seen, text):
    """Write a comment to the student in the place of one before; an empty one takes it away.

    Parameters
    ----------
    state, standing, seen : as of :func:`set_points`
    text : str

    Raises
    ------
    Refused
    """
    body = {"exercise": standing.exercise, "text": _text(text)}
    state.book.note(remarks.COMMENT, body, _submission(state, standing, seen))


def answer(state, standing, seen, request, text):
    """Answer a request for another look; the student reads both. A later answer takes its place.

    Parameters
    ----------
    state, standing, seen : as of :func:`set_points`
    request : str, its key
    text : str

    Raises
    ------
    Refused
    """
    text, place = _text(text), (standing.student.id, standing.exercise)
    if request not in [body["request"] for body in state.requests_of(*place)]:
        raise Refused("there is no such request")
    if not text:
        raise Refused("say what came of it: the student reads it")
    body = {"exercise": standing.exercise, "request": request, "text": text}
    state.book.note(remarks.ANSWER, body, _submission(state, standing, seen))


def _submission(state, standing, seen):
    """The submission that is meant, unless somebody has changed it since it was looked at."""
    if standing.mark is None:
        raise Refused("nothing was handed in")
    submission = standing.mark.record.submission
    done = state.history.get(submission, [])
    if len(done) != seen:
        who = f"{done[-1][0]['who']} has" if done else "somebody has"
        raise Refused(f"{who} changed it meanwhile: look again, then decide")
    return submission


def _text(text):
    if not isinstance(text, str):
        raise Refused("a text is missing")
    text = text.replace("\r\n", "\n").strip()
    if len(text) > MOST_LETTERS:
        raise Refused(f"{len(text)} letters; {MOST_LETTERS} are the most")
    return text
