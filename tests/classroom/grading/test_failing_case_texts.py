"""The text of a failing case: what was given, returned and wanted, and only for the student."""

import dataclasses
import json
import re

import numpy as np
import pytest

from classroom.exercises import failing_case_text
from classroom.exercises.correctness_laws import Law, equals
from classroom.exercises.task import UNCHANGED
from classroom.exercises.verdict_text import format_verdict
from classroom.grading import feedback, gradebook_rows, judge
from classroom.grading.marks import mark
from classroom.grading.submissions import Submission
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, workers
from tests.classroom.grading.program_verdicts import explained_verdict, mistake
from tests.classroom.grading.turning_task import (
    TURN,
    WRONG,
    report,
    shown,
    turn,
    verdict_of,
    with_laws,
)


def text_of(function, task=TURN):
    return format_verdict(task, verdict_of(function, task))


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


@pytest.mark.parametrize(
    ("id", "name", "outputs", "text"),
    [
        ("08-associate", "pairs", {"pairs": [1.0, -1.0]}, "[1, None]"),
        ("08-pillar", "pillar", {"found": 0.0, "pillar": [0.0] * 3, "inside": [0.0]}, "None"),
    ],
)
def test_none_is_shown_as_none(id, name, outputs, text):
    arrays = {key: np.array(value) for key, value in outputs.items()}
    _, shown = failing_case_text.PRESENTATIONS[id].shown({}, arrays)
    assert list(shown) == [name]
    assert str(shown[name]) == text


def test_the_case_of_whole_runs_is_short_and_has_no_rows_that_pad_it():
    for name in ("S-incomplete", "innovation-not-wrapped"):
        case = explained_verdict("06-consistent", mistake("06-consistent", name)).case
        assert "-1]" not in case
        assert len(case.splitlines()) <= 60


def test_a_whole_number_is_reported_in_all_its_digits():
    for numbers, text in (
        (795512345.0, "795512345"),
        ([0.12345, 1e-20, 3.0], "[0.1235, 0, 3]"),
        ([np.nan, 2.5, np.inf], "[nan, 2.5, inf]"),
    ):
        assert failing_case_text.format_numbers("x", np.array(numbers)) == f"x = {text}"


def test_laws_that_hold_have_no_case_and_the_first_that_fails_is_shown():
    assert shown(turn) is None
    assert report(turn) is None
    task = with_laws(*TURN.laws, Law("never", 1, "", lambda i, o: False))
    assert shown(turn, task).law.name == "never"
    assert shown(WRONG["right"], task).law.name == "turned"
    assert task.all_laws[-1] is UNCHANGED


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
    assert verdict.problem or "loses the points for “" in record.note
    row = gradebook_rows.stored(record)["record"]
    answer = json.dumps(row["verdicts"]) + json.dumps(row["cells"])
    page = feedback.feedback_page(mark(record)).partition("</style>")[2]
    for text in (answer, page, record.note):
        assert "instance" not in text
        assert "should return" not in text
        assert NUMBER.findall(text) == []
