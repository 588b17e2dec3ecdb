"""Outputs are validated before they are judged by the laws of a task."""

import dataclasses
import re

import numpy as np
import pytest
from IPython.core.error import StdinNotImplementedError

from classroom.exercises.correctness_laws import Law, cache_within_judging, equals, once
from classroom.exercises.exercise import Exercise
from classroom.exercises.function_calls import FunctionCall, StudentError
from classroom.exercises.function_calls.run_and_pack import MAIN
from tests.classroom.grading import fake

TURN = fake.EXERCISE.task("99-turn")
SETS = TURN.draw_inputs(b"seed")
INPUTS = SETS[MAIN]
C, S, V = np.cos(INPUTS["angle"]), np.sin(INPUTS["angle"]), INPUTS["v"]
RIGHT = np.stack([C * V[:, 0] - S * V[:, 1], S * V[:, 0] + C * V[:, 1]], axis=1)


def test_inputs_are_determined_by_the_seed_and_the_task():
    again = TURN.draw_inputs(b"seed")[MAIN]
    assert all(np.array_equal(INPUTS[name], again[name]) for name in INPUTS)
    assert not np.array_equal(TURN.draw_inputs(b"other")[MAIN]["v"], INPUTS["v"])


def test_what_several_laws_ask_for_is_computed_once_a_judging_for_the_same_arrays():
    asked = []

    @once
    def half(inputs):
        asked.append(inputs["a"][0])
        return inputs["a"] / 2

    one, other = {"a": np.array([2.0])}, {"a": np.array([4.0])}
    with cache_within_judging():
        assert half(one) is half(one)
        assert half(other) == 2
        half({"a": np.array([2.0])})  # as large, but not the same
    assert asked == [2, 4, 2]
    half(one)
    half(one)  # in a notebook, where arrays may change between two calls
    assert asked == [2, 4, 2, 2, 2]


def test_laws_that_want_the_same_ask_for_it_once():
    asked = []

    def want(inputs):
        asked.append(id(inputs))
        return {"result": RIGHT}

    laws = tuple(equals(name, 1, name, want) for name in ("one", "two", "three"))
    task = dataclasses.replace(TURN, laws=laws)
    assert task.judge(SETS, {MAIN: {"result": RIGHT, "arguments changed": np.zeros(0)}}).full
    assert len(asked) == len(SETS)


@pytest.mark.parametrize(
    ("outputs", "message"),
    [
        ({}, "missing"),
        ({"result": RIGHT[:5]}, "answered 5 of 20 calls"),
        ({"result": np.array(1.0)}, "answered 0 of 20 calls"),
        ({"result": RIGHT[:, :1]}, r"shape \(1,\), expected \(2,\)"),
        ({"result": RIGHT[:, :, None]}, r"turn returned shape \(2, 1\), expected \(2,\)"),
        ({"result": RIGHT * np.nan}, "NaN or infinity"),
        ({"result": RIGHT * 1e18}, "limit of right answers"),
        ({"result": np.full(RIGHT.shape, -(2**63))}, "limit of right answers"),
    ],
)
def test_malformed_outputs_earn_nothing(outputs, message):
    verdict = TURN.judge(SETS, {MAIN: outputs})
    assert (verdict.points, verdict.kind) == (0, "malformed")
    assert re.search(message, verdict.problem)


def test_the_right_outputs_earn_everything_whatever_their_number_type():
    assert TURN.judge(SETS, {MAIN: {"result": RIGHT, "more": np.zeros(3)}}).full
    assert TURN.judge(SETS, {MAIN: {"result": RIGHT > 0}}).points == 0


@pytest.mark.parametrize("error", [np.linalg.LinAlgError, IndexError, MemoryError, AttributeError])
def test_a_law_that_fails_on_wild_numbers_does_not_hold(error):
    def wild(inputs, outputs):
        raise error

    task = dataclasses.replace(TURN, laws=(Law("wild", 1, "", wild), *TURN.laws))
    verdict = task.judge(SETS, {MAIN: {"result": RIGHT}})
    assert [law.failed for law in verdict.laws] == [1, 0, 0]
    assert verdict.points == 2.5


def test_a_task_may_only_need_one_that_stands_before_it():
    backwards = tuple(reversed(fake.EXERCISE.tasks))
    with pytest.raises(ValueError, match="99-total needs a task"):
        Exercise("99", "x", "x", backwards, "x")


def call_of(*names):
    """A call of each of these functions."""
    return FunctionCall(names, lambda functions, inputs: [f(1) for f in functions.values()])


def test_the_one_function_not_attempted_is_named():
    names = {"done": abs}
    exec(compile("def inner(a):\n    raise NotImplementedError", "<cell 3>", "exec"), names)
    exec(compile("def outer(a):\n    return inner(a)", "<cell 4>", "exec"), names)
    for call, message in (
        (call_of("done", "inner"), "inner is not attempted yet"),
        (call_of("outer"), "inner is not attempted yet"),
        (call_of("inner"), "not attempted yet"),
    ):
        with pytest.raises(StudentError, match=f"^{message}$"):
            call(names, {})

    def asks(a):
        raise StdinNotImplementedError("no input here")  # what input() raises where none can be

    with pytest.raises(StudentError, match="no input here") as raised:
        call_of("asks")({"asks": asks}, {})
    assert raised.value.kind == "raised"


def test_an_output_of_any_length_may_not_be_of_every_length():
    task = dataclasses.replace(TURN, shapes={"points": (None, 2)})
    verdict = task.judge(SETS, {MAIN: {"points": np.zeros((2001, 2))}})
    assert "2001 entries: no correct answer has more than 2000" in verdict.problem
