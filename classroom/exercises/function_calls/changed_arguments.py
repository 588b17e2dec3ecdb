"""Detect whether a student's function changes its arguments in place (mutation)."""

import numpy as np

CHANGED = "arguments changed"
"""Name of the output that lists the changed arguments, counted from 0."""

_SLAM = ["x", "P", "ids", "u", "seen", "z", "C", "R"]
_SAMPLES = ["rows", "weights", "u", "C", "p", "z", "R", "rng"]
ARGUMENT_NAMES = {
    "02-noise": ["ranges", "error", "dropouts", "rng"],
    "06-slam": _SLAM,
    "06-outliers": _SLAM,
    "08-pillar": ["points", "band", "largest", "needed", "tries", "rng"],
    "09-life": ["book", "seen", "N", "lives"],
    "09-clean-map": ["x", "P", "us", "C", "scans", "R", "far"],
    "11-draw": ["weights", "rng"],
    "11-localise": _SAMPLES,
    "11-fastslam": ["rows", "weights", "p", "P", "u", "C", "z", "R", "rng"],
    "11-kidnapped": _SAMPLES,
    "12-relocalise": ["start", "motions", "measurements", "posts"],
    "15-step": ["poses", "edges"],
    "15-gate": ["poses", "H", "loop", "gates"],
    "15-false-loops": ["poses", "edges", "loops"],
}
"""Argument names in the notebook, by task id, if the inputs have other names."""


class WatchedFunction:
    """A function that is called on copies of its arguments; ``changed`` lists the changed ones."""

    def __init__(self, function):
        self._function, self.changed = function, set()

    def __call__(self, *arguments):
        given = [_copied(argument) for argument in arguments]
        try:
            return self._function(*given)
        finally:
            pairs = zip(arguments, given, strict=True)
            self.changed.update(k for k, pair in enumerate(pairs) if not _same(*pair))


def _copied(value):
    if isinstance(value, np.ndarray):
        return value.copy()
    if type(value) in (list, tuple):
        return type(value)(_copied(item) for item in value)
    if type(value) is dict:
        return {key: _copied(item) for key, item in value.items()}
    return value


def _same(before, after):
    if isinstance(before, np.ndarray):
        same = before.shape == after.shape and before.dtype == after.dtype
        # compare bytes, because NaN is not equal to itself
        return same and before.tobytes() == after.tobytes()
    if type(before) in (list, tuple):
        return len(before) == len(after) and all(map(_same, before, after))
    if type(before) is dict:
        return before.keys() == after.keys() and all(_same(before[k], after[k]) for k in before)
    # a number in a list or dict may have been replaced; other objects are not inspected
    return before is after or (isinstance(before, int | float | str | bytes) and before == after)
