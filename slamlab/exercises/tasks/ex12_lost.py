"""Task 12-lost: from when on a run is lost for good, judged by what the word means."""

import numpy as np

from slamlab.exercises.drives.ex12 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

STEPS = 40
STRAY, GONE, ALWAYS = 6, 14, 24  # the first runs of these kinds


def runs(rng, count=26):
    """Runs that never stray, that stray and come back, that stray, come back and are lost.

    The last two are lost from the start on. Limits and errors are generic: none is met exactly.
    """
    limit = rng.uniform(0.08, 0.3, count)
    errors = limit[:, None] * rng.uniform(0.1, 0.95, (count, STEPS))
    far = limit[:, None] * rng.uniform(1.05, 4.0, (count, STEPS))
    for i in range(STRAY, count):
        begin, length = rng.integers(4, 12), rng.integers(2, 8)
        out = slice(begin, begin + length)
        errors[i, out] = far[i, out]
        if i >= GONE:
            last = rng.integers(24, STEPS - 3)
            errors[i, last:] = far[i, last:]
    errors[ALWAYS:] = far[ALWAYS:]
    return {"errors": errors, "limit": limit}


def is_since(errors, limit, since):
    """Whether a run is lost from there on, and was not one reading before."""
    if since == -1:
        return errors[-1] <= limit
    k = int(since)
    if k != since or not 0 <= k < len(errors):
        return False
    return (errors[k:] > limit).all() and (k == 0 or errors[k - 1] <= limit)


def _holds(rows):
    def holds(inputs, outputs):
        runs = zip(inputs["errors"], inputs["limit"], outputs["result"], strict=True)
        return np.array([is_since(*run) for run in runs])[rows]

    return holds


# ---- mistakes: another date of the same run ----------------------------------------------------


def last_stretch(far):
    """The right date."""
    if not far[-1]:
        return -1
    near = np.flatnonzero(~far)
    return near[-1] + 1 if len(near) else 0


def first_time(errors, far):
    return np.argmax(far) if far.any() else -1


def first_time_if_lost(errors, far):
    return np.argmax(far) if far[-1] else -1


def one_early(errors, far):
    right = last_stretch(far)
    return right - 1 if right > 0 else right


def last_far(errors, far):
    return np.flatnonzero(far)[-1] if far.any() else -1


def largest(errors, far):
    return np.argmax(errors) if far.any() else -1


def counted(errors, far):
    return far.sum() if far[-1] else -1


def from_the_end(errors, far):
    right = last_stretch(far)
    return len(far) - right if right >= 0 else -1


def last_crossing(errors, far):
    """The last time it went too far, whether it came back or not."""
    crossings = np.flatnonzero(far & ~np.concatenate([[False], far[:-1]]))
    return crossings[-1] if len(crossings) else -1


def zero_for_never(errors, far):
    return max(last_stretch(far), 0)


def yes_or_no(errors, far):
    return float(far[-1])


HINTS = {
    "first-time": (
        "This is the first time that the run strayed. It may have come back: lost is who stays "
        "away to the end.",
        (first_time, first_time_if_lost),
    ),
    "last-crossing": (
        "This is the last time that the run strayed, but it may have come back after that. Lost is "
        "only who is still too far off at the last reading.",
        (last_crossing,),
    ),
    "one-early": (
        "One reading too early: this is the last good one. Lost begins with the next.",
        (one_early,),
    ),
    "last-far": (
        "This is the last reading that was too far off. Asked for is the first of those that "
        "reach to the end.",
        (last_far,),
    ),
    "largest": ("This is where the error is largest, not where the loss began.", (largest,)),
    "counted": (
        "This is how many readings were too far off, not since when.",
        (counted,),
    ),
    "from-the-end": (
        "This counts from the end: so many readings were lost. Asked for is the number of the "
        "first of them, counted from 0.",
        (from_the_end,),
    ),
    "zero-for-never": (
        "A run that is not lost gives 0, which is a date. Return −1 for it.",
        (zero_for_never,),
    ),
    "yes-or-no": (
        "This says whether the run is lost. Asked for is since when, or −1.",
        (yes_or_no,),
    ),
}


def _dated(*rules):
    def matches(inputs, outputs):
        far = inputs["errors"] > inputs["limit"][:, None]
        return any(
            np.array_equal(
                outputs["result"],
                [rule(e, f) for e, f in zip(inputs["errors"], far, strict=True)],
            )
            for rule in rules
        )

    return matches


LOST = Task(
    id="12-lost",
    title="Lost, and since when",
    drive=DRIVES["12-lost"],
    inputs=runs,
    shapes={"result": ()},
    laws=(
        Law(
            "stays",
            1,
            "a run that never strays, or comes back, is not lost: −1",
            _holds(slice(0, GONE)),
        ),
        Law(
            "since",
            3,
            "from the date on all errors are beyond the limit, and the one before was not",
            _holds(slice(GONE, ALWAYS)),
        ),
        Law("always", 1, "a run that is never near is lost since 0", _holds(slice(ALWAYS, None))),
    ),
    diagnoses=tuple(Diagnosis(name, hint, _dated(*rules)) for name, (hint, rules) in HINTS.items()),
)
