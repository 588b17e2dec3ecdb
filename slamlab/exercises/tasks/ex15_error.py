"""Task 15-error: how far a pose is from where an edge says it is."""

from functools import partial

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex04_mistakes import mistake
from slamlab.geometry import between, compose, wrap

PLAIN, ROUND = 12, 6  # edges; the last ones have errors that go beyond half a turn if not wrapped
NEAR = 1e-6


def edges(rng, count=PLAIN + ROUND):
    """Edges between poses all over the plane, each off by something; the last turns cross π.

    Parameters
    ----------
    rng : numpy.random.Generator
    count : int

    Returns
    -------
    dict of x_i, x_j, z : (count, 3) [m, m, rad]
    """
    x_i = np.column_stack([rng.uniform(-4, 4, (count, 2)), rng.uniform(-3, 3, count)])
    z = np.column_stack([_sized(rng, 0.5, 2, (count, 2)), _sized(rng, 0.3, 1.2, count)])
    e = np.column_stack([_sized(rng, 0.2, 0.9, (count, 2)), _sized(rng, 0.1, 0.5, count)])
    # that the sum of all turns crosses π: on the way, and by how much, is random
    x_i[:, 2] = np.where(
        np.arange(count) < count - ROUND,
        wrap(-(z[:, 2] + e[:, 2]) + rng.uniform(-1.2, 1.2, count)),
        wrap(np.sign(z[:, 2] + e[:, 2]) * (np.pi - np.abs(z[:, 2] + e[:, 2]) / 2)),
    )
    return {"x_i": x_i, "x_j": compose(compose(x_i, z), e), "z": z}


def _sized(rng, low, high, size):
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


# ---- laws -----------------------------------------------------------------------------------


def _leads(inputs, outputs):
    """Whether x_i ⊕ z ⊕ e is x_j, the heading up to whole turns."""
    there = compose(compose(inputs["x_i"], inputs["z"]), outputs["result"])
    return np.abs(between(inputs["x_j"], there)).max(axis=1) < NEAR


def _wrapped(inputs, outputs):
    return np.abs(outputs["result"][:, 2]) <= np.pi + 1e-9


# ---- mistakes -------------------------------------------------------------------------------


def _raw(inputs):
    return inputs["x_j"][:, 2] - inputs["x_i"][:, 2] - inputs["z"][:, 2]


def _turned(angle, xy):
    """Ways turned by angles."""
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack([c * xy[:, 0] - s * xy[:, 1], s * xy[:, 0] + c * xy[:, 1]])


def _moved(i):
    return (i["x_j"] - i["x_i"])[:, :2]


def _seen(i):
    return between(i["x_i"], i["x_j"])[:, :2]


def _world(i):
    return _moved(i) - i["z"][:, :2]


def _not_into_z(i):
    return _seen(i) - i["z"][:, :2]


def _turned_forth(i):
    return _turned(-i["z"][:, 2], _turned(i["x_i"][:, 2], _moved(i)) - i["z"][:, :2])


def _z_turned_forth(i):
    return _turned(i["z"][:, 2], _seen(i) - i["z"][:, :2])


def _z_only_turned(i):
    return _turned(-i["z"][:, 2], _seen(i)) - i["z"][:, :2]


_in_way = partial(mistake, part=np.s_[:2])

MISTAKES = (
    _in_way(
        "backwards",
        "This is the error seen from the other end: z as seen from where j really is. The error "
        "is pose j as seen from where z puts it.",
        lambda i: between(between(i["x_i"], i["x_j"]), i["z"])[:, :2],
    ),
    _in_way(
        "i-j-swapped",
        "The two poses have changed places: z is pose j as seen from pose i.",
        lambda i: between(i["z"], between(i["x_j"], i["x_i"]))[:, :2],
    ),
    _in_way(
        "z-inverted",
        "z is laid on top instead of taken off: it has to be undone, z⁻¹ ⊕ …",
        lambda i: compose(i["z"], between(i["x_i"], i["x_j"]))[:, :2],
    ),
    _in_way(
        "sign",
        "Every number has the wrong sign: measured minus believed for believed minus measured.",
        lambda i: -between(i["z"], between(i["x_i"], i["x_j"]))[:, :2],
    ),
    _in_way(
        "world-frame",
        "The way between the poses is in the world's frame, z in that of pose i. Turn the way back "
        "by pose i's heading before you take z off.",
        _world,
    ),
    _in_way(
        "not-into-z",
        "The difference is right, but it is written in pose i's frame. z⁻¹ ⊕ … also turns: by "
        "−θ_z, into the frame of where z leads to.",
        _not_into_z,
    ),
    _in_way(
        "turned-forth",
        "A rotation goes the wrong way. To see something *from* a pose, turn it back: by Rᵀ, which "
        "is R of the negative angle.",
        _turned_forth,
        _z_turned_forth,
    ),
    _in_way(
        "z-after-turn",
        "z's shift was taken off after the turn by θ_z: z⁻¹ first takes the shift off, then turns.",
        _z_only_turned,
    ),
    mistake(
        "not-wrapped",
        "The turn is not wrapped: θ_j − θ_i − θ_z may be 350° where it means −10°, and the graph "
        "would be bent by it. There is wrap.",
        _raw,
        part=np.s_[2],
    ),
)
ERROR = Task(
    id="15-error",
    title="The error of an edge",
    drive=DRIVES["15-error"],
    inputs=edges,
    shapes={"result": (3,)},
    laws=(
        Law("leads", 2, "from pose i, z and then e lead to pose j", _leads),
        Law("wrapped", 1, "the turn of e lies between −π and π", _wrapped),
    ),
    diagnoses=MISTAKES,
)
