"""Task 03-gain: no other gain leaves smaller errors of samples of the prior."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex03_kalman_filter.beliefs import SIZES, before_measurement, samples, turned
from course.exercises.ex03_kalman_filter.calls import CALLS


def inputs(rng, *sizes, **more):
    """Beliefs and sensors without measurements."""
    made = before_measurement(rng, *sizes, **more)
    return {name: made[name] for name in ("P", "H", "R")}


def best(i):
    """The gain by regression of sampled errors on sampled innovations."""
    errors, noise = samples(i["P"], i["R"])
    innovations = errors @ turned(i["H"]) + noise
    # the normal equations of: errors ≈ innovations Kᵀ
    shared = turned(errors) @ innovations
    return {"result": turned(np.linalg.solve(turned(innovations) @ innovations, turned(shared)))}


def _blind(rng):
    made = inputs(rng)
    return made | {"H": np.zeros_like(made["H"])}


def _unrelated(rng):
    made = inputs(rng, 2, 1)
    diagonal = np.einsum("rii->ri", made["P"])
    H = np.broadcast_to([[1.0, 0.0]], made["H"].shape)
    return made | {"P": diagonal[:, None] * np.eye(2), "H": H.copy()}


def _whole(rng):
    P = np.array([[[3.0, 1.0], [1.0, 2.0]], [[5.0, -2.0], [-2.0, 4.0]]])
    return {"P": P, "H": np.array([[[1.0, 0.0]], [[2.0, 1.0]]]), "R": np.array([[[1.0]], [[3.0]]])}


def _share(i):
    errors, noise = samples(i["P"], i["R"])
    innovations = errors @ turned(i["H"]) + noise
    square = turned(innovations) @ innovations / innovations.shape[1]
    return {"covariance of the innovation": square[0]}


GAIN = Task(
    id="03-gain",
    title="The Kalman gain",
    call=CALLS["03-gain"],
    inputs=inputs,
    shapes=lambda i: {"result": (i["H"].shape[2], i["H"].shape[1])},
    laws=(
        equals(
            "lowest",
            3,
            "no other K leaves a smaller mean square error of samples of the prior",
            best,
            asks="Which K do you expect if R is almost zero, and which K if R is very large? Does "
            "your gain give these results? Which unit has the entry of K that corrects a speed by "
            "a range?",
            step=_share,
        ),
    ),
    probes=(
        *(Probe(name, lambda rng, s=s: inputs(rng, *s)) for name, s in SIZES.items()),
        Probe("a sensor with 1/100 of the σ", lambda rng: inputs(rng, precision=100.0)),
        Probe("H = 0: the measurement does not depend on the state", _blind),
        Probe("states with uncorrelated errors", _unrelated),
        Probe("whole numbers", _whole),
    ),
    begins=(
        "A prior with variance 4 and a measurement with variance 1 of the same "
        "number: which weight does the measurement get?",
        "Which covariance does the innovation z − H x have?",
    ),
    references=(Reference("gain", "P H R", best),),
)
