"""The failing case breaks the law, is the smallest, and is rounded where it may be."""

import dataclasses
import json
import re
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from classroom.exercises import failing_cases
from classroom.exercises.correctness_laws import Law
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.run_task import run_and_explain
from classroom.exercises.task import Probe
from classroom.exercises.verdict_text import format_verdict
from classroom.grading import feedback
from classroom.grading.marks import mark
from classroom.grading.records import Record
from classroom.reviewing import submission_view
from tests.classroom.grading import fake
from tests.classroom.grading.turning_task import (
    SETS,
    TURN,
    WRONG,
    answered,
    report,
    shown,
    turn,
    verdict_of,
    with_laws,
)


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
    assert "✓ is a pair (0 of 1 point: counts only together with other laws)" in printed
    marks = [line.split()[0] for line in printed.splitlines()[1:5]]
    assert marks == ["✗", "–", "✓", "✓"]
    one = mark(Record("a.ipynb", "a", "99", verdicts=(verdict,), titles={task.id: task.title}))
    text, page = feedback.feedback_text(one), feedback.feedback_page(one)
    assert [line.split()[0] for line in text.splitlines()[4:8]] == marks
    assert re.findall(r'<li class="(\w+)"', page) == ["broken", "waits", "kept", "kept"]
    for reported in (text, page):
        assert "depends on a broken law" in reported
        assert "counts only together" in reported
    reported = SimpleNamespace(counts=[0, 0, 1], mistakes=[])
    view = submission_view._task(
        SimpleNamespace(mistakes={task.id: reported}), SimpleNamespace(mark=one, undecided={}), task
    )
    assert [law["mark"] for law in view["laws"]] == marks
    other = with_laws(dataclasses.replace(turned, after=("other",)))
    assert "✗ turns left" in format_verdict(other, verdict)


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
