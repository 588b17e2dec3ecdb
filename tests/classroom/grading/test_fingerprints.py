"""A fingerprint depends on numbers, not on rounding; one mistake must explain the whole answer."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from classroom.exercises import fingerprints
from classroom.exercises.correctness_laws import Diagnosis
from classroom.exercises.fingerprints import CLOSE, RIGHT, Table, fingerprint, of_answers
from classroom.exercises.function_calls.run_and_pack import call_on_sets
from classroom.exercises.mistake_families import FAMILY_HINT
from classroom.exercises.run_task import run_and_explain
from classroom.exercises.task import OPEN_SEED, Probe
from tests.classroom.grading import fake

SEEDS = st.integers(0, 2**32 - 1)


def numbers(seed, shape):
    rng = np.random.default_rng(seed)
    return rng.normal(size=shape) * rng.uniform(0.1, 10)


def close(one, other):
    return bool((np.abs(one - other) <= CLOSE * (1 + np.abs(one))).all())


@given(SEEDS, st.integers(0, 50))
def test_the_same_numbers_have_the_same_fingerprint_whatever_holds_them(seed, count):
    array = numbers(seed, count)
    same = [array.copy(), array[::-1][::-1], np.asfortranarray(array), array.astype(object)]
    assert all(np.array_equal(fingerprint([array]), fingerprint([other])) for other in same)
    grid = numbers(seed, (count, 3))
    assert np.array_equal(fingerprint([grid]), fingerprint([np.asfortranarray(grid)]))


@given(SEEDS, st.integers(1, 50))
def test_rounding_leaves_a_fingerprint_recognisable_and_a_mistake_does_not(seed, count):
    array = numbers(seed, count)
    noise = np.random.default_rng(seed + 1).uniform(-1, 1, count)
    assert close(fingerprint([array]), fingerprint([array + 1e-9 * noise]))
    for k in {0, count // 2, count - 1}:
        moved = array.copy()
        moved[k] += 1e-3
        assert not close(fingerprint([array]), fingerprint([moved]))
    assert not close(fingerprint([array]), fingerprint([array + 1e-4 * np.sign(array)]))


@given(SEEDS, st.lists(st.integers(0, 6), min_size=2, max_size=2))
def test_another_shape_is_another_fingerprint(seed, shape):
    array = numbers(seed, shape)
    turned = array.reshape(array.shape[::-1])
    assert close(fingerprint([array]), fingerprint([turned])) == (array.shape == turned.shape)
    if shape[1]:
        longer = np.concatenate([array, np.zeros((1, shape[1]))])
        assert not close(fingerprint([array]), fingerprint([longer]))
    assert not close(fingerprint([array]), fingerprint([np.append(array.ravel(), 0)]))


@given(SEEDS, st.integers(2, 20))
def test_the_position_of_a_number_and_of_an_array_counts(seed, count):
    array = numbers(seed, count)
    assert not close(fingerprint([array]), fingerprint([np.roll(array, 1)]))
    one, other = array[: count // 2], array[count // 2 :]
    assert not close(fingerprint([one, other]), fingerprint([other, one]))
    assert not close(fingerprint([one, other]), fingerprint([array]))


def parts(inputs, outputs):
    return {axis: outputs["result"][:, k] for k, axis in enumerate("xy")}


TURN = dataclasses.replace(
    fake.EXERCISE.task("99-turn"),
    parts=parts,
    diagnoses=(),
    probes=(Probe("no angle", lambda rng: {"v": rng.random((1, 2)), "angle": np.zeros(1)}),),
)
SETS = TURN.draw_inputs(OPEN_SEED)


def turning(change):
    """A function that turns vectors, with what it finds changed."""

    def turn(v, angle):
        c, s = np.cos(angle), np.sin(angle)
        return np.array(change(c * v[0] - s * v[1], s * v[0] + c * v[1], v, angle))

    return turn


def prints(function):
    return of_answers(TURN, SETS, call_on_sets(TURN.call, {"turn": function}, SETS))


RIGHT_WAY = turning(lambda x, y, v, a: (x, y))
SWAPPED = turning(lambda x, y, v, a: (y, x))
TWICE_X = turning(lambda x, y, v, a: (2 * x, y))
TWICE_Y = turning(lambda x, y, v, a: (x, 2 * y))
MINUS = turning(lambda x, y, v, a: (-x, -y))
NAMES = (RIGHT, "swapped", "half turned", "factor", "sign")
QUANTITY = {TWICE_X: 1, TWICE_Y: 2}
PROGRAMS = [(0, RIGHT_WAY), (1, SWAPPED), (3, TWICE_X), (3, TWICE_Y), (4, MINUS)]


def table(programs):
    made = [prints(function) for _, function in programs]
    return Table(
        tuple(made[0]),
        np.array([list(found.values()) for found in made]),
        np.array([label for label, _ in programs]),
        NAMES,
        ("", *(f"hint on {name}" for name in NAMES[1:])),
        2,
        ("", "", "which half?", "which factor?", "which sign?"),
        np.array([QUANTITY.get(function, 0) for _, function in programs]),
        ("", "the computation of `x`", "the computation of `y`"),
        ("", "", "where does y point?"),
    )


@pytest.fixture
def known(monkeypatch):
    """Make tables of programs known."""

    def know(*programs):
        monkeypatch.setattr(fingerprints, "tables", lambda id: {TURN.id: table(programs)})

    know(*PROGRAMS)
    return know


def named(function):
    found = fingerprints.find_mistake(TURN, SETS, call_on_sets(TURN.call, {"turn": function}, SETS))
    return found and found.name


def test_a_mistake_is_named_by_what_it_computes_however_it_is_written(known):
    assert named(SWAPPED) == "swapped"
    assert named(lambda v, angle: RIGHT_WAY(v, angle)[::-1] * (1 + 1e-10)) == "swapped"
    assert named(turning(lambda x, y, v, a: (x + x, y))) == "factor"
    assert named(RIGHT_WAY) is None
    assert named(turning(lambda x, y, v, a: (x, 1.0001 * y))) is None


def test_the_hint_of_a_family_names_the_quantity_if_all_programs_agree_on_it(known):
    def found(function):
        answers = call_on_sets(TURN.call, {"turn": function}, SETS)
        mistake = fingerprints.find_mistake(TURN, SETS, answers)
        return mistake.hint, mistake.asks

    in_x = "Look at the computation of `x`. which factor?"
    assert found(TWICE_X) == (FAMILY_HINT.format("hint on factor in the computation of `x`"), in_x)
    in_y = FAMILY_HINT.format("hint on factor in the computation of `y`")
    assert found(TWICE_Y) == (in_y, "where does y point?")
    assert found(MINUS) == (FAMILY_HINT.format("hint on sign"), "")
    twice = turning(lambda x, y, v, a: (2 * x, y))
    known(*PROGRAMS, (3, twice))  # in an unknown quantity
    assert found(TWICE_X) == (FAMILY_HINT.format("hint on factor"), "")
    known(*PROGRAMS, (2, twice))
    assert found(TWICE_X) == ("hint on half turned", "which half?")


def test_named_mistakes_precede_families_and_the_first_precedes_others(known):
    known(*PROGRAMS, (4, SWAPPED), (2, SWAPPED))
    assert named(SWAPPED) == "swapped"


def test_an_answer_that_two_families_explain_is_reported_for_neither(known):
    known(*PROGRAMS, (3, MINUS))
    assert named(MINUS) is None
    known(*PROGRAMS, (3, MINUS), (2, MINUS))
    assert named(MINUS) == "half turned"


def test_one_mistake_must_explain_all_that_is_wrong_else_the_first_part_is_reported(known):
    both = turning(lambda x, y, v, a: (2 * x, -y))
    assert named(both) == "factor"  # of x; and the sign of y comes next
    assert named(turning(lambda x, y, v, a: (x**3, -y))) == "sign"
    assert named(turning(lambda x, y, v, a: (x**3, y**3))) is None
    assert named(turning(lambda x, y, v, a: (y, -y))) == "swapped"


def test_a_failure_on_a_probe_is_part_of_the_fingerprint(known):
    def fails(v, angle, how=lambda: 1 / 0):
        return RIGHT_WAY(v, angle) if angle else how()

    assert named(fails) is None
    known(*PROGRAMS, (2, fails))
    assert named(fails) == "half turned"
    assert named(lambda v, angle: fails(v, angle, lambda: [][0])) == "half turned"
    assert named(lambda v, angle: fails(v, angle, lambda: [0, 1, 2])) is None


def test_a_failure_that_a_mistake_shares_explains_only_the_same_numbers(known):
    def failing(function):
        return lambda v, angle: function(v, angle) if angle else 1 / 0

    known(*PROGRAMS, (3, failing(RIGHT_WAY)))
    assert named(failing(RIGHT_WAY)) is None  # that it fails was reported; a factor is irrelevant
    known(*PROGRAMS, (3, failing(TWICE_X)))
    assert named(failing(RIGHT_WAY)) is None  # though y is as there: right, and failing
    assert named(failing(TWICE_X)) == "factor"


def test_without_a_table_and_for_numbers_that_overflow_nothing_is_recognised(known, monkeypatch):
    with np.errstate(all="ignore"):
        assert named(lambda v, angle: np.array([np.nan, 1e308])) is None
    monkeypatch.undo()
    assert fingerprints.tables("99") == {}
    assert named(SWAPPED) is None


def test_a_named_mistake_precedes_a_property_and_a_property_precedes_a_family(known):
    reported = Diagnosis("told", "hint on a property", lambda inputs, outputs: True)
    task = dataclasses.replace(TURN, diagnoses=(reported,))
    found = [run_and_explain(task, {"turn": function}) for function in (SWAPPED, MINUS)]
    hints = [(verdict.diagnosis, verdict.hint) for verdict in found]
    assert hints == [("swapped", "hint on swapped"), ("told", "hint on a property")]
    assert run_and_explain(task, {"turn": RIGHT_WAY}).full
