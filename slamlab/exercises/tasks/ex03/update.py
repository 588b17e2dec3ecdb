"""Task 03-update: what belief and measurement together say, by least squares."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex03.beliefs import SIZES, before_measurement, least_squares, times


def _with_innovation(rng, size):
    """Measurements that are off what is expected by so many times more than usual."""
    made = before_measurement(rng)
    expected = times(made["H"], made["x"])
    return made | {"z": expected + size * (made["z"] - expected)}


def _contradictory(rng):
    """One number measured twice, with results that cannot both be right."""
    made = before_measurement(rng, 2, 2)
    made["H"] = np.broadcast_to([[1.0, 0.0], [1.0, 0.0]], made["H"].shape).copy()
    made["z"] = made["x"][:, :1] + [2.0, -1.0]
    return made


def _innovation(i):
    return {"z − H x": (i["z"] - times(i["H"], i["x"]))[0]}


UPDATE = Task(
    id="03-update",
    title="The update",
    drive=DRIVES["03-update"],
    inputs=before_measurement,
    shapes=lambda i: {"x": i["x"].shape, "P": i["P"].shape},
    laws=(
        equals(
            "estimate",
            2,
            "x is the weighted least squares estimate from belief and measurement",
            lambda i: {"x": least_squares(i)[0]},
            asks="Suppose that z is exactly what was expected: what should become of x? And of "
            "which belief is the gain, of the one before the measurement or of the one after it?",
            step=_innovation,
        ),
        equals(
            "covariance",
            2,
            "P is the covariance of that estimate's error",
            lambda i: {"P": least_squares(i)[1]},
            asks="Write the new error, x̃ − K (H x̃ + ε), and multiply it by its transpose: which "
            "terms are left when you take the expected value, and does your P hold all of them?",
        ),
    ),
    probes=(
        *(Probe(name, lambda rng, s=s: before_measurement(rng, *s)) for name, s in SIZES.items()),
        Probe("a measurement that is just what was expected", lambda rng: _with_innovation(rng, 0)),
        Probe("a measurement that is far off", lambda rng: _with_innovation(rng, 30)),
        Probe("two measurements that contradict each other", _contradictory),
        Probe("a sensor that is twenty times surer", lambda rng: before_measurement(rng, surer=20)),
    ),
)
