"""Task 06-augment: a landmark seen for the first time, and whom it is related to."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex06.beliefs import beliefs, covariances, either_sign, moments
from slamlab.models import jacobians

OLD, NEW = np.s_[:-2], np.s_[-2:]


def sights(rng, rows=8, landmarks=2):
    """Beliefs, and a range and bearing at which something new was seen, with its noise."""
    x, P = beliefs(rng, rows, landmarks)
    z = np.column_stack([rng.uniform(2, 6, rows), either_sign(rng, 0.4, 2.6, rows)])
    sigma = np.column_stack([rng.uniform(0.05, 0.15, rows), rng.uniform(0.02, 0.04, rows)])
    return {"x": x, "P": P, "z": z, "R": covariances(rng, sigma)}


def _exactly_known(rng):
    inputs = sights(rng, 2, 1)
    return inputs | {"P": 0 * inputs["P"]}


def _straight_ahead(rng):
    inputs = sights(rng, 2, 1)
    inputs["x"][:, 2], inputs["z"][:, 1] = [0, np.pi / 2], 0
    return inputs | {"R": inputs["R"] * np.eye(2)}


def _place(states, z):
    p = models.g(states[:3].T, z.T)
    return np.vstack([states + 0 * z[:1], p.T])


def want(inputs):
    """The state with the new landmark, x (k, n + 2), and its covariance P (k, n + 2, n + 2)."""
    found = [moments(_place, (x, z), P, R) for x, P, z, R in zip(*inputs.values(), strict=True)]
    return {"x": np.array([x for x, _ in found]), "P": np.array([P for _, P in found])}


def _jacobians(inputs):
    pairs = list(zip(inputs["x"], inputs["z"], strict=True))
    return {
        "J_xr": np.array([jacobians.J_xr(x, z) for x, z in pairs]),
        "J_z": np.array([jacobians.J_z(x, z) for x, z in pairs]),
    }


def _parts(inputs, outputs):
    x, P = outputs["x"], outputs["P"]
    return {
        "x": x,
        "old": P[:, OLD, OLD],
        "P_nn": P[:, NEW, NEW],
        "rows": P[:, NEW, OLD],
        "columns": P[:, OLD, NEW],
    }


AUGMENT = Task(
    id="06-augment",
    title="Augment: a new landmark and its relatives",
    drive=DRIVES["06-augment"],
    inputs=sights,
    probes=(
        Probe("an empty map", lambda rng: sights(rng, 2, 0)),
        Probe("a map of six landmarks", lambda rng: sights(rng, 1, 6)),
        Probe("a pose and a map that are exactly known", _exactly_known),
        Probe("a landmark straight ahead", _straight_ahead),
    ),
    shapes=lambda inputs: {
        "x": (len(inputs["x"]), inputs["x"].shape[1] + 2),
        "P": (len(inputs["x"]), inputs["x"].shape[1] + 2, inputs["x"].shape[1] + 2),
    },
    parts=_parts,
    laws=(
        equals(
            "old",
            1,
            "what was in the state before stays as it was, in x and in P",
            want,
            {"x": OLD, "P": (OLD, OLD)},
            angles={"x": 2},
            asks="What does a first sight of something teach you about where you are yourself?",
        ),
        equals(
            "place",
            1,
            "the new landmark is appended where g puts it",
            want,
            {"x": NEW},
            asks="Which part of x is the pose, and in whose frame is z measured?",
        ),
        equals(
            "P_nn",
            1,
            "P_nn is the covariance of the places that poses that err and sights that err give",
            want,
            {"P": (NEW, NEW)},
            asks="Two things err where a new landmark is placed. Which Jacobian belongs to which?",
            step=_jacobians,
        ),
        equals(
            "P_nr",
            1,
            "P_nr, with its mirror image, is what they share with the pose",
            want,
            {"P": [(NEW, np.s_[:3]), (np.s_[:3], NEW)]},
            asks="By how much does the new place move when the pose moves a little?",
            step=_jacobians,
        ),
        equals(
            "P_ni",
            1,
            "P_ni, with its mirror image, is what they share with the old landmarks",
            want,
            {"P": [(NEW, np.s_[3:-2]), (np.s_[3:-2], NEW)]},
            asks="The old landmarks share an error with the robot. Who hands it on to the new one?",
            step=_jacobians,
        ),
    ),
)
