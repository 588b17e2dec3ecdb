"""Of an answer whose mistake has no name it is said where and how it is wrong, if that is plain."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.exercises.clues import clue
from slamlab.exercises.drives.input_sets import run_sets
from slamlab.exercises.law import equals
from slamlab.exercises.run_task import run_and_tell
from slamlab.exercises.task import OPEN_SEED, Probe
from tests.grading import fake


def _vectors(rng, n=20):
    return {"v": rng.uniform(-2, 2, (n, 2)), "angle": rng.uniform(-1.2, 1.2, n)}


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


def told(function, seed=OPEN_SEED):
    sets = TURN.draw(seed)
    found = clue(TURN, sets, run_sets(TURN.drive, {"turn": function}, sets))
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
def test_what_is_plain_is_told(name, function, seed):
    assert told(function, seed)[0] == name


@given(st.binary(max_size=8), st.floats(-1, 1))
def test_a_right_answer_and_one_of_which_nothing_is_plain_get_no_clue(seed, turns):
    assert told(right, seed) is None
    assert told(lambda v, a: right(v, a) + 1e-12 * turns, seed) is None
    assert told(lambda v, a: right(v, a) ** 2 + v[0], seed) is None


def test_a_clue_says_which_probe_alone_is_wrong_and_how():
    def negative(v, angle):
        return right(v, angle) * (1 if angle else -1)

    for function, said in ((fails, ""), (negative, "negative of the right")):
        name, hint = told(function)
        assert (name, "only with no angle." in hint) == ("only there", True)
        assert said in hint and "large" not in hint
    assert (
        "no angle and 1 other kind" in told(lambda v, a: right(v, a) + (a in (0, 1)) * v[0] ** 2)[1]
    )


def test_where_all_is_wrong_that_one_output_is_near_is_not_told():
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
    sets = task.draw(OPEN_SEED)
    close, square = (lambda a: a * (1 + 0.001 * np.sin(a))), (lambda a: a**2 + 1)
    assert clue(task, sets, answers({"x": close, "y": close})).name == "near"
    assert clue(task, sets, answers({"x": close, "y": square})) is None
    said = clue(task, sets, answers({"x": close, "y": np.negative}))
    assert said.hint.startswith("Every number of y that is wrong is exactly the negative")


@pytest.mark.parametrize(
    "off, name, says",
    [
        (lambda k, a: 0 * k, None, None),
        (lambda k, a: np.where(k > 3, a, 0), "later", "at entry 4 or later"),
        (lambda k, a: 256 * (k % 3), "multiple", "a multiple of 256"),
        (lambda k, a: (k + 1) % 3, None, None),
    ],
)
def test_of_a_row_it_is_told_where_it_begins_to_be_wrong(off, name, says):
    k, sets = np.arange(6), LONG.draw(OPEN_SEED)

    def row(v, angle):
        return k * angle**2 + off(k, angle)

    found = clue(LONG, sets, run_sets(LONG.drive, {"turn": row}, sets))
    assert (found and found.name) == name
    assert name is None or says in found.hint


def test_check_tells_a_clue_where_no_mistake_is_recognised():
    verdict = run_and_tell(TURN, {"turn": lambda v, angle: -right(v, angle)})
    assert verdict.diagnosis == "negative" and verdict.case
    assert run_and_tell(TURN, {"turn": right}).hint is None


@pytest.mark.parametrize("told", [[99.0], [np.nan, -1], [np.inf], ["v"], [[0.0, 1e300]]])
def test_a_worker_that_tells_nonsense_of_arguments_stops_no_judge(told):
    sets = LONG.draw(OPEN_SEED)
    answers = run_sets(LONG.drive, {"turn": lambda v, angle: np.arange(6) * angle**2}, sets)
    verdict = LONG.judge(sets, {"": answers[""] | {"arguments changed": np.array(told)}})
    assert [law.name for law in verdict.laws if law.failed] == ["unchanged"]


def test_of_what_is_empty_nothing_is_said_but_where_it_is():
    def no_rows(rng):
        return {"v": np.empty((0, 2)), "angle": np.empty(0)}

    all_of = dataclasses.replace(LAW, holds=lambda i, o: len(i["v"]) > 0 and LAW.holds(i, o).all())
    task = dataclasses.replace(TURN, laws=(all_of,), probes=(Probe("no vectors", no_rows),))
    sets = task.draw(OPEN_SEED)
    answers = {name: {"result": _turned(of)["result"]} for name, of in sets.items()}
    assert clue(task, sets, answers).hint.startswith("Everything else comes out right")
    assert "no vectors" in clue(task, sets, answers).hint
