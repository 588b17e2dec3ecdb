"""Task 03-update: the posterior of belief and measurement, by least squares."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex03_kalman_filter.beliefs import (
    SIZES,
    before_measurement,
    least_squares,
    times,
)
from course.exercises.ex03_kalman_filter.calls import CALLS


def _with_innovation(rng, size):
    made = before_measurement(rng)
    expected = times(made["H"], made["x"])
    return made | {"z": expected + size * (made["z"] - expected)}


def _contradictory(rng):
    made = before_measurement(rng, 2, 2)
    made["H"] = np.broadcast_to([[1.0, 0.0], [1.0, 0.0]], made["H"].shape).copy()
    made["z"] = made["x"][:, :1] + [2.0, -1.0]
    return made


def _posterior(i):
    """The posterior for any x and P that a filter may pass, also if P is singular."""
    v, PH = i["z"] - times(i["H"], i["x"]), i["P"] @ i["H"].swapaxes(1, 2)
    K = PH @ np.linalg.inv(i["H"] @ PH + i["R"])
    return {"x": i["x"] + times(K, v), "P": i["P"] - K @ i["H"] @ i["P"]}


def _innovation(i):
    PH = i["P"] @ i["H"].swapaxes(1, 2)
    S = i["H"] @ PH + i["R"]
    v = i["z"] - times(i["H"], i["x"])
    return {"z − H x": v[0], "its covariance": S[0], "gain": (PH @ np.linalg.inv(S))[0]}


UPDATE = Task(
    id="03-update",
    title="The update",
    call=CALLS["03-update"],
    inputs=before_measurement,
    shapes=lambda i: {"x": i["x"].shape, "P": i["P"].shape},
    laws=(
        equals(
            "estimate",
            2,
            "x is the weighted least-squares estimate from prior and measurement",
            lambda i: {"x": least_squares(i)[0]},
            asks="Suppose that z is equal to the predicted measurement. What should x become? "
            "Otherwise, which unit has the factor of the innovation, and what does this factor "
            "become if R is far larger than H P Hᵀ?",
            step=_innovation,
        ),
        equals(
            "covariance",
            2,
            "P is the covariance of that estimate's error",
            lambda i: {"P": least_squares(i)[1]},
            asks="Write the new error, x̃ − K (H x̃ + ε), and multiply it by its transpose. Which "
            "terms remain in the expected value? Does your P contain all of them?",
            step=_innovation,
        ),
    ),
    probes=(
        *(Probe(name, lambda rng, s=s: before_measurement(rng, *s)) for name, s in SIZES.items()),
        Probe("a measurement equal to the predicted one", lambda rng: _with_innovation(rng, 0)),
        Probe("a measurement with a very large innovation", lambda rng: _with_innovation(rng, 30)),
        Probe("two measurements that contradict each other", _contradictory),
        Probe("a sensor with 1/20 of the σ", lambda rng: before_measurement(rng, precision=20)),
    ),
    references=(Reference("update", "x P z H R", _posterior, "x P"),),
    begins=(
        "By which vector does the measurement differ from its prediction?",
        "Which part of the innovation does the gain add to x?",
    ),
)
