"""Task 15-step: one step of Gauss and Newton over a graph, its first pose held."""

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex15_graphs import POSES, best, each, graphs
from slamlab.exercises.tasks.ex15_step_mistakes import MISTAKES, moved, same


def _anchored(inputs, outputs):
    return np.abs(moved(inputs, outputs)[:, 0]).max(axis=1) < 1e-6


def _least(inputs, outputs):
    return same(moved(inputs, outputs), each(best, inputs))


def _wrapped(inputs, outputs):
    return np.abs(outputs["result"][..., 2]).max(axis=1) <= np.pi + 1e-9


STEP = Task(
    id="15-step",
    title="One step of Gauss and Newton",
    drive=DRIVES["15-step"],
    inputs=graphs,
    shapes={"result": (POSES, 3)},
    laws=(
        Law("anchored", 1, "pose 0 stays where it is", _anchored),
        Law(
            "least",
            4,
            "no other step lowers the sum of eᵀΛe more, e taken as straight near the poses",
            _least,
        ),
        Law("wrapped", 1, "every heading lies between −π and π", _wrapped),
    ),
    diagnoses=MISTAKES,
    needs=("15-error", "15-jacobians"),
)
