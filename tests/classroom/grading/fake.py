"""A small exercise for tests: double a number, rotate a vector, double a sum."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.exercise import Exercise
from classroom.exercises.references import Reference
from classroom.exercises.task import Task
from tests.classroom.grading.fake_function_calls import CALLS


def _numbers(rng):
    # a column, of which each call gets the number: twice a column would be an argument scaled
    return {"a": rng.uniform(1, 2, (20, 1))}


def _vectors(rng):
    return {"v": rng.uniform(1, 2, (20, 2)), "angle": rng.uniform(0.3, 1.2, 20)}


def _turned_by(sign, inputs, result):
    v, angle = inputs["v"], sign * inputs["angle"]
    c, s = np.cos(angle), np.sin(angle)
    right = np.stack([c * v[:, 0] - s * v[:, 1], s * v[:, 0] + c * v[:, 1]], axis=1)
    return np.isclose(result, right).all(axis=1)


EXERCISE = Exercise(
    id="99",
    notebook="99_fake",
    title="A fake",
    tasks=(
        Task(
            id="99-double",
            title="Double a number",
            call=CALLS["99-double"],
            inputs=_numbers,
            shapes={"result": ()},
            laws=(
                Law("sign", 1, "keeps the sign", lambda i, o: o["result"] > 0),
                Law(
                    "twice",
                    2,
                    "is twice as large",
                    lambda i, o: np.isclose(o["result"], 2 * i["a"][:, 0]),
                ),
            ),
            diagnoses=(
                Diagnosis(
                    "square",
                    "you squared: <b>2a</b> is not a²",
                    lambda i, o: np.allclose(o["result"], i["a"][:, 0] ** 2),
                ),
            ),
            references=(Reference("double", "a", lambda i: {"result": 2 * i["a"]}),),
        ),
        Task(
            id="99-turn",
            title="Turn a vector",
            call=CALLS["99-turn"],
            inputs=_vectors,
            shapes={"result": (2,)},
            laws=(Law("turned", 2, "turns left", lambda i, o: _turned_by(1, i, o["result"])),),
            diagnoses=(
                Diagnosis(
                    "right",
                    "you turned right: check the sign of the sine",
                    lambda i, o: _turned_by(-1, i, o["result"]).all(),
                ),
            ),
        ),
        Task(
            id="99-total",
            title="Double a sum",
            call=CALLS["99-total"],
            inputs=lambda rng: {"a": rng.uniform(1, 2, (20, 5))},
            shapes={"sums": (20,)},
            laws=(
                Law(
                    "sum",
                    1.5,
                    "doubles the sum",
                    lambda i, o: np.isclose(o["sums"], 2 * i["a"].sum(axis=1)),
                ),
            ),
            needs=("99-double",),
        ),
    ),
    calls="tests.classroom.grading.fake_function_calls",
    allows=("slamlab.models.noise",),
    answers=("slamlab.geometry",),
)

SOLUTION = """
import numpy as np

def double(a):
    return 2 * a

def turn(v, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * v[0] - s * v[1], s * v[0] + c * v[1]])

def total(a):
    return double(a.sum())
"""
