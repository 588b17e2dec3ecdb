"""Task 15-step: one step of Gauss and Newton over a graph, its first pose held."""

from dataclasses import replace

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import ROUNDING, equals
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex15.graphs import PROBES, best, each, graphs
from slamlab.geometry import wrap

SHARE = 0.1  # of the best step: who moves no pose by as much has held them all


def _wanted(inputs):
    poses = inputs["poses"] + each(best, inputs)
    poses[..., 2] = wrap(poses[..., 2])
    return {"result": poses}


def _best_step(inputs):
    return {"δ": each(best, inputs)}


_ANCHORED = equals(
    "anchored",
    1,
    "pose 0 stays where it is, and the others move",
    _wanted,
    parts={"result": np.s_[0]},
    angles={"result": 2},
    asks="Which rows and columns of H belong to pose 0, and what becomes of δ without them?",
)
_LEAST = equals(
    "least",
    4,
    "no other step lowers the sum of eᵀΛe more, e taken as straight near the poses, pose 0 held",
    _wanted,
    angles={"result": 2},
    asks="Take a graph of two poses and one edge: to where must pose 1 go, whatever Λ is?",
    step=_best_step,
    after=("anchored",),
)
_WRAPPED = equals(
    "wrapped",
    1,
    "every heading lies between −π and π, also one that steps over π",
    _wanted,
    asks="A heading of 3.1 is turned by 0.2 more: what is it then?",
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
    """Headings lie within ±π; that a wrong step takes them elsewhere breaks another law."""
    return (np.abs(outputs["result"][..., 2]) <= np.pi + ROUNDING).all(axis=1)


def _parts(inputs, outputs):
    """Pose 0, the others' places and their headings, of which a turn more or less is told apart."""
    poses = outputs["result"]
    return {"pose 0": poses[:, 0], "places": poses[:, 1:, :2], "headings": poses[:, 1:, 2]}


STEP = Task(
    id="15-step",
    title="One step of Gauss and Newton",
    drive=DRIVES["15-step"],
    inputs=graphs,
    shapes=lambda inputs: {"result": inputs["poses"].shape[1:]},
    laws=(
        replace(_ANCHORED, holds=_anchored),
        _LEAST,
        replace(_WRAPPED, holds=_wrapped),
    ),
    needs=("15-error", "15-jacobians"),
    probes=PROBES,
    parts=_parts,
)
