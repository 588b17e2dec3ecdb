"""An unrecognised mistake gets a description of its error pattern, if there is one."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from classroom.exercises.correctness_laws import equals
from classroom.exercises.function_calls.run_and_pack import call_on_sets
from classroom.exercises.run_task import run_and_explain
from classroom.exercises.task import OPEN_SEED, Probe
from classroom.exercises.unrecognised_mistakes import describe_error_pattern
from classroom.exercises.verdict_text import name_probes
from tests.classroom.grading import fake


def _vectors(rng, n=20):
    # both signs every time: of a side with hardly a row nothing is plain
    angle = rng.uniform(0, 1.2, n) * np.resize([1, -1], n)
    return {"v": rng.uniform(-2, 2, (n, 2)), "angle": angle}


def _turned(inputs):
    c, s = np.cos(inputs["angle"]), np.sin(inputs["angle"])
    x, y = inputs["v"].T
    return {"result": np.stack([c * x - s * y, s * x + c * y, x * y], axis=1)}


LAW = equals("turned", 2, "turns left, and gives the product", _turned)
TURN = dataclasses.replace(
    fake.EXERCISE.task("99-turn"),
    inputs=_vectors,
    shapes={"result": (3,)},
    laws=(LAW,),
    diagnoses=(),
    probes=(
        Probe("no angle", lambda rng: _vectors(rng, 4) | {"angle": np.zeros(4)}),
        Probe("large vectors", lambda rng: {"v": rng.uniform(50, 99, (4, 2)), "angle": np.ones(4)}),
    ),
)


LONG = dataclasses.replace(
    TURN,
    shapes={"result": (6,)},
    laws=(equals("row", 2, "", lambda i: {"result": np.arange(6) * i["angle"][:, None] ** 2}),),
    probes=(),
)


def right(v, angle):
    one = _turned({"v": v[None], "angle": np.array([angle])})
    return one["result"][0]


def report(function, seed=OPEN_SEED, task=TURN):
    sets = task.draw_inputs(seed)
    found = describe_error_pattern(task, sets, call_on_sets(task.call, {"turn": function}, sets))
    return found and (found.name, found.hint)


def fails(v, angle):
    return right(v, angle) if angle else 1 / 0


@pytest.mark.parametrize(
    "name, function",
    [
        ("negative", lambda v, a: -right(v, a)),
        ("negative", lambda v, a: np.array([-1, 1, 1]) * right(v, a)),
        ("turned", lambda v, a: np.add(right(v, a), [0, 2 * np.pi, 0])),
        ("half-turned", lambda v, a: np.add(right(v, a), [0, np.pi, 0])),
        ("zero", lambda v, a: right(v, a) * [1, 1, 0]),
        ("scaled", lambda v, a: right(v, a) * [1, 180 / np.pi, 1]),
        ("shifted", lambda v, a: np.add(right(v, a), [0.5, 0, 0])),
        ("reordered", lambda v, a: right(v, a)[[1, 0, 2]]),
        ("near", lambda v, a: right(v, a) * [1 + 0.004 * np.sin(v[0]), 1, 1]),
        ("one side", lambda v, a: right(v, a) * (1 if a >= 0 else v[0])),
        ("only there", fails),
        ("only there", lambda v, a: right(v, a) if a else v[0] * right(v, a)),
    ],
)
@given(seed=st.binary(max_size=8))
def test_an_obvious_problem_is_reported(name, function, seed):
    assert report(function, seed)[0] == name


@given(st.binary(max_size=8), st.floats(-1, 1))
def test_right_answers_and_answers_without_a_pattern_get_no_error_pattern(seed, turns):
    assert report(right, seed) is None
    assert report(lambda v, a: right(v, a) + 1e-12 * turns, seed) is None
    assert report(lambda v, a: right(v, a) ** 2 + v[0], seed) is None


@pytest.mark.parametrize("rows, name", [(8, None), (9, "one side")])
def test_the_sign_of_an_entry_is_named_only_if_the_rows_suffice_for_the_entries(rows, name):
    task = dataclasses.replace(TURN, inputs=lambda rng: _vectors(rng, rows), probes=())
    found = report(lambda v, a: right(v, a) * (1 if a >= 0 else v[0]), task=task)
    assert (found and found[0]) == name


def test_an_error_pattern_states_which_probe_alone_is_wrong_and_how():
    def negative(v, angle):
        return right(v, angle) * (1 if angle else -1)

    for function, message in ((fails, ""), (negative, "negative of the right")):
        name, hint = report(function)
        assert (name, "only with no angle." in hint) == ("only there", True)
        assert message in hint and "large" not in hint
    both = report(lambda v, a: right(v, a) + (a in (0, 1)) * v[0] ** 2)[1]
    assert "only with no angle and with large vectors. What" in both


def test_up_to_three_kinds_of_input_are_named_and_more_are_counted():
    assert name_probes(["α near π"]) == "α near π"
    assert name_probes(["a", "b", "c"]) == "a, with b and with c"
    assert name_probes([*"abcd"]) == "4 kinds of special inputs, for instance with a"


def _rotations(inputs):
    c, s = np.cos(inputs["angle"]), np.sin(inputs["angle"])
    return {"result": np.stack([c, -s, s, c], axis=1).reshape(-1, 2, 2)}


def test_a_transposed_rotation_is_no_wrong_sign():
    task = dataclasses.replace(
        TURN, shapes={"result": (2, 2)}, laws=(equals("rotation", 2, "", _rotations),), probes=()
    )
    sets = task.draw_inputs(OPEN_SEED)

    def named(change):
        found = {
            name: {"result": change(_rotations(of)["result"]), "arguments changed": ()}
            for name, of in sets.items()
        }
        return describe_error_pattern(task, sets, found).name

    assert named(lambda R: R.transpose(0, 2, 1)) == "transposed"
    assert named(np.negative) == "negative"


def test_that_one_output_is_near_is_not_reported_if_all_are_wrong():
    def both(inputs):
        return {"x": _turned(inputs)["result"][:, :1], "y": _turned(inputs)["result"][:, 1:2]}

    def answers(change):
        return {
            name: {k: change[k](a) for k, a in both(of).items()} | {"arguments changed": ()}
            for name, of in sets.items()
        }

    task = dataclasses.replace(
        TURN, shapes={"x": (None, 1), "y": (None, 1)}, laws=(equals("both", 2, "x, y", both),)
    )
    sets = task.draw_inputs(OPEN_SEED)
    close, square = (lambda a: a * (1 + 0.001 * np.sin(a))), (lambda a: a**2 + 1)
    assert describe_error_pattern(task, sets, answers({"x": close, "y": close})).name == "near"
    assert describe_error_pattern(task, sets, answers({"x": close, "y": square})) is None
    message = describe_error_pattern(task, sets, answers({"x": close, "y": np.negative}))
    assert message.hint.startswith("Every wrong number in y is exactly the negative")


@pytest.mark.parametrize(
    "off, name, message",
    [
        (lambda k, a: 0 * k, None, None),
        (lambda k, a: np.where(k > 3, a, 0), "later", "at entry 4 or later"),
        (lambda k, a: 256 * (k % 3), "multiple", "a multiple of 256"),
        (lambda k, a: (k + 1) % 3, None, None),
    ],
)
def test_the_first_wrong_entry_of_a_row_is_reported(off, name, message):
    k, sets = np.arange(6), LONG.draw_inputs(OPEN_SEED)

    def row(v, angle):
        return k * angle**2 + off(k, angle)

    found = describe_error_pattern(LONG, sets, call_on_sets(LONG.call, {"turn": row}, sets))
    assert (found and found.name) == name
    assert name is None or message in found.hint


def test_check_reports_an_error_pattern_if_no_mistake_is_recognised():
    verdict = run_and_explain(TURN, {"turn": lambda v, angle: -right(v, angle)})
    assert verdict.diagnosis == "negative" and verdict.case
    assert run_and_explain(TURN, {"turn": right}).hint is None


@pytest.mark.parametrize("report", [[99.0], [np.nan, -1], [np.inf], ["v"], [[0.0, 1e300]]])
def test_a_worker_with_invalid_reports_of_arguments_does_not_stop_the_judge(report):
    sets = LONG.draw_inputs(OPEN_SEED)
    answers = call_on_sets(LONG.call, {"turn": lambda v, angle: np.arange(6) * angle**2}, sets)
    verdict = LONG.judge(sets, {"": answers[""] | {"arguments changed": np.array(report)}})
    assert [law.name for law in verdict.laws if law.failed] == ["unchanged"]


def test_for_an_empty_output_only_its_position_is_reported():
    def no_rows(rng):
        return {"v": np.empty((0, 2)), "angle": np.empty(0)}

    all_of = dataclasses.replace(LAW, holds=lambda i, o: len(i["v"]) > 0 and LAW.holds(i, o).all())
    task = dataclasses.replace(TURN, laws=(all_of,), probes=(Probe("no vectors", no_rows),))
    sets = task.draw_inputs(OPEN_SEED)
    answers = {name: {"result": _turned(of)["result"]} for name, of in sets.items()}
    hint = describe_error_pattern(task, sets, answers).hint
    assert hint.startswith("Your answers are wrong only with no vectors")
