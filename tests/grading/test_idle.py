"""An answer that is always the same earns nothing, whatever law it happens to obey."""

import numpy as np
import pytest

from slamlab.exercises import catalogue
from slamlab.exercises.drives.input_sets import MAIN
from slamlab.exercises.outputs import shapes_of

TASKS = [task for id in catalogue.EXERCISES for task in catalogue.exercise(id).tasks]


def filled(task, inputs, value):
    """Outputs of the shapes that a task asks for, all of one value."""
    count = min(len(array) for array in inputs.values())
    shapes = {
        name: ((count,) if name == "result" else ()) + tuple(n or 4 for n in shape)
        for name, shape in shapes_of(task, inputs).items()
    }
    return {name: np.full(shape, float(value)) for name, shape in shapes.items()}


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)
@pytest.mark.parametrize("value", [0, 1, -1, 1e6])
def test_one_number_for_all_earns_nothing(task, value):
    sets = task.draw(b"a seed")
    verdict = task.judge(sets, {MAIN: filled(task, sets[MAIN], value)})
    assert verdict.points == 0
    assert verdict.diagnosis or verdict.problem
