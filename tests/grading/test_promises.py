"""A case that was rounded to be read keeps what the task's text promises."""

import numpy as np
import pytest

from course.programs import namespace, programs
from slamlab.exercises import cases, catalogue
from slamlab.exercises.drives import StudentError
from slamlab.exercises.task import OPEN_SEED

ALL = [one for id in catalogue.EXERCISES for one in programs(id)]
ROUNDED = {one.task.id: one for one in ALL if one.task.rounds}
PROMISING = [id for id, one in ROUNDED.items() if callable(one.task.rounds)]
ROWS, TIMES = 4, 2  # of each set, and how often each is rounded


def rounded(task, row, rng):
    """A row with its arrays rounded one after the other, each as far as chance will have it."""
    for name in rng.permutation(list(row)):
        rounder = [row, *cases.rounder(task, row, name)]
        row = rounder[rng.integers(len(rounder))]
    return row


@pytest.mark.parametrize("id", PROMISING)
def test_all_that_is_drawn_keeps_the_promise(id):
    task = ROUNDED[id].task
    for seed in (OPEN_SEED, b"promise 1", b"promise 2"):
        for name, inputs in task.draw(seed).items():
            assert task.are_inputs(inputs), (seed, name)


@pytest.mark.slow
@pytest.mark.parametrize("id", ROUNDED)
def test_right_ways_obey_the_laws_on_all_that_rounding_makes(id):
    one, task, rng = ROUNDED[id], ROUNDED[id].task, np.random.default_rng(15)
    ways = {name: namespace(one.exercise.id, source) for name, source in one.ways.items()}
    sets = task.draw(OPEN_SEED)
    answers = one.answers(one.ways["solution"], sets)
    for name, inputs in sets.items():
        of, outputs = cases._rows(inputs), cases.measured(task, inputs, answers[name])
        laws = [law for law in task.laws if task.judges(law, name)]
        laws = [law for law in laws if task.broken(law, inputs, outputs).size == len(of) > 1]
        for k in np.repeat(rng.permutation(len(of))[:ROWS], TIMES):
            row = rounded(task, of[k], rng)
            for way, names in ways.items():
                try:
                    with np.errstate(all="ignore"):
                        found = cases.measured(task, row, task.drive(names, row))
                except StudentError as error:
                    found = error
                if getattr(found, "kind", None) == "not attempted":  # a single answer that is one
                    continue
                assert not isinstance(found, StudentError), (way, name, row, found)
                failed = [law.name for law in laws if task.broken(law, row, found).any()]
                assert failed == [], (way, name, row)
