"""Task 15-jacobians: how an edge's error changes with its two poses."""

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex15.edges import PROBES, edges
from slamlab.posegraph.edge_jacobians import J_i, J_j

DIFFERENCES = 1e-4
"""Share of a matrix's largest entry: one-sided differences of 1e-5 m pass, no wrong form does."""


def _wanted(inputs):
    return {"A": J_i(**inputs), "B": J_j(**inputs)}


def _sides(inputs):
    angle = inputs["x_i"][:, 2] + inputs["z"][:, 2]
    return {"heading of the frame of e": angle, "way": (inputs["x_j"] - inputs["x_i"])[:, :2]}


def _parts(inputs, outputs):
    """The blocks of A and B that are derived one by one."""
    A, B = outputs["A"], outputs["B"]
    return {
        "A's place": A[:, :, :2],
        "A's heading": A[:, :2, 2],
        "A's turn": A[:, 2, 2],
        "B": B,
    }


JACOBIANS = Task(
    id="15-jacobians",
    title="How the error feels its poses",
    drive=DRIVES["15-jacobians"],
    inputs=edges,
    shapes={"A": (None, 3, 3), "B": (None, 3, 3)},
    laws=(
        equals(
            "A",
            3,
            "A holds the differences of e when x_i is moved a little",
            _wanted,
            parts={"A": np.s_[:]},
            tolerance=DIFFERENCES,
            asks="Only the turn of pose i is new. Which part of e holds θ_i, and with what slope?",
            step=_sides,
        ),
        equals(
            "B",
            2,
            "B holds the differences of e when x_j is moved a little",
            _wanted,
            parts={"B": np.s_[:]},
            tolerance=DIFFERENCES,
            asks="Pose j goes 1 cm to the east. Where to is that, as seen from where z leads to?",
            step=_sides,
        ),
    ),
    probes=PROBES,
    parts=_parts,
)
