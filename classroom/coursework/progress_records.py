"""Record a student's progress: checks, answers, validations, minutes of work.

The record stays on this machine; builds, tests and graders write no record (see ``folder``)."""

import time
from datetime import datetime

from classroom.coursework import progress_file
from classroom.coursework.folder import course_folder, is_progress_kept

LONGEST_PAUSE = 10 * 60.0  # longest pause between two answers that counts as work [s]


class Stopwatch:
    """Time between two answers, limited to LONGEST_PAUSE."""

    def __init__(self, clock=time.monotonic):
        self._clock, self._last = clock, clock()

    def lap(self):
        """Return the time since the last lap [min], limited to ten minutes."""
        before, self._last = self._last, self._clock()
        return min(self._last - before, LONGEST_PAUSE) / 60.0


_stopwatch = Stopwatch()


def record_check(task, points, of):
    def change(progress, now):
        entry = _entry(progress["tasks"], task, {"times": 0, "first": now, "best": 0.0})
        best, times = max(points, entry["best"]), entry["times"] + 1
        entry |= {"points": points, "of": of, "best": best, "times": times, "last": now}

    _keep(f"ex{task[:2]}", change)


def record_answer(question, answer, right):
    def change(progress, now):
        entry = _entry(progress["questions"], question, {"times": 0})
        entry.setdefault("first", answer)
        entry |= {"answer": answer, "right": right, "times": entry["times"] + 1, "last": now}

    _keep(question.split("-")[0], change)


def record_validation(exercise, points, of):
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
    """Return the entry of an id; replace a malformed entry with a fresh one."""
    entry = entries.get(id)
    if not isinstance(entry, dict) or any(type(entry.get(k)) is not type(fresh[k]) for k in fresh):
        entry = entries[id] = dict(fresh)
    return entry
