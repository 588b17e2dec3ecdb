"""One message contains all sets of inputs; a failure on a probe costs only its laws."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from classroom.exercises.function_calls import StudentError
from classroom.exercises.function_calls.changed_arguments import CHANGED
from classroom.exercises.function_calls.run_and_pack import pack_sets, unpack_sets
from classroom.exercises.run_task import run
from classroom.exercises.task import Probe
from classroom.exercises.verdict_text import format_verdict
from tests.classroom.grading import fake
from tests.classroom.grading.test_judge import judged

ARRAY = hnp.arrays(np.float64, hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=3))
SETS = st.dictionaries(st.text(max_size=5), st.dictionaries(st.text(max_size=5), ARRAY, max_size=3))


def same(one, other):
    return one.keys() == other.keys() and all(np.array_equal(one[n], other[n], True) for n in one)


@given(SETS)
def test_packed_sets_are_unpacked_unchanged(sets):
    again = unpack_sets(list(sets), pack_sets(sets))
    assert list(again) == list(sets)
    assert all(same(again[name], sets[name]) for name in sets)


@given(SETS, st.data())
def test_a_set_that_failed_comes_back_empty_and_moves_no_other(sets, data):
    failed = data.draw(st.sets(st.sampled_from(sorted(sets)))) if sets else set()
    error = StudentError("raised", "x")
    sent = {name: error if name in failed else arrays for name, arrays in sets.items()}
    again = unpack_sets(list(sets), pack_sets(sent))
    assert all(same(again[n], {} if n in failed else sets[n]) for n in sets)


JUNK_KEYS = st.text(max_size=8) | st.sampled_from(["0", "2/x", "-1/x", "00/x", "/", "٠/x", "1/x"])


@given(st.dictionaries(JUNK_KEYS, ARRAY, max_size=5))
def test_only_the_requested_sets_of_a_workers_answer_are_kept(sent):
    found = unpack_sets(["", "empty"], sent)
    assert list(found) == ["", "empty"]
    kept = {f"{k}/{name}" for k, arrays in enumerate(found.values()) for name in arrays}
    assert kept == {key for key in sent if key.startswith(("0/", "1/"))}


DOUBLE = dataclasses.replace(
    fake.EXERCISE.task("99-double"),
    probes=(
        Probe("nought", lambda rng: {"a": np.zeros((1, 1))}, ("twice",)),
        Probe("large ones", lambda rng: {"a": rng.uniform(1e3, 2e3, (2, 1))}),
    ),
)
EXERCISE = dataclasses.replace(fake.EXERCISE, tasks=(DOUBLE,))
SEED = b"a seed of the suite"


def verdicts(body, *more):
    """Return the verdicts of a function in one process, and of the same function in a worker."""
    source = f"import numpy as np\ndef double(a):\n    {body}\n"
    names = {}
    exec(compile(source, "<cell 1>", "exec"), names)
    (away,) = judged(source, *more, exercise=EXERCISE)["verdicts"]
    return run(DOUBLE, names, DOUBLE.draw_inputs(SEED)), away


def points(verdict):
    return {law.name: law.points for law in verdict.laws}


def test_what_a_probe_finds_costs_the_laws_it_names():
    for verdict in verdicts("return 2 * a"):
        assert verdict.full
        assert points(verdict) == {"sign": 1, "twice": 2, "unchanged": 0.5}
        assert [law.tried for law in verdict.laws] == [22, 23, 3]
    for verdict in verdicts("return 2 * a if a else 1.0"):
        assert points(verdict) == {"sign": 1, "twice": 0, "unchanged": 0.5}
        assert verdict.laws[1].where == {"nought": None}
    for verdict in verdicts("return 2 * a if a < 1000 else -a"):
        assert points(verdict) == {"sign": 0, "twice": 0, "unchanged": 0}
        assert [law.where for law in verdict.laws[:2]] == [{"large ones": None}] * 2


@pytest.mark.parametrize("fails", ["1 / 0", "None", "np.nan", "[a, a]", "exit()"])
def test_an_exception_on_a_probe_costs_its_laws_only(fails):
    for verdict in verdicts(f"return 2 * a if a else {fails}"):
        assert (verdict.problem, verdict.points) == (None, 1.5)
        assert points(verdict) == {"sign": 1, "twice": 0, "unchanged": 0.5}
        assert list(verdict.laws[1].where) == ["nought"]
        assert verdict.laws[1].where["nought"]


def test_what_is_not_attempted_on_a_probe_costs_no_more():
    for verdict in verdicts("if not a: raise NotImplementedError\n    return 2 * a"):
        assert points(verdict) == {"sign": 1, "twice": 0, "unchanged": 0.5}


def test_an_exception_on_the_random_inputs_costs_all():
    for verdict in verdicts("return 1 / 0 if a else 0"):
        assert (verdict.points, verdict.kind, verdict.laws) == (0, "raised", ())


def test_the_student_gets_the_probe_and_what_was_raised():
    here, away = verdicts("return 2 * a if a else 1 / 0")
    text = format_verdict(DOUBLE, here)
    assert "✗ is twice as large: broken with nought (0 of 2 points)" in text
    assert "\n  ZeroDivisionError: division by zero" in text
    assert "✓ keeps the sign (1 point)" in text
    text = " ".join(format_verdict(DOUBLE, away).split())
    assert "raised an exception; run check(…) in the notebook for details" in text


def test_the_report_of_a_failure_on_a_probe_reveals_nothing_of_its_inputs():
    leak = "raise ValueError(f'leak {a}') if a > 1000 else type(f'leak{a}', (Exception,), {})"
    _, away = verdicts(f"if 1 <= a <= 2: return 2 * a\n    {leak}")
    text = format_verdict(DOUBLE, away)
    assert "raised" in text
    assert "leak" not in text


JUNK = "{'3/result': np.ones(3), 'result': np.ones(20), '/': np.ones(1), '0/more': np.ones(2)}"


def test_a_worker_that_sends_junk_beside_its_answers_earns_what_they_earn():
    junk = "import classroom.exercises.function_calls.run_and_pack as i\nold = i.pack_sets\n"
    junk += f"i.pack_sets = lambda sets: old(sets) | {JUNK}"
    assert verdicts("return 2 * a", junk)[1].full
    assert verdicts("return -a", junk)[1].points == 0


@pytest.mark.parametrize(
    ("failed", "earned"),
    [
        ("[]", 3.5),
        ("{'elsewhere': ['raised', 'x'], 'nought ': None}", 3.5),
        ("{'nought': ['raised']}", 3.5),
        ("{'nought': ['full', 'all is right'], 'large ones': 7}", 1.5),
        ("{'': ['full', 'all is right']}", 0),
    ],
)
def test_a_worker_with_odd_answers_about_its_probes_gains_nothing(failed, earned):
    odd = "import classroom.grading.worker as w\nold = w._call_task\n"
    odd += "def told(*a):\n    head, arrays = old(*a)\n"
    odd += f"    return head | {{'failed': {failed}}}, arrays\n"
    assert verdicts("return 2 * a", odd + "w._call_task = told")[1].points == earned


def test_a_set_that_does_not_come_back_is_lost():
    drop = "import classroom.exercises.function_calls.run_and_pack as i\nold = i.pack_sets\n"
    drop += "i.pack_sets = lambda s: {k: v for k, v in old(s).items() if k[0] == '0'}"
    verdict = verdicts("return 2 * a", drop)[1]
    assert points(verdict) == {"sign": 0, "twice": 0, "unchanged": 0}
    drop = drop.replace("== '0'", "!= '0'")
    assert verdicts("return 2 * a", drop)[1].kind == "malformed"


def test_arguments_changed_on_a_probe_alone_are_seen():
    task = dataclasses.replace(
        fake.EXERCISE.task("99-turn"),
        probes=(Probe("no angle", lambda rng: {"v": rng.random((2, 2)), "angle": np.zeros(2)}),),
    )
    names = {}
    exec(fake.SOLUTION, names)
    turn = names["turn"]

    def lazy(v, angle):
        if angle == 0:
            v *= 1.5
            return v / 1.5
        return turn(v, angle)

    verdict = run(task, {"turn": lazy}, task.draw_inputs(SEED))
    assert points(verdict) == {"turned": 2, "unchanged": 0}
    assert verdict.laws[1].where == {"no angle": None}
    assert not verdict.full
    assert CHANGED not in task.shapes
