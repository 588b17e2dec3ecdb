"""Task 15-step: one Gauss–Newton step over a graph, with pose 0 fixed."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import ROUNDING, equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Task
from course.exercises.ex15_pose_graph_slam.calls import CALLS
from course.exercises.ex15_pose_graph_slam.step.graphs import (
    PROBES,
    best,
    each,
    graphs,
    split,
    whitened,
)
from slamlab.geometry import wrap

SHARE = 0.1  # of the best step: a smaller step counts as no step


def _wanted(inputs):
    poses = inputs["poses"] + each(best, inputs)
    poses[..., 2] = wrap(poses[..., 2])
    return {"result": poses}


def _with_edges(inputs):
    return _wanted({"poses": inputs["poses"], **split(inputs["edges"])})


def _normal_equations(inputs):
    pairs = [whitened(*row) for row in zip(*inputs.values(), strict=True)]
    return {
        "H without pose 0": np.array([J[:, 3:].T @ J[:, 3:] for J, _ in pairs]),
        "−b without pose 0": np.array([-J[:, 3:].T @ r for J, r in pairs]),
    }


_ANCHORED = equals(
    "anchored",
    1,
    "pose 0 is unchanged, and the other poses move",
    _wanted,
    parts={"result": np.s_[0]},
    angles={"result": 2},
    asks="Which rows and columns of H belong to pose 0, and what is δ without them?",
    step="Print the rank of H for a graph of two poses and one edge: it is 3, not 6. Three entries "
    "of δ are therefore free, and fixing pose 0 determines them.",
)
_LEAST = equals(
    "least",
    4,
    "the step minimises the sum of eᵀΛe, with e linearised at the poses and pose 0 fixed",
    _wanted,
    angles={"result": 2},
    asks="Consider a graph of two poses and one edge. What is pose 1 after the step, for any Λ?",
    step=_normal_equations,
    after=("anchored",),
)
_WRAPPED = equals(
    "wrapped",
    1,
    "every heading lies between −π and π, even if δ moves it beyond π",
    _wanted,
    asks="A heading of 3.1 rad grows by 0.2 rad. What is the new heading between −π and π?",
    step="Print the headings before and after you add δ. Which of them leave the interval from −π "
    "to π?",
    alone=False,
)


def _moved(inputs, outputs):
    step = outputs["result"] - inputs["poses"]
    step[..., 2] = wrap(step[..., 2])
    return step


def _anchored(inputs, outputs):
    longest, wanted = (
        np.abs(s).max(axis=(1, 2)) for s in (_moved(inputs, outputs), each(best, inputs))
    )
    return _ANCHORED.holds(inputs, outputs) & (longest >= SHARE * wanted - ROUNDING)


def _wrapped(inputs, outputs):
    # a wrong step that takes headings elsewhere breaks another law
    return (np.abs(outputs["result"][..., 2]) <= np.pi + ROUNDING).all(axis=1)


def _parts(inputs, outputs):
    # headings that differ by a whole turn count as different
    poses = outputs["result"]
    return {"pose 0": poses[:, 0], "places": poses[:, 1:, :2], "headings": poses[:, 1:, 2]}


STEP = Task(
    id="15-step",
    title="One Gauss–Newton step",
    call=CALLS["15-step"],
    inputs=graphs,
    shapes=lambda inputs: {"result": inputs["poses"].shape[1:]},
    laws=(
        replace(_ANCHORED, holds=_anchored),
        _LEAST,
        replace(_WRAPPED, holds=_wrapped),
    ),
    needs=("15-jacobians",),
    begins=(
        "Take a graph of two poses and one edge. Which shape has its J, and which of its columns "
        "are not zero?",
        "Which sums do all edges contribute to? Which of their blocks does one edge change?",
        "Pose 0 is known. Which equations and which unknowns remain?",
    ),
    probes=PROBES,
    parts=_parts,
    references=(Reference("step", "poses edges", _with_edges),),
)
