"""Progress of a student: what was checked, answered and validated, and the minutes it took.

Nothing leaves the machine. Nothing is kept where no student sits: see ``folder``.
"""

import time
from datetime import datetime

from slamlab.coursework import progress_file
from slamlab.coursework.folder import course_folder, is_progress_kept

LONGEST_PAUSE = 10 * 60.0  # between two answers that counts as work [s]


class Stopwatch:
    """Time between two answers of a kernel; a long pause counts as a short one.

    Parameters
    ----------
    clock : callable() -> float [s]
    """

    def __init__(self, clock=time.monotonic):
        self._clock, self._last = clock, clock()

    def lap(self):
        """Minutes since the last lap, at most ten; float [min]."""
        before, self._last = self._last, self._clock()
        return min(self._last - before, LONGEST_PAUSE) / 60.0


_stopwatch = Stopwatch()


def keep_check(task, points, of):
    """Keep what a check of a task said.

    Parameters
    ----------
    task : str, the task's id such as "04-h-robot"
    points, of : float
    """

    def change(progress, now):
        entry = _entry(progress["tasks"], task, {"times": 0, "first": now, "best": 0.0})
        best, times = max(points, entry["best"]), entry["times"] + 1
        entry |= {"points": points, "of": of, "best": best, "times": times, "last": now}

    _keep(f"ex{task[:2]}", change)


def keep_answer(question, answer, right):
    """Keep the answer to a question.

    Parameters
    ----------
    question : str, its id such as "04-leaning", of an exercise "ex04-sign"
    answer : str or float
    right : bool
    """

    def change(progress, now):
        entry = _entry(progress["questions"], question, {"times": 0})
        entry.setdefault("first", answer)
        entry |= {"answer": answer, "right": right, "times": entry["times"] + 1, "last": now}

    _keep(question.split("-")[0], change)


def keep_validation(exercise, points, of):
    """Keep what validating an exercise's file said.

    Parameters
    ----------
    exercise : str, its number such as "04"
    points, of : float
    """

    def change(progress, now):
        progress["validated"][exercise] = {"points": points, "of": of, "last": now}

    _keep(f"ex{exercise}", change)


def _keep(notebook, change):
    folder = course_folder()
    if folder is None or not is_progress_kept():
        return
    now, lap = datetime.now().replace(microsecond=0), _stopwatch.lap()

    def both(progress):
        change(progress, now.isoformat())
        spent = progress["minutes"].get(notebook)
        spent = spent if isinstance(spent, int | float) else 0.0
        progress["minutes"][notebook] = round(spent + lap, 2)

    progress_file.change(folder, both, now)


def _entry(entries, id, fresh):
    """The entry of an id, made anew where there is none, or somebody edited it into another."""
    entry = entries.get(id)
    if not isinstance(entry, dict) or any(type(entry.get(k)) is not type(fresh[k]) for k in fresh):
        entry = entries[id] = dict(fresh)
    return entry
