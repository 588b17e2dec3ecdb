"""The case shown fails the law, is the smallest there is, and is seen by the student only."""

import dataclasses
import json
import re
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.exercises import case_text, cases
from slamlab.exercises.drives.input_sets import MAIN, run_sets
from slamlab.exercises.law import Law, equals
from slamlab.exercises.report import format_verdict
from slamlab.exercises.run_task import run_and_tell
from slamlab.exercises.task import OPEN_SEED, UNCHANGED, Probe
from slamlab.grading import feedback, gradebook_rows, judge
from slamlab.grading.marks import mark
from slamlab.grading.records import Record
from slamlab.grading.submissions import Submission
from slamlab.reviewing import submission_view
from tests.grading import fake
from tests.grading.conftest import notebook, workers


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
SETS = TURN.draw(OPEN_SEED)


def turn(v, angle):
    return want({"v": v[None], "angle": np.array([angle])})["result"][0]


def answered(function, task=TURN):
    """What a function answers, and how it is run again."""

    def run(inputs):
        return run_sets(task.drive, {"turn": function}, {MAIN: inputs})[MAIN]

    return run_sets(task.drive, {"turn": function}, task.draw(OPEN_SEED)), run


def told(function, task=TURN):
    return run_and_tell(task, {"turn": function}).case


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

    answers, run = answered(somewhere_wrong)
    tried = cases.smallest(TURN, SETS, answers)
    shown = cases.smallest(TURN, SETS, answers, run)
    failing = [
        {name: array[k : k + 1] for name, array in inputs.items()}
        for set_, inputs in SETS.items()
        for k in np.flatnonzero(TURN.broken(TURN.laws[0], inputs, answers[set_]))
    ]
    if not failing:
        assert tried is shown is None
        return
    sizes = [cases._size(inputs) for inputs in failing]
    assert cases._size(shown.inputs) <= cases._size(tried.inputs) == min(sizes)
    v, angle = shown.inputs["v"][0], shown.inputs["angle"][0]
    np.testing.assert_array_equal(shown.outputs["result"], [somewhere_wrong(v, angle)])
    assert not np.allclose(shown.outputs["result"], [turn(v, angle)])
    for name, array in shown.inputs.items():
        assert not shown.probe or any(np.array_equal(array[0], a) for a in SETS[shown.probe][name])
    for name, array in tried.inputs.items() if shown.probe == tried.probe else ():
        # rounder, but the same place
        assert np.abs(shown.inputs[name] - array).max() <= 0.5 * np.abs(array).max()


def test_a_mistake_made_everywhere_is_shown_at_round_numbers():
    answers, run = answered(WRONG["right"])
    case = cases.smallest(TURN, SETS, answers, run)
    assert set(np.concatenate([*case.inputs["v"], case.inputs["angle"]])) <= {0.4, 1, 2}
    assert cases._size(case.inputs) < cases._size(cases.smallest(TURN, SETS, answers).inputs)


def test_it_says_what_was_given_returned_and_wanted():
    case = told(lambda v, angle: turn(v, angle) if angle else 2 * v)
    lines = [line.strip() for line in case.splitlines()]
    assert lines[0] == "For instance, with no angle:"
    assert lines[1] == "turn is given"
    v = np.array(json.loads(lines[2].removeprefix("v = ")))
    assert lines[3] == "angle = 0"
    assert lines[4] == "it returns"
    np.testing.assert_allclose(json.loads(lines[5]), 2 * v, rtol=1e-3)
    assert lines[6] == "and should return"
    np.testing.assert_allclose(json.loads(lines[7]), v)


def test_numbers_that_look_alike_are_told_where_they_differ():
    task = dataclasses.replace(TURN, rounds=False)
    case = told(lambda v, angle: turn(v, angle) * [1, 1.00003], task)
    got, want = re.search(r"most of all result\[1\]: (\S+) instead of (\S+)$", case).groups()
    assert float(got) == pytest.approx(1.00003 * float(want))
    assert "most of all" not in told(lambda v, angle: 2 * v)


def test_what_is_said_to_be_a_probe_is_one():
    quarter = Probe(
        "quarter turns", lambda rng: {"v": np.ones((2, 2)), "angle": np.pi / 2 * QUARTERS}
    )
    task = dataclasses.replace(TURN, probes=(quarter,))
    case = told(lambda v, angle: turn(v, angle) * (1 if 0 < angle < 1.3 else 2), task)
    assert case.startswith("    For instance, with quarter turns:\n")
    assert re.search(r"angle = (1.571|-3.142)\n", case)
    everywhere = told(lambda v, angle: 2 * turn(v, angle), task)
    assert everywhere.startswith("    For instance:\n")
    assert "v = [2, 1]\n      angle = 1\n" in everywhere


QUARTERS = np.array([1.0, -2.0])


def test_a_law_that_builds_on_a_broken_one_is_not_told_as_broken_too():
    turned = TURN.laws[0]
    later = dataclasses.replace(turned, name="far", says="and so it is far off", after=("turned",))
    task = dataclasses.replace(TURN, laws=(turned, later))
    verdict = run_and_tell(task, {"turn": lambda v, angle: 2 * v + angle})
    said = format_verdict(task, verdict)
    assert verdict.points == 0
    assert "✗ turns left: broken by" in said
    assert "– and so it is far off: builds on a law that is broken (0 of 2 points)" in said
    alone = dataclasses.replace(TURN, laws=(dataclasses.replace(turned, after=("other",)),))
    assert "✗ turns left" in format_verdict(alone, verdict)


def test_pages_tell_of_each_law_what_the_notebook_tells(monkeypatch):
    turned = TURN.laws[0]
    later = dataclasses.replace(turned, name="far", says="and so it is far off", after=("turned",))
    alone = Law("sign", 1, "is a pair", lambda i, o: True, alone=False)
    task = dataclasses.replace(TURN, laws=(turned, later, alone))
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    verdict = run_and_tell(task, {"turn": lambda v, angle: 2 * v + angle})
    marks = [line.split()[0] for line in format_verdict(task, verdict).splitlines()[1:5]]
    assert marks == ["✗", "–", "✓", "✓"]
    one = mark(Record("a.ipynb", "a", "99", verdicts=(verdict,), titles={task.id: task.title}))
    text, page = feedback.feedback_text(one), feedback.feedback_page(one)
    assert [line.split()[0] for line in text.splitlines()[4:8]] == marks
    assert re.findall(r'<li class="(\w+)"', page) == ["broken", "waits", "kept", "kept"]
    for told in (text, page):
        assert "builds on a law that is broken" in told
        assert "by itself it earns nothing" in told
    told = SimpleNamespace(counts=[0, 0, 1], mistakes=[])
    view = submission_view._task(SimpleNamespace(mistakes={task.id: told}), one, task)
    assert [law["mark"] for law in view["laws"]] == marks


def test_a_tick_without_points_says_why():
    tick = Law("sized", 1, "has a size", lambda i, o: True, alone=False)
    task = dataclasses.replace(TURN, laws=(*TURN.laws, tick))
    said = format_verdict(task, run_and_tell(task, {"turn": lambda v, angle: np.cos(v)}))
    assert "✓ has a size (0 of 1 point: by itself it earns nothing)" in said


def test_where_no_law_knows_the_answer_it_says_why_this_one_cannot_be():
    law = Law(
        "turned",
        2,
        "turns left",
        lambda i, o: np.isclose(np.hypot(*o["result"].T), np.hypot(*i["v"].T)),
        why=lambda i, o: f"A turn keeps lengths, and {np.hypot(*o['result'][0]):.3g} is another.",
    )
    task = dataclasses.replace(TURN, laws=(law,))
    case = told(WRONG["too long"], task)
    assert re.search(r"A turn keeps lengths, and \d\.\d+ is another\.", case)
    assert "should return" not in case


def test_a_reason_that_cannot_be_given_for_odd_numbers_is_left_out():
    law = Law("turned", 2, "turns left", lambda i, o: i["angle"] < 0, why=lambda i, o: 1 / 0)
    assert "it returns" in told(turn, dataclasses.replace(TURN, laws=(law,)))


def test_of_a_law_on_all_inputs_together_only_the_reason_is_told():
    law = Law("turned", 2, "turns left", lambda i, o: False)
    assert told(turn, dataclasses.replace(TURN, laws=(law,))) is None
    law = dataclasses.replace(law, why=lambda i, o: f"{len(o['result'])} vectors.")
    random = "    Taken together:\n    20 vectors."  # though a probe is smaller
    assert told(turn, dataclasses.replace(TURN, laws=(law,))) == random
    law = dataclasses.replace(
        law, why=lambda i, o: "Of the maps that were drawn many are off. " * 9
    )
    lines = told(turn, dataclasses.replace(TURN, laws=(law,))).splitlines()
    assert len(lines) > 3
    assert max(map(len, lines)) <= case_text.WIDTH + 4
    assert " ".join(line.strip() for line in lines[1:]) == law.why(0, 0).strip()


def test_a_law_on_all_inputs_together_is_not_broken_by_so_many_of_them():
    said = {
        name: format_verdict(task, run_and_tell(task, {"turn": lambda v, angle: 2 * v + angle}))
        for name, task in (
            ("each", TURN),
            ("all", dataclasses.replace(TURN, laws=(Law("all", 2, "all", lambda i, o: False),))),
        )
    }
    assert "✗ turns left: broken by 22 of 22 inputs (0 of 2 points)" in said["each"]
    assert "✗ all (0 of 2 points)" in said["all"]

    def changes(v, angle):
        v += 1
        return turn(v - 1, angle)

    said = format_verdict(TURN, run_and_tell(TURN, {"turn": changes}))
    assert "what they were before it, but v changed (0 of 0.5 points)" in said


def test_of_an_exception_the_row_is_shown_that_met_it():
    def fails(v, angle):
        if 0.5 < angle < 0.8:
            raise ValueError("such an angle")
        return turn(v, angle)

    verdict = run_and_tell(TURN, {"turn": fails})
    angle = float(re.search(r"angle = (\S+)", verdict.case)[1])
    assert 0.5 < angle < 0.8
    assert "and fails: ValueError: such an angle" in verdict.case
    assert verdict.kind == "raised"


def test_of_an_exception_the_row_is_found_among_many():
    many = {"v": np.ones((300, 2)), "angle": np.append(np.full(299, 0.4), 0.6)}
    task = dataclasses.replace(TURN, inputs=lambda rng: many, probes=())
    case = told(lambda v, angle: turn(v, angle) / (1 if angle < 0.5 else [][0]), task)
    assert "angle = 0.6" in case


def test_a_distance_that_is_infinite_is_told_as_infinity(monkeypatch):
    monkeypatch.setitem(case_text.READINGS, TURN.id, case_text.READINGS["02-echo"])
    task = dataclasses.replace(
        TURN,
        drive=dataclasses.replace(
            TURN.drive,
            run=lambda functions, inputs: {
                "met": np.zeros(len(inputs["angle"])),
                "distance": np.zeros(len(inputs["angle"])),
            },
        ),
        shapes=lambda inputs: dict.fromkeys(("met", "distance"), inputs["angle"].shape),
        laws=(equals("far", 2, "is 2 m away", lambda i: {n: 0 * i["angle"] + a for n, a in FAR}),),
        rounds=False,
    )
    lines = [line.strip() for line in told(turn, task).splitlines()]
    assert lines[-4:] == ["it returns", "inf", "and should return", "2"]


FAR = (("met", 1.0), ("distance", 2.0))


def test_a_whole_number_is_told_in_all_its_digits():
    assert case_text.format_numbers("seed", np.array(795512345.0)) == "seed = 795512345"
    assert case_text.format_numbers("x", np.array([0.12345, 1e-20, 3.0])) == "x = [0.1235, 0, 3]"
    assert case_text.format_numbers("r", np.array([np.nan, 2.5, np.inf])) == "r = [nan, 2.5, inf]"


def test_of_an_exception_on_a_probe_the_probe_is_shown():
    def fails(v, angle):
        return turn(v, angle) / (1 if angle else [][0])

    case = told(fails)
    assert case.startswith("    For instance, with no angle:")
    assert "angle = 0" in case
    assert "and fails: IndexError" in case


def test_of_what_fails_everywhere_the_smallest_input_is_shown_with_round_numbers():
    few = Probe("one right angle", lambda rng: {"v": np.ones((1, 2)), "angle": np.full(1, 2.0)})
    exact = dataclasses.replace(TURN, probes=(*TURN.probes, few), rounds=False)
    case = told(lambda v, angle: turn(v, angle) / [][0], exact)
    assert case.startswith("    For instance, with one right angle:")
    plain = told(lambda v, angle: turn(v, angle) / [][0], dataclasses.replace(TURN, probes=()))
    numbers = re.findall(r"-?\d+\.?\d*", plain.split("and fails")[0])
    assert all(float(number) * 10 == round(float(number) * 10) for number in numbers)


def test_a_probe_that_meets_another_exception_is_not_shown_for_the_first():
    def fails(v, angle):
        return [][0] if angle else 1 / int(angle)

    verdict = run_and_tell(TURN, {"turn": fails})
    assert verdict.problem.startswith("IndexError")
    assert "and fails: IndexError" in verdict.case
    assert "no angle" not in verdict.case


def test_a_row_that_fails_only_because_it_is_one_is_not_taken_for_the_cause():
    total = fake.EXERCISE.task("99-total")  # its answer has 20 entries, whatever it is given

    def fails(a):
        return 1 // int(a[0] < 1.9)

    verdict = run_and_tell(total, {"total": fails, "double": abs})
    assert verdict.kind == "raised"
    assert json.loads(re.search(r"a = (\[.*?\])", verdict.case)[1])[0] >= 1.9
    verdict = run_and_tell(total, {"total": lambda a: np.inf if a[0] > 1.9 else 1, "double": abs})
    assert (verdict.kind, verdict.case) == ("malformed", None)


def test_what_is_changed_in_place_is_named():
    def changes(v, angle):
        v *= 1.0 + angle
        return turn(v / (1 + angle), angle)

    case = told(changes)
    assert case == "    turn changes v: work on a copy, such as v = v.copy()"


def test_laws_that_hold_have_no_case_and_the_first_that_fails_is_shown():
    answers, run = answered(turn)
    assert cases.smallest(TURN, SETS, answers, run) is None
    assert told(turn) is None
    task = dataclasses.replace(TURN, laws=(*TURN.laws, Law("never", 1, "", lambda i, o: False)))
    assert cases.smallest(task, SETS, answers).law.name == "never"
    answers, _ = answered(WRONG["right"], task)
    assert cases.smallest(task, SETS, answers).law.name == "turned"
    assert task.all_laws[-1] is UNCHANGED


def test_numbers_that_must_not_be_rounded_are_not():
    task = dataclasses.replace(TURN, rounds=False)
    answers, run = answered(WRONG["right"], task)
    case = cases.smallest(task, SETS, answers, run)
    assert any(np.array_equal(case.inputs["v"][0], row) for row in SETS[MAIN]["v"])


def test_a_rounded_case_keeps_what_is_promised():
    task = dataclasses.replace(TURN, rounds=lambda i: np.hypot(*i["v"].T) > 1.7)
    answers, run = answered(WRONG["too long"], task)
    case = cases.smallest(task, SETS, answers, run)
    broken = dataclasses.replace(task, rounds=lambda i: 1 / 0)
    assert np.hypot(*case.inputs["v"][0]) > 1.7
    assert set(case.inputs["v"][0]) <= {1, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2}
    unrounded = cases.smallest(broken, SETS, answers, run)
    assert any(np.array_equal(unrounded.inputs["v"][0], row) for row in SETS["no angle"]["v"])


@pytest.mark.parametrize("columns", [2, 3])
def test_a_covariance_stays_one_when_it_is_rounded(columns):
    rng = np.random.default_rng(3)
    for _ in range(100):
        root = rng.normal(size=(3, columns))
        P = root @ root.T * rng.uniform(1e-4, 10)
        before = np.linalg.eigvalsh(P)
        for digits in cases.DIGITS:
            rounded = cases._rounded(P[None], digits)
            if rounded is not None:  # as sure of nothing as before, and no surer of anything else
                after = np.linalg.eigvalsh(rounded[0])
                assert after.min() > (0 if columns == 3 else -1e-9 * before.max())
                assert (after >= 0.1 * before - 1e-9 * before.max()).all()


@pytest.mark.parametrize(
    "array",
    [np.zeros((0, 2)), np.arange(3), np.array([True]), np.zeros(3), np.eye(70), np.array(1e-300)],
)
def test_any_array_can_be_told(array):
    text = case_text.format_numbers("x", array)
    assert text.startswith("x = ")
    assert all(len(line) <= case_text.WIDTH + 10 for line in text.splitlines())


def test_long_bytes_and_long_names_are_wrapped():
    for name in ("data", "a name that is long"):
        lines = case_text.format_numbers(name, np.arange(10.0, 60)).splitlines()
        assert len(lines) > 1
        assert all(len(line) <= case_text.WIDTH for line in lines)
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
def test_under_the_grader_nothing_of_a_case_or_a_value_is_said(body, tmp_path, monkeypatch):
    exercise = dataclasses.replace(fake.EXERCISE, tasks=(TURN,))
    monkeypatch.setattr(fake, "EXERCISE", exercise)
    file = tmp_path / "anna.ipynb"
    file.write_text(notebook("import numpy as np", f"def turn(v, angle):\n    {body}"))
    record = judge.grade_submission(Submission(file.name, "anna", file), b"s" * 16, workers())
    (verdict,) = record.verdicts
    assert verdict.points == 0
    assert verdict.case is None
    row = gradebook_rows.stored(record)["record"]
    said = json.dumps(row["verdicts"]) + json.dumps(row["cells"])
    page = feedback.feedback_page(mark(record)).partition("</style>")[2]
    for text in (said, page, record.note):
        assert "instance" not in text
        assert "should return" not in text
        assert NUMBER.findall(text) == []
