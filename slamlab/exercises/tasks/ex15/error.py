"""Task 15-error: how far a pose is from where an edge says it is."""

from dataclasses import replace

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import ROUNDING, equals
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex15.edges import PROBES, edges
from slamlab.geometry import between
from slamlab.posegraph.edge_error import error


def _wanted(inputs):
    return {"result": error(**inputs)}


def _seen(inputs):
    seen = between(inputs["x_i"], inputs["x_j"])
    return {"pose j as seen from pose i": seen, "z": inputs["z"]}


_LEADS = equals(
    "leads",
    2,
    "from pose i, z and then e lead to the place of pose j",
    _wanted,
    parts={"result": np.s_[:2]},
    asks="Where does the edge put pose j, and which way would a robot look that stands there?",
    step=_seen,
)
_TURN = equals(
    "wrapped",
    1,
    "the turn of e is θ_j − θ_i less that of z, between −π and π",
    _wanted,
    parts={"result": np.s_[2]},
    angles={"result": 2},
    asks="Pose i looks to 170°, pose j to −170°, and z says 10°: by how much are they off?",
    step=_seen,
)


def _within(inputs, outputs):
    # both −π and π are half a turn; rounding may carry a heading just beyond
    return _TURN.holds(inputs, outputs) & (np.abs(outputs["result"][:, 2]) <= np.pi + ROUNDING)


def _parts(inputs, outputs):
    e = outputs["result"]
    half = np.abs(np.abs(e[:, 2]) - np.pi) < ROUNDING
    return {"place": e[:, :2], "turn": np.where(half, np.pi, e[:, 2])}


ERROR = Task(
    id="15-error",
    title="The error of an edge",
    drive=DRIVES["15-error"],
    inputs=edges,
    shapes={"result": (3,)},
    laws=(_LEADS, replace(_TURN, holds=_within)),
    probes=PROBES,
    parts=_parts,
)
