"""A degenerate answer earns nothing, whatever law it obeys by chance."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from classroom.exercises import catalogue
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.outputs import MAX_MAGNITUDE, MAX_ROWS, shapes_of
from tests.classroom.grading import fake

TASKS = [task for id in catalogue.EXERCISES for task in catalogue.exercise(id).tasks]
NUMBERS = 0.0, 1.0, -1.0, 1e6, -1e6, 1e3, 5e-324, MAX_MAGNITUDE, -MAX_MAGNITUDE
COURSE = sum(task.points for task in TASKS)
SHARE = 0.02  # of the course's points, that all degenerate answers together may earn [1]


def filled(task, inputs, values, size=4):
    """Outputs of the shapes that a task asks for; ``values`` makes an array of a shape."""
    count, shapes = min(len(array) for array in inputs.values()), {}
    for name, shape in shapes_of(task, inputs).items():
        most = size if sum(n is None for n in shape) == 1 else min(size, 30)
        shape = tuple(most if n is None else n for n in shape)
        shapes[name] = (count, *shape) if name == "result" else shape
    return {name: np.asarray(values(shape, inputs), float) for name, shape in shapes.items()}


def argument(shape, inputs):
    """An input of a shape; where there is none, the first one's numbers."""
    numbers = [array for array in inputs.values() if array.dtype.kind in "fiu" and array.size]
    alike = [array for array in numbers if array.shape == shape]
    return np.resize([*alike, *numbers, np.zeros(1)][0].astype(float), shape)


def positive_definite(shape, rng):
    if len(shape) > 1 and shape[-1] == shape[-2]:
        root = rng.standard_normal(shape)
        return root @ np.swapaxes(root, -1, -2)
    return rng.random(shape)


def degenerate_answers(rng):
    """What to fill outputs with: one number, an argument, random numbers, all with little noise."""
    tiny = lambda shape: 1e-12 * rng.standard_normal(shape)  # noqa: E731
    return {
        **{f"{c:g}": lambda s, i, c=c: np.full(s, c) for c in (0, 1, -1, 1e6, 1e-12)},
        **{f"{c:g} with noise": lambda s, i, c=c: c + tiny(s) for c in (0, 1)},
        "counted": lambda s, i: np.arange(float(np.prod(s))).reshape(s),
        "an argument": argument,
        "an argument with noise": lambda s, i: argument(s, i) + tiny(s),
        **{f"{c:g} arguments": lambda s, i, c=c: c * argument(s, i) for c in (2, -1, 1e-12)},
        "NaN made 0": lambda s, i: np.nan_to_num(np.nan * argument(s, i)),
        "normal": lambda s, i: rng.standard_normal(s),
        "uniform": lambda s, i: rng.random(s),
        "minute": lambda s, i: 1e-12 * rng.random(s),
        "whole": lambda s, i: rng.integers(0, 4, s),
        "negative": lambda s, i: -rng.integers(1, 9, s),
        "positive definite": lambda s, i: positive_definite(s, rng),
    }


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.id)
def test_one_number_for_all_earns_nothing(task):
    sets = task.draw_inputs(b"a seed")
    is_open = any(None in shape for shape in shapes_of(task, sets[MAIN]).values())
    for size, value in itertools.product((4, 0, 1, MAX_ROWS)[: 4 if is_open else 1], NUMBERS):
        numbers = filled(task, sets[MAIN], lambda s, _, value=value: np.full(s, value), size)
        verdict = task.judge(sets, {MAIN: numbers})
        assert verdict.points == 0, (size, value)
        assert verdict.diagnosis or verdict.problem or size != 4, value


@pytest.mark.slow
def test_degenerate_answers_earn_next_to_nothing_over_the_course():
    rng, earned = np.random.default_rng(11), {}
    for task in TASKS:
        sets = task.draw_inputs(b"a seed")
        for name, values in degenerate_answers(rng).items():
            for size in (0, 4):
                answers = {which: filled(task, i, values, size) for which, i in sets.items()}
                points = task.judge(sets, answers).points
                if points > earned.get(task.id, (0, ""))[0]:
                    earned[task.id] = points, name
    assert sum(points for points, _ in earned.values()) <= SHARE * COURSE, earned


def test_a_law_that_earns_nothing_alone_earns_beside_another():
    sign, twice = fake.EXERCISE.task("99-double").laws
    weak = replace(sign, alone=False)
    task = replace(fake.EXERCISE.task("99-double"), laws=(weak, twice), diagnoses=())
    sets = task.draw_inputs(b"a seed")
    a = sets[MAIN]["a"][:, 0]
    points = [task.judge(sets, {MAIN: {"result": r}}).points for r in (2 * a, a**2, -a)]
    assert points == [3.5, 0, 0]


def test_no_task_accepts_counts_that_a_worker_forged():
    task = catalogue.task("09-clean-map")
    sets = task.draw_inputs(b"a seed")
    count = len(sets[MAIN]["x"])
    for counts in (-np.arange(1.0, count + 1), np.arange(count) - 0.5, np.arange(float(count))):
        outputs = {"walls": np.random.default_rng(1).random((5, 2)), "counts": counts}
        assert task.judge(sets, dict.fromkeys(sets, outputs)).points == 0
