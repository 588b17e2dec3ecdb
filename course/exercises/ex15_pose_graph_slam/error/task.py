"""Task 15-error: the residual of an edge."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import ROUNDING, equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Task
from course.exercises.ex15_pose_graph_slam.calls import CALLS
from course.exercises.ex15_pose_graph_slam.edges import PROBES, edges
from slamlab.geometry import between
from slamlab.posegraph.edge_error import error


def _wanted(inputs):
    return {"result": error(**inputs)}


def _seen(inputs):
    seen = between(inputs["x_i"], inputs["x_j"])
    return {"pose j in the frame of pose i": seen, "z": inputs["z"]}


_LEADS = equals(
    "leads",
    2,
    "the first two components of e are the position of pose j in the frame of x_i ⊕ z",
    _wanted,
    parts={"result": np.s_[:2]},
    asks="What is the predicted position of pose j from pose i and z, and what is its predicted "
    "heading?",
    step=_seen,
)
_TURN = equals(
    "wrapped",
    1,
    "the angle of e is θ_j − θ_i − θ_z, wrapped between −π and π",
    _wanted,
    parts={"result": np.s_[2]},
    angles={"result": 2},
    asks="Suppose that θ_i is 170°, θ_j is −170°, and θ_z is 10°. What is the angle of e?",
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
    title="The residual of an edge",
    call=CALLS["15-error"],
    inputs=edges,
    shapes={"result": (3,)},
    laws=(_LEADS, replace(_TURN, holds=_within)),
    probes=PROBES,
    parts=_parts,
    begins=(
        "z is pose j in the frame of pose i. Where is pose j predicted in the world frame?",
        "How do you express p_j − p_i in the frame of pose i? Which rotation does this need?",
        "In which frame is e, so which second rotation does it need?",
    ),
    references=(Reference("error", "x_i x_j z", _wanted),),
)
