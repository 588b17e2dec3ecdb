"""Hints rise: a question, an intermediate result, then the sentence that names the mistake."""

import dataclasses
import re
import subprocess
import sys

import numpy as np
import pytest

from classroom.checks import check, hint, hint_levels
from classroom.exercises.correctness_laws import Law, equals
from classroom.exercises.time_limit import TimeLimitExceeded
from tests.classroom.grading import fake
from tests.classroom.grading.test_judge import judged
from tests.classroom.grading.turning_task import SETS, TURN, turn, want

SINE = re.compile(r"sine = (\S+)")


@pytest.fixture(autouse=True)
def _a_task_with_a_question_and_a_step(monkeypatch):
    law = equals(
        "turned",
        2,
        "turns left",
        want,
        asks="Where does the point (1, 0) go?",
        step=lambda i: {"sine": np.sin(i["angle"]), "corner": np.eye(2)[None]},
    )
    other = equals("again", 1, "turns left", want)
    task = dataclasses.replace(
        TURN, laws=(law, other), call=dataclasses.replace(TURN.call, seconds=0.2)
    )
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    monkeypatch.setattr(hint_levels, "_shown_levels", {})
    monkeypatch.setattr(hint_levels, "_last_problems", {})


@pytest.fixture
def output_of(capsys):
    """What a hint prints with some function defined."""

    def output_of(function=None, id="99-turn"):
        names = {"hint": hint} | ({"turn": function} if function else {})
        assert eval(f"hint({id!r})", names) is None
        return capsys.readouterr().out

    return output_of


def right_turn(v, angle):
    return turn(v, -angle)


def test_a_question_comes_first_then_intermediate_results_then_the_mistake(output_of):
    first, second, third, fourth = (output_of(right_turn) for _ in range(4))
    assert first.startswith("A question: Where does the point (1, 0) go?\n")
    assert first.endswith("Call hint again to see a step on the way.\n")
    assert "Intermediate results of a correct solution for the case" in second
    assert SINE.search(second) and "corner = [[1, 0],\n" in second
    assert "turned right" not in first + second
    assert third.startswith("Hint: you turned right: check the sign of the sine\n")
    assert third.endswith("This is the last hint. check shows all other details.\n")
    assert fourth == third


def test_the_question_is_about_the_recognised_mistake(output_of, monkeypatch):
    task = fake.EXERCISE.tasks[0]
    known = dataclasses.replace(task.diagnoses[0], asks="Which way do you turn?")
    task = dataclasses.replace(task, diagnoses=(known,))
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    assert output_of(right_turn).startswith("A question: Which way do you turn?\n")


def test_a_check_shows_no_remedy_unless_the_course_file_asks_for_it(capsys, monkeypatch, tmp_path):
    (tmp_path / "notebooks").mkdir()
    (tmp_path / "exercises").mkdir()
    monkeypatch.chdir(tmp_path)
    printed = []
    for text in (None, "hints = 7", 'hints = "at once"', "hints = "):
        if text:
            (tmp_path / "course.toml").write_text(text)
        eval("check('99-turn')", {"check": check, "turn": right_turn})
        printed.append("you turned right" in capsys.readouterr().out)
    assert printed == [False, False, True, False]


def test_each_law_has_its_own_levels_of_hints(output_of, monkeypatch):
    def twice(v, angle):
        return 2 * turn(v, angle)

    output_of(twice)
    task = fake.EXERCISE.tasks[0]
    exercise = dataclasses.replace(
        fake.EXERCISE, tasks=(dataclasses.replace(task, laws=task.laws[1:], diagnoses=()),)
    )
    monkeypatch.setattr(fake, "EXERCISE", exercise)
    first, second = output_of(twice), output_of(twice)
    assert first.startswith("A question: Where is this broken: turns left?\n")
    assert second.startswith("Hint: Every wrong number is 2 times the right one.")


def test_a_question_that_is_the_only_hint_is_announced_as_such(output_of, monkeypatch):
    law = Law("turned", 2, "turns left", lambda i, o: False, asks="Which way is left? " * 9)
    task = dataclasses.replace(fake.EXERCISE.tasks[0], laws=(law,), diagnoses=())
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    first = output_of(right_turn)
    assert "This is the last hint" in first
    assert output_of(right_turn) == first
    assert max(map(len, first.splitlines())) <= 96


@pytest.mark.parametrize(
    ("function", "begins"),
    [
        (None, "turn is not defined"),
        (lambda v, angle: (_ for _ in ()).throw(NotImplementedError), "not attempted yet"),
        (lambda v, angle: 1 / 0, "ZeroDivisionError: division by zero"),
        (lambda v, angle: v * np.nan, "turn returned NaN or infinity"),
    ],
)
def test_an_answer_that_cannot_be_judged_gets_questions_to_begin(
    output_of, function, begins, monkeypatch
):
    task = dataclasses.replace(fake.EXERCISE.tasks[0], begins=("Which way?", "How far?"))
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    texts = [output_of(function) for _ in range(4)]
    asked = ["Which way?", "How far?", "Where does the point (1, 0) go?", "Which way?"]
    for k, (text, question) in enumerate(zip(texts, asked, strict=True)):
        assert (begins in text) == (k == 0), "the message is shown once"
        assert f"A question to begin with: {question}\n" in text
        assert "Call hint again for another question.\n" in text
        ends = "More hints follow once your functions return an answer that can be judged.\n"
        assert text.endswith(ends)
    right = "Your answer to 99-turn breaks no law, so there is no hint.\n"
    assert output_of(turn) == right


def test_a_degenerate_answer_that_obeys_all_laws_is_not_reported_as_right(output_of, monkeypatch):
    law = Law("turned", 2, "turns left", lambda i, o: True)
    task = dataclasses.replace(fake.EXERCISE.tasks[0], laws=(law,))
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    text = output_of(lambda v, angle: np.ones(2))
    assert text.startswith("A question: On which of the arguments does your answer depend")
    assert "no law" not in text


@pytest.mark.parametrize("id", ["99-nope", "98-double", "", 7, None])
def test_an_unknown_task_gets_one_clear_line(output_of, id):
    assert re.fullmatch(r"✗ no .*\n", output_of(id=id))


def test_under_nbgrader_nothing_is_given_away(output_of, monkeypatch):
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    assert output_of(right_turn) == ""


def hangs(v, angle):
    while angle == 0:
        pass
    return turn(v, angle)


def test_after_a_time_out_the_slow_inputs_are_named_and_questions_asked(output_of, monkeypatch):
    task = dataclasses.replace(fake.EXERCISE.tasks[0], begins=("Which way?", "How far?"))
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    for question in task.begins:
        text = output_of(hangs)
        assert text.startswith("still running after 0.2 s")
        assert "\nYour functions take longest with no angle: " in text
        assert f"\nA question to begin with: {question}\n" in text


def test_after_a_check_without_an_answer_a_hint_does_not_report_that_no_law_is_broken(output_of):
    names = {"check": check, "turn": hangs}
    eval("check('99-turn')", names)
    text = output_of(turn)
    assert "The last check: still running after 0.2 s" in text
    assert "call check again" in text and "A question to begin with" in text
    assert "no law" not in text
    eval("check('99-turn')", names | {"turn": turn})
    assert "breaks no law" in output_of(turn)


def test_a_case_that_takes_long_to_shrink_is_shown_as_it_is(output_of):
    runs, all_inputs = [], sum(len(inputs["v"]) for inputs in SETS.values())

    def tires(v, angle):
        runs.append(v)
        if len(runs) > all_inputs:  # what is called now has smaller numbers
            raise TimeLimitExceeded
        return right_turn(v, angle)

    assert output_of(tires).startswith("A question: Where does the point (1, 0) go?")
    assert len(runs) > all_inputs


def test_an_argument_that_was_changed_is_asked_for_whatever_is_printed(output_of):
    def changes(v, angle):
        print("here")
        v += 1.0
        return turn(v - 1, angle)

    assert output_of(changes).startswith("A question: Which line writes into an array")
    assert output_of(changes).startswith("Hint: Work on a copy of the argument")


def test_a_check_offers_what_hint_has_not_shown_yet(capsys):
    def offered(**names):
        eval("check('99-turn')", {"check": check} | names)
        return re.findall(r'hint\("99-turn"\) (.*)', capsys.readouterr().out)

    found = []
    for _ in range(4):
        found += [offered(turn=right_turn)]
        eval("hint('99-turn')", {"hint": hint, "turn": right_turn})
        capsys.readouterr()
    asks = "asks about a mistake that the check recognised."
    shows = ["shows a step on the way."], ["shows a sentence about your answer."]
    assert found == [[asks], *shows, []]
    assert offered(turn=lambda v, angle: 2 * turn(v, angle)) == ["asks about the first broken law."]
    assert offered() == ["asks a question to begin with."]
    names = {"check": check, "turn": turn, "hint": 7}
    eval("check('99-turn')", names)
    assert names["hint"] == 7, "one's own name is left alone"


def test_in_a_notebook_a_hint_is_there_before_the_first_check():
    message = shell("from classroom.checks import check", "hint('01-drift')")
    assert "A question to begin with" in message
    assert "mine" in shell("hint = lambda id: print('mine')", "import classroom.checks", "hint(1)")


def shell(*cells):
    """What a fresh IPython prints of some cells."""
    lines = ["from IPython.core.interactiveshell import InteractiveShell as S", "s = S.instance()"]
    lines += [f"s.run_cell({cell!r})" for cell in cells]
    done = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True)
    return done.stdout


@pytest.mark.parametrize(
    ("cells", "failed"),
    [
        (("hint()", "from classroom.checks import check, hint\ncheck()\nhint()"), []),
        (("from classroom.checks import hint\nhint('99-turn')",), []),
        (("from classroom.checks import ask, check", "hint('99-turn')\nx = y"), [3]),
    ],
    ids=["without an id", "with an id", "below an import"],
)
def test_a_call_stops_no_cell_in_a_worker(cells, failed):
    """In a notebook it reports its mistake and continues; it may be saved anywhere."""
    found = judged(fake.SOLUTION, *cells, exercise=fake.EXERCISE)["cells"]
    named = (
        "NameError: name 'y' is not defined (line 2 of the cell). No cell defines y. If you "
        "deleted its cell, copy it from a new copy of the exercise's notebook to the same place"
    )
    assert found == dict.fromkeys(failed, named)


def test_another_answer_starts_at_the_first_hint_after_the_last_one_was_shown(output_of):
    first, second, _ = (output_of(right_turn) for _ in range(3))
    assert output_of(lambda v, angle: 2 * turn(v, angle)) == first  # another mistake
    assert output_of(lambda v, angle: right_turn(v, angle) * (1 + 1e-12)) == first
    assert output_of(right_turn) == second  # the next level, for any answer with this mistake
