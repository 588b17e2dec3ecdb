"""The failing case breaks the law, is the smallest, and is shown to the student only."""

import dataclasses
import json
import re
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from classroom.exercises import failing_case_text, failing_cases
from classroom.exercises.correctness_laws import Law, equals
from classroom.exercises.function_calls.run_and_pack import MAIN, call_on_sets
from classroom.exercises.run_task import run_and_explain
from classroom.exercises.task import OPEN_SEED, UNCHANGED, Probe
from classroom.exercises.verdict_text import format_verdict
from classroom.grading import feedback, gradebook_rows, judge
from classroom.grading.marks import mark
from classroom.grading.records import Record
from classroom.grading.submissions import Submission
from classroom.reviewing import submission_view
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, workers


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


def text_of(function, task=TURN):
    return format_verdict(task, verdict_of(function, task))


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


@given(
    st.sampled_from(sorted(WRONG)),
    st.floats(0, 2),
    st.sampled_from(["angle", "x", "y"]),
    st.booleans(),
)
@settings(max_examples=60, deadline=None)
def test_the_case_fails_the_law_and_is_no_larger_than_any_that_was_tried(which, bound, of, below):
    def somewhere_wrong(v, angle):
        value = {"angle": angle, "x": v[0], "y": v[1]}[of]
        return (WRONG[which] if (value < bound) == below else turn)(v, angle)

    answers, _ = answered(somewhere_wrong)
    tried, case = shown(somewhere_wrong, again=False), shown(somewhere_wrong)
    failing = [
        {name: array[k : k + 1] for name, array in inputs.items()}
        for set_, inputs in SETS.items()
        for k in np.flatnonzero(TURN.broken(TURN.laws[0], inputs, answers[set_]))
    ]
    if not failing:
        assert tried is case is None
        return
    again = [failing_cases._size(inputs) for inputs in failing]
    assert failing_cases._size(case.inputs) <= failing_cases._size(tried.inputs) == min(again)
    v, angle = case.inputs["v"][0], case.inputs["angle"][0]
    np.testing.assert_array_equal(case.outputs["result"], [somewhere_wrong(v, angle)])
    assert not np.allclose(case.outputs["result"], [turn(v, angle)])
    for name, array in case.inputs.items():
        assert not case.probe or any(np.array_equal(array[0], a) for a in SETS[case.probe][name])
    for name, array in tried.inputs.items() if case.probe == tried.probe else ():
        # rounder, but the same place
        assert np.abs(case.inputs[name] - array).max() <= 0.5 * np.abs(array).max()


def test_a_mistake_made_everywhere_is_shown_at_round_numbers_unless_they_must_not_be_rounded():
    case = shown(WRONG["right"])
    assert set(np.concatenate([*case.inputs["v"], case.inputs["angle"]])) <= {0.4, 1, 2}
    tried = shown(WRONG["right"], again=False)
    assert failing_cases._size(case.inputs) < failing_cases._size(tried.inputs)
    exact = shown(WRONG["right"], dataclasses.replace(TURN, may_round=False))
    assert any(np.array_equal(exact.inputs["v"][0], row) for row in SETS[MAIN]["v"])


def test_it_states_what_was_given_returned_and_wanted():
    case = report(lambda v, angle: turn(v, angle) if angle else 2 * v)
    lines = [line.strip() for line in case.splitlines()]
    assert lines[0] == "For instance, with no angle:"
    assert lines[1] == "turn is given"
    v = np.array(json.loads(lines[2].removeprefix("v = ")))
    assert lines[3] == "angle = 0"
    assert lines[4] == "it returns"
    np.testing.assert_allclose(json.loads(lines[5]), 2 * v, rtol=1e-3)
    assert lines[6] == "and should return"
    np.testing.assert_allclose(json.loads(lines[7]), v)


def test_similar_numbers_are_reported_at_the_digits_where_they_differ():
    task = dataclasses.replace(TURN, may_round=False)
    case = report(lambda v, angle: turn(v, angle) * [1, 1.00003], task)
    error = r"the largest error is at result\[1\]: (\S+) instead of (\S+)$"
    got, want = re.search(error, case).groups()
    assert float(got) == pytest.approx(1.00003 * float(want))
    assert "the largest error" not in report(lambda v, angle: 2 * v)


def test_every_declared_probe_is_one():
    angles = np.pi / 2 * np.array([1.0, -2.0])
    quarter = Probe("quarter turns", lambda rng: {"v": np.ones((2, 2)), "angle": angles})
    task = dataclasses.replace(TURN, probes=(quarter,))
    case = report(lambda v, angle: turn(v, angle) * (1 if 0 < angle < 1.3 else 2), task)
    assert case.startswith("    For instance, with quarter turns:\n")
    assert re.search(r"angle = (1.571|-3.142)\n", case)
    everywhere = report(lambda v, angle: 2 * turn(v, angle), task)
    assert everywhere.startswith("    For instance:\n")
    assert "v = [2, 1]\n      angle = 1\n" in everywhere


def test_a_law_that_builds_on_a_broken_one_or_earns_nothing_alone_is_marked(monkeypatch):
    """In the notebook, in the feedback, and in the review."""
    turned = TURN.laws[0]
    later = dataclasses.replace(turned, name="far", says="and so it is far off", after=("turned",))
    alone = Law("sign", 1, "is a pair", lambda i, o: True, alone=False)
    task = with_laws(turned, later, alone)
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    verdict = verdict_of(lambda v, angle: 2 * v + angle, task)
    printed = format_verdict(task, verdict)
    assert verdict.points == 0
    assert "✗ turns left: broken by" in printed
    assert "– and so it is far off: depends on a broken law (0 of 2 points)" in printed
    assert "✓ is a pair (0 of 1 point: earns no points alone)" in printed
    marks = [line.split()[0] for line in printed.splitlines()[1:5]]
    assert marks == ["✗", "–", "✓", "✓"]
    one = mark(Record("a.ipynb", "a", "99", verdicts=(verdict,), titles={task.id: task.title}))
    text, page = feedback.feedback_text(one), feedback.feedback_page(one)
    assert [line.split()[0] for line in text.splitlines()[4:8]] == marks
    assert re.findall(r'<li class="(\w+)"', page) == ["broken", "waits", "kept", "kept"]
    for reported in (text, page):
        assert "depends on a broken law" in reported
        assert "earns no points alone" in reported
    reported = SimpleNamespace(counts=[0, 0, 1], mistakes=[])
    view = submission_view._task(
        SimpleNamespace(mistakes={task.id: reported}), SimpleNamespace(mark=one, undecided={}), task
    )
    assert [law["mark"] for law in view["laws"]] == marks
    other = with_laws(dataclasses.replace(turned, after=("other",)))
    assert "✗ turns left" in format_verdict(other, verdict)


def test_where_no_law_knows_the_answer_it_explains_why_this_one_cannot_be():
    def keeps_length(i, o):
        return np.isclose(np.hypot(*o["result"].T), np.hypot(*i["v"].T))

    def why(i, o):
        return f"A turn keeps lengths: {np.hypot(*o['result'][0]):.3g}."

    law = Law("turned", 2, "turns left", keeps_length, why=why)
    case = report(WRONG["too long"], with_laws(law))
    assert re.search(r"A turn keeps lengths: \d\.\d+\.", case)
    assert "should return" not in case
    without = dataclasses.replace(law, why=lambda i, o: 1 / 0)  # no reason for odd numbers
    assert "it returns" in report(WRONG["too long"], with_laws(without))


def test_for_a_law_on_all_inputs_together_only_the_reason_is_reported():
    law = Law("turned", 2, "turns left", lambda i, o: False)
    assert report(turn, with_laws(law)) is None
    assert "✗ turns left (0 of 2 points)" in text_of(turn, with_laws(law))
    law = dataclasses.replace(law, why=lambda i, o: f"{len(o['result'])} vectors.")
    random = "    Taken together:\n    20 vectors."  # though a probe is smaller
    assert report(turn, with_laws(law)) == random
    long = "Of the maps that were drawn many are off. " * 9
    lines = report(turn, with_laws(dataclasses.replace(law, why=lambda i, o: long))).splitlines()
    assert len(lines) > 3
    assert max(map(len, lines)) <= failing_case_text.WIDTH + 4
    assert " ".join(line.strip() for line in lines[1:]) == long.strip()


def test_the_inputs_that_break_a_law_are_counted_and_what_was_changed_is_named():
    text = text_of(lambda v, angle: 2 * v + angle)
    assert "✗ turns left: broken by 22 of 22 inputs (0 of 2 points)" in text

    def changes(v, angle):
        v *= 1.0 + angle
        return turn(v / (1 + angle), angle)

    assert "unchanged after the call, but v changed (0 of 0.5 points)" in text_of(changes)
    assert report(changes) == "    turn changes v."


@pytest.mark.parametrize("count", [20, 300])
def test_the_row_that_raised_an_exception_is_shown(count):
    def fails(v, angle):
        if 0.5 < angle < 0.8:
            raise ValueError("such an angle")
        return turn(v, angle)

    many = {"v": np.ones((count, 2)), "angle": np.append(np.full(count - 1, 0.4), 0.6)}
    verdict = verdict_of(fails, dataclasses.replace(TURN, inputs=lambda rng: many, probes=()))
    assert "angle = 0.6" in verdict.case
    assert "and fails: ValueError: such an angle" in verdict.case
    assert verdict.kind == "raised"


def test_a_distance_that_is_infinite_is_reported_as_infinity(monkeypatch):
    presentations = failing_case_text.PRESENTATIONS
    monkeypatch.setitem(presentations, TURN.id, presentations["02-echo"])
    away = (("met", 1.0), ("distance", 2.0))
    task = with_laws(
        equals("far", 2, "is 2 m away", lambda i: {n: a + 0 * i["angle"] for n, a in away}),
        call=dataclasses.replace(
            TURN.call, run=lambda _, inputs: {n: 0 * inputs["angle"] for n, _ in away}
        ),
        shapes=lambda inputs: dict.fromkeys(("met", "distance"), inputs["angle"].shape),
        may_round=False,
    )
    lines = [line.strip() for line in report(turn, task).splitlines()]
    assert lines[-4:] == ["it returns", "inf", "and should return", "2"]


def test_a_whole_number_is_reported_in_all_its_digits():
    for numbers, text in (
        (795512345.0, "795512345"),
        ([0.12345, 1e-20, 3.0], "[0.1235, 0, 3]"),
        ([np.nan, 2.5, np.inf], "[nan, 2.5, inf]"),
    ):
        assert failing_case_text.format_numbers("x", np.array(numbers)) == f"x = {text}"


def test_a_failure_everywhere_is_shown_at_the_smallest_input_with_round_numbers():
    few = Probe("one right angle", lambda rng: {"v": np.ones((1, 2)), "angle": np.full(1, 2.0)})
    exact = dataclasses.replace(TURN, probes=(*TURN.probes, few), may_round=False)
    case = report(lambda v, angle: turn(v, angle) / [][0], exact)
    assert case.startswith("    For instance, with one right angle:")
    plain = report(lambda v, angle: turn(v, angle) / [][0], dataclasses.replace(TURN, probes=()))
    numbers = re.findall(r"-?\d+\.?\d*", plain.split("and fails")[0])
    assert all(float(number) * 10 == round(float(number) * 10) for number in numbers)


def test_the_probe_that_raised_an_exception_is_shown_and_none_that_raised_another():
    case = report(lambda v, angle: turn(v, angle) / (1 if angle else [][0]))
    assert case.startswith("    For instance, with no angle:")
    assert "angle = 0" in case
    assert "and fails: IndexError" in case
    verdict = verdict_of(lambda v, angle: [][0] if angle else 1 / int(angle))
    assert verdict.problem.startswith("IndexError")
    assert "and fails: IndexError" in verdict.case
    assert "no angle" not in verdict.case


def test_a_row_that_fails_only_because_it_is_one_is_not_taken_for_the_cause():
    total = fake.EXERCISE.task("99-total")  # its answer has 20 entries, whatever it is given

    def fails(a):
        return 1 // int(a[0] < 1.9)

    verdict = run_and_explain(total, {"total": fails, "double": abs})
    assert verdict.kind == "raised"
    assert json.loads(re.search(r"a = (\[.*?\])", verdict.case)[1])[0] >= 1.9
    endless = {"total": lambda a: np.inf if a[0] > 1.9 else 1, "double": abs}
    verdict = run_and_explain(total, endless)
    assert (verdict.kind, verdict.case) == ("malformed", None)


def test_laws_that_hold_have_no_case_and_the_first_that_fails_is_shown():
    assert shown(turn) is None
    assert report(turn) is None
    task = with_laws(*TURN.laws, Law("never", 1, "", lambda i, o: False))
    assert shown(turn, task).law.name == "never"
    assert shown(WRONG["right"], task).law.name == "turned"
    assert task.all_laws[-1] is UNCHANGED


def test_a_rounded_case_keeps_what_is_promised():
    task = dataclasses.replace(TURN, may_round=lambda i: np.hypot(*i["v"].T) > 1.7)
    case = shown(WRONG["too long"], task)
    assert np.hypot(*case.inputs["v"][0]) > 1.7
    assert set(case.inputs["v"][0]) <= {1, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2}
    unrounded = shown(WRONG["too long"], dataclasses.replace(task, may_round=lambda i: 1 / 0))
    assert any(np.array_equal(unrounded.inputs["v"][0], row) for row in SETS["no angle"]["v"])


@pytest.mark.parametrize("columns", [2, 3])
def test_a_covariance_stays_one_when_it_is_rounded(columns):
    rng = np.random.default_rng(3)
    for _ in range(100):
        root = rng.normal(size=(3, columns))
        P = root @ root.T * rng.uniform(1e-4, 10)
        before = np.linalg.eigvalsh(P)
        for digits in failing_cases.DIGITS:
            rounded = failing_cases._rounded(P[None], digits)
            if rounded is not None:  # no variance has changed
                after = np.linalg.eigvalsh(rounded[0])
                assert after.min() > (0 if columns == 3 else -1e-9 * before.max())
                assert (after >= 0.1 * before - 1e-9 * before.max()).all()


@pytest.mark.parametrize(
    "array",
    [np.zeros((0, 2)), np.arange(3), np.array([True]), np.zeros(3), np.eye(70), np.array(1e-300)],
)
def test_any_array_can_be_described(array):
    text = failing_case_text.format_numbers("x", array)
    assert text.startswith("x = ")
    assert all(len(line) <= failing_case_text.WIDTH + 10 for line in text.splitlines())


def test_long_bytes_and_long_names_are_wrapped():
    for name in ("data", "a name that is long"):
        lines = failing_case_text.format_numbers(name, np.arange(10.0, 60)).splitlines()
        assert len(lines) > 1
        assert all(len(line) <= failing_case_text.WIDTH for line in lines)
        assert all(line.startswith(" " * len(f"{name} = ")) for line in lines[1:])


NUMBER = re.compile(r"\d\.\d{2,}")
LEAKY = {
    "wrong": "return 2 * v",
    "raised": "raise ValueError(f'{v} {angle}')",
    "raised on a probe": "return np.array([1, 2]) * [v[0]][int(angle == 0)]",
    "changed": "v *= 2; return v",
    "malformed": "return [*v, angle]",
}


@pytest.mark.parametrize("body", LEAKY.values(), ids=LEAKY)
def test_under_the_grader_nothing_of_a_case_or_a_value_is_reported(body, tmp_path, monkeypatch):
    exercise = dataclasses.replace(fake.EXERCISE, tasks=(TURN,))
    monkeypatch.setattr(fake, "EXERCISE", exercise)
    file = tmp_path / "anna.ipynb"
    file.write_text(notebook("import numpy as np", f"def turn(v, angle):\n    {body}"))
    record = judge.grade_submission(Submission(file.name, "anna", file), b"s" * 16, workers())
    (verdict,) = record.verdicts
    assert verdict.points == 0
    assert verdict.case is None
    row = gradebook_rows.stored(record)["record"]
    answer = json.dumps(row["verdicts"]) + json.dumps(row["cells"])
    page = feedback.feedback_page(mark(record)).partition("</style>")[2]
    for text in (answer, page, record.note):
        assert "instance" not in text
        assert "should return" not in text
        assert NUMBER.findall(text) == []
