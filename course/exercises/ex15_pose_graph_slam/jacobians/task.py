"""Task 15-jacobians: the Jacobians of an edge's residual with respect to its two poses."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex15_pose_graph_slam.calls import CALLS
from course.exercises.ex15_pose_graph_slam.edges import PROBES, edges
from course.exercises.surveyed import EXACT, NAME, differences, rounded, surveyed
from slamlab.posegraph.edge_jacobians import J_i, J_j


def _wanted(inputs):
    return {"A": J_i(**inputs), "B": J_j(**inputs)}


def _far(rng):
    return surveyed(edges(rng, 6, 0), "x_i", "x_j")


def _sides(inputs):
    angle = inputs["x_i"][:, 2] + inputs["z"][:, 2]
    return {"θ_i + θ_z": angle, "p_j − p_i": (inputs["x_j"] - inputs["x_i"])[:, :2]}


def _derived(name, points, says, asks):
    parts = {name: np.s_[:]}
    law = equals(name, points, says, _wanted, parts=parts, tolerance=EXACT, asks=asks, step=_sides)
    return rounded(law, _wanted)


def _parts(inputs, outputs):
    A, B = outputs["A"], outputs["B"]
    return {
        "A's place": A[:, :, :2],
        "A's heading": A[:, :2, 2],
        "A's turn": A[:, 2, 2],
        "B": B,
    }


JACOBIANS = Task(
    id="15-jacobians",
    title="The Jacobians of an edge",
    call=CALLS["15-jacobians"],
    inputs=edges,
    shapes={"A": (None, 3, 3), "B": (None, 3, 3)},
    laws=(
        _derived(
            "A",
            3,
            "A is ∂e/∂x_i",
            asks="Which terms of e contain θ_i, and what are their derivatives?",
        ),
        _derived(
            "B",
            2,
            "B is ∂e/∂x_j",
            asks="Suppose that pose j moves 1 cm to the east. Which motion is this in the frame "
            "of x_i ⊕ z?",
        ),
    ),
    probes=(*PROBES, Probe(NAME, _far)),
    diagnoses=(differences(_wanted), differences(_wanted, MAIN)),
    parts=_parts,
    begins=(
        "Write the three components of e with x, y and θ of both poses.",
        "Which of them contain x_j? Differentiate them with respect to x, y and θ of pose j.",
        "What is the derivative of Rot(θ_i)ᵀ with respect to θ_i, and by which vector is it "
        "multiplied?",
    ),
    references=(Reference("jacobians", "x_i x_j z", _wanted, "A B"),),
)
