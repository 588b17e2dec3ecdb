"""A task that turns vectors, and what is reported of a function for it."""

import dataclasses

import numpy as np

from classroom.exercises import failing_cases
from classroom.exercises.correctness_laws import equals
from classroom.exercises.function_calls.run_and_pack import MAIN, call_on_sets
from classroom.exercises.run_task import run_and_explain
from classroom.exercises.task import OPEN_SEED, Probe
from tests.classroom.grading import fake


def want(inputs):
    (x, y), angle = inputs["v"].T, inputs["angle"]
    c, s = np.cos(angle), np.sin(angle)
    return {"result": np.stack([c * x - s * y, s * x + c * y], axis=1)}


def two_vectors(rng):
    return {"v": rng.uniform(1, 2, (2, 2)), "angle": np.zeros(2)}


TURN = dataclasses.replace(
    fake.EXERCISE.task("99-turn"),
    laws=(equals("turned", 2, "turns left", want),),
    probes=(Probe("no angle", two_vectors),),
)
SETS = TURN.draw_inputs(OPEN_SEED)


def turn(v, angle):
    return want({"v": v[None], "angle": np.array([angle])})["result"][0]


def answered(function, task=TURN):
    """What a function answers, and how it is run again."""

    def run(inputs):
        return call_on_sets(task.call, {"turn": function}, {MAIN: inputs})[MAIN]

    return call_on_sets(task.call, {"turn": function}, task.draw_inputs(OPEN_SEED)), run


def verdict_of(function, task=TURN):
    return run_and_explain(task, {"turn": function})


def report(function, task=TURN):
    return verdict_of(function, task).case


def with_laws(*laws, **more):
    return dataclasses.replace(TURN, laws=laws, **more)


def shown(function, task=TURN, again=True):
    """The smallest failing case of a function, rounded unless it is not run again."""
    answers, run = answered(function, task)
    return failing_cases.smallest_failing_case(task, SETS, answers, run if again else None)


WRONG = {
    "right": lambda v, angle: turn(v, -angle),
    "degrees": lambda v, angle: turn(v, np.degrees(angle)),
    "too long": lambda v, angle: turn(v, angle) * 1.01,
    "mirrored": lambda v, angle: turn(v, angle)[::-1],
}
