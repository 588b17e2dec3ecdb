"""A fingerprint is that of the numbers, not of their rounding; one mistake must explain all."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.exercises import fingerprints
from slamlab.exercises.drives.input_sets import run_sets
from slamlab.exercises.fingerprints import CLOSE, RIGHT, Table, fingerprint, of_answers
from slamlab.exercises.law import Diagnosis
from slamlab.exercises.run_task import run_and_tell
from slamlab.exercises.task import OPEN_SEED, Probe
from tests.grading import fake

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
def test_the_place_of_a_number_and_of_an_array_counts(seed, count):
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
SETS = TURN.draw(OPEN_SEED)


def turning(change):
    """A function that turns vectors, with what it finds changed."""

    def turn(v, angle):
        c, s = np.cos(angle), np.sin(angle)
        return np.array(change(c * v[0] - s * v[1], s * v[0] + c * v[1], v, angle))

    return turn


def prints(function):
    return of_answers(TURN, SETS, run_sets(TURN.drive, {"turn": function}, SETS))


RIGHT_WAY = turning(lambda x, y, v, a: (x, y))
SWAPPED = turning(lambda x, y, v, a: (y, x))
TWICE_X = turning(lambda x, y, v, a: (2 * x, y))
TWICE_Y = turning(lambda x, y, v, a: (x, 2 * y))
MINUS = turning(lambda x, y, v, a: (-x, -y))
NAMES = (RIGHT, "swapped", "half turned", "factor", "sign")
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
    )


@pytest.fixture
def known(monkeypatch):
    """Make tables of programs known."""

    def know(*programs):
        monkeypatch.setattr(fingerprints, "tables", lambda id: {TURN.id: table(programs)})

    know(*PROGRAMS)
    return know


def named(function):
    found = fingerprints.recognise(TURN, SETS, run_sets(TURN.drive, {"turn": function}, SETS))
    return found and found.name


def test_a_mistake_is_named_by_what_it_computes_however_it_is_written(known):
    assert named(SWAPPED) == "swapped"
    assert named(lambda v, angle: RIGHT_WAY(v, angle)[::-1] * (1 + 1e-10)) == "swapped"
    assert named(turning(lambda x, y, v, a: (x + x, y))) == "factor"
    assert named(RIGHT_WAY) is None
    assert named(turning(lambda x, y, v, a: (x, 1.0001 * y))) is None


def test_slips_go_before_families_and_the_first_slip_before_others(known):
    known(*PROGRAMS, (4, SWAPPED), (2, SWAPPED))
    assert named(SWAPPED) == "swapped"


def test_what_two_families_explain_is_said_of_neither(known):
    known(*PROGRAMS, (3, MINUS))
    assert named(MINUS) is None
    known(*PROGRAMS, (3, MINUS), (2, MINUS))
    assert named(MINUS) == "half turned"


def test_one_mistake_must_explain_all_that_is_wrong_else_the_first_part_is_told(known):
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


def test_no_family_is_told_of_what_fails_and_is_right_elsewhere(known):
    def failing(v, angle):
        return RIGHT_WAY(v, angle) if angle else 1 / 0

    known(*PROGRAMS, (3, failing))
    assert named(failing) is None  # that it fails was told; a factor has nothing to do with it


def test_failing_where_a_mistake_fails_makes_no_part_like_it(known):
    def failing(function):
        return lambda v, angle: function(v, angle) if angle else 1 / 0

    known(*PROGRAMS, (3, failing(TWICE_X)))
    assert named(failing(RIGHT_WAY)) is None  # though y is as there: right, and failing
    assert named(failing(TWICE_X)) == "factor"


def test_what_has_no_table_is_not_recognised(monkeypatch):
    assert fingerprints.tables("99") == {}
    assert named(SWAPPED) is None


def test_check_tells_the_mistake_by_its_hint(known):
    verdict = run_and_tell(TURN, {"turn": SWAPPED})
    assert (verdict.diagnosis, verdict.hint) == ("swapped", "hint on swapped")
    assert run_and_tell(TURN, {"turn": RIGHT_WAY}).full


def test_a_slip_says_more_than_a_property_and_a_property_more_than_a_family(known):
    told = Diagnosis("told", "hint on a property", lambda inputs, outputs: True)
    task = dataclasses.replace(TURN, diagnoses=(told,))
    found = [run_and_tell(task, {"turn": function}) for function in (SWAPPED, MINUS)]
    assert [verdict.diagnosis for verdict in found] == ["swapped", "told"]


def test_of_numbers_that_overflow_nothing_is_said(known):
    with np.errstate(all="ignore"):
        assert named(lambda v, angle: np.array([np.nan, 1e308])) is None
