"""A failing case with rounded inputs is still a valid input of its task."""

import numpy as np
import pytest

from classroom.exercises import catalogue, failing_cases
from classroom.exercises.function_calls import StudentError
from classroom.exercises.task import OPEN_SEED
from course.task_programs import namespace, programs

ALL = [one for id in catalogue.EXERCISES for one in programs(id)]
ROUNDED = {one.task.id: one for one in ALL if one.task.may_round}
PROMISING = [id for id, one in ROUNDED.items() if callable(one.task.may_round)]
ROWS, TIMES = 4, 2  # of each set, and how often each is rounded


def rounded(task, row, rng):
    """A row with its arrays rounded one after the other, each as far as chance will have it."""
    for name in rng.permutation(list(row)):
        candidates = [row, *failing_cases.rounder(task, row, name)]
        row = candidates[rng.integers(len(candidates))]
    return row


@pytest.mark.parametrize("id", PROMISING)
def test_all_random_inputs_are_valid(id):
    task = ROUNDED[id].task
    for seed in (OPEN_SEED, b"promise 1", b"promise 2"):
        for name, inputs in task.draw_inputs(seed).items():
            assert task.are_inputs(inputs), (seed, name)


@pytest.mark.slow
@pytest.mark.parametrize("id", ROUNDED)
def test_right_answers_obey_the_laws_under_all_rounding(id):
    one, task, rng = ROUNDED[id], ROUNDED[id].task, np.random.default_rng(15)
    ways = {name: namespace(one.exercise.id, source) for name, source in one.ways.items()}
    sets = task.draw_inputs(OPEN_SEED)
    answers = one.outputs(one.ways["solution"], sets)
    for name, inputs in sets.items():
        of, outputs = (
            failing_cases._rows(inputs),
            failing_cases.checked_outputs(task, inputs, answers[name]),
        )
        laws = [law for law in task.laws if task.judges(law, name)]
        laws = [law for law in laws if task.broken(law, inputs, outputs).size == len(of) > 1]
        for k in np.repeat(rng.permutation(len(of))[:ROWS], TIMES):
            row = rounded(task, of[k], rng)
            for way, names in ways.items():
                try:
                    with np.errstate(all="ignore"):
                        found = failing_cases.checked_outputs(task, row, task.call(names, row))
                except StudentError as error:
                    found = error
                if getattr(found, "kind", None) == "not attempted":  # a single answer that is one
                    continue
                assert not isinstance(found, StudentError), (way, name, row, found)
                failed = [law.name for law in laws if task.broken(law, row, found).any()]
                assert failed == [], (way, name, row)
