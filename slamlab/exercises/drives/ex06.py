"""Drives of exercise 06, EKF-SLAM: one call per belief, and whole runs step by step."""

import numpy as np

from slamlab.exercises.drives import Drive
from slamlab.exercises.drives.slam_step import SLAM_STEP, belief, drive_of


def _beliefs(functions, inputs, grows=0):
    """Call the first function on every belief and keep the two results apart."""
    name, function = next(iter(functions.items()))
    n = inputs["x"].shape[1] + grows
    found = [belief(function(*row), name, n) for row in _rows(inputs)]
    return {"x": np.array([x for x, _ in found]), "P": np.array([P for _, P in found])}


def _rows(inputs):
    """The calls that inputs stand for; what counts landmarks is a whole number."""
    for row in zip(*inputs.values(), strict=True):
        yield [np.array(a) if a.ndim else int(a) for a in row]


def _augmented(functions, inputs):
    return _beliefs(functions, inputs, grows=2)


def _updated(functions, inputs):
    return _beliefs(functions, inputs)


def _merged(functions, inputs):
    return _beliefs(functions, inputs, grows=-2)


DRIVES = {
    "06-augment": Drive(("augment",), _augmented),
    "06-update": Drive(("update",), _updated),
    "06-slam": SLAM_STEP,
    "06-same": Drive(("merge",), _merged),
    "06-false-sights": drive_of("careful_step"),
}
