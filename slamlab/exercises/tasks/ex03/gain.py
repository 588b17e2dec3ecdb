"""Task 03-gain: no gain leaves smaller errors of samples of the belief."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex03.beliefs import SIZES, before_measurement, samples, turned


def inputs(rng, *sizes, **more):
    """Beliefs and sensors, the measurement itself left out."""
    made = before_measurement(rng, *sizes, **more)
    return {name: made[name] for name in ("P", "H", "R")}


def best(i):
    """The gain with which samples of the errors are told best from those of the innovations."""
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
    """How much errors and innovations scatter, and how large innovations are."""
    errors, noise = samples(i["P"], i["R"])
    innovations = errors @ turned(i["H"]) + noise
    square = turned(innovations) @ innovations / innovations.shape[1]
    return {"covariance of the innovation": square[0]}


GAIN = Task(
    id="03-gain",
    title="The gain",
    drive=DRIVES["03-gain"],
    inputs=inputs,
    shapes=lambda i: {"result": (i["H"].shape[2], i["H"].shape[1])},
    laws=(
        equals(
            "lowest",
            3,
            "no other K leaves a smaller mean square error of samples of the belief",
            best,
            asks="Let the sensor become perfect, then useless: which K do you want in each case, "
            "and which does yours give? Which units must K have to turn metres into metres per "
            "second?",
            step=_share,
        ),
    ),
    probes=(
        *(Probe(name, lambda rng, s=s: inputs(rng, *s)) for name, s in SIZES.items()),
        Probe("a sensor that is a hundred times surer", lambda rng: inputs(rng, surer=100.0)),
        Probe("a sensor that sees nothing of the state", _blind),
        Probe("states that are unrelated", _unrelated),
        Probe("whole numbers", _whole),
    ),
)
