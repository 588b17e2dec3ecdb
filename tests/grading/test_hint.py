"""Hints lead on by one rung a call: a question, then a step; and they end at any function."""

import dataclasses
import re
import subprocess
import sys

import numpy as np
import pytest

from slamlab.checks import check, hint, ladder
from slamlab.exercises.law import Law, equals
from slamlab.exercises.time_limit import TimeLimitExceeded
from tests.grading import fake
from tests.grading.test_cases import SETS, TURN, turn, want
from tests.grading.test_judge import judged

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
        TURN, laws=(law, other), drive=dataclasses.replace(TURN.drive, seconds=0.2)
    )
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    monkeypatch.setattr(ladder, "_climbed", {})


@pytest.fixture
def said(capsys):
    """What a hint prints with some function defined."""

    def said(function=None, id="99-turn"):
        names = {"hint": hint} | ({"turn": function} if function else {})
        assert eval(f"hint({id!r})", names) is None
        return capsys.readouterr().out

    return said


def right_turn(v, angle):
    return turn(v, -angle)


def test_a_question_comes_first_and_then_a_step_at_the_case_that_is_shown(said):
    first, second, third = (said(right_turn) for _ in range(3))
    assert first.startswith("A question: Where does the point (1, 0) go?\n")
    assert "hint shows a step" in first
    assert "and should return" not in first
    assert "On the way a right solution finds" in second
    angle = float(re.search(r"angle = (\S+)", second)[1])
    assert float(SINE.search(second)[1]) == pytest.approx(np.sin(angle), abs=1e-4)
    assert "corner = [[1, 0],\n" in second
    assert third.startswith("A question: Where does the point (1, 0) go?\n")
    assert "On the way a right solution finds" in third
    assert "it returns" not in third
    assert "last hint" not in first
    assert second.endswith("That was the last hint on this law.\n")


def test_each_law_has_a_ladder_of_its_own(said, monkeypatch):
    said(right_turn)
    task = fake.EXERCISE.tasks[0]
    exercise = dataclasses.replace(
        fake.EXERCISE, tasks=(dataclasses.replace(task, laws=task.laws[1:]),)
    )
    monkeypatch.setattr(fake, "EXERCISE", exercise)
    first, second = said(right_turn), said(right_turn)
    question = "A question: Where does your answer leave this law: turns left?\n"
    assert first == question + "Called again, hint shows the case that fails.\n"
    assert "it returns" in second
    assert "On the way" not in second
    assert second.endswith("That was the last hint on this law.\n")


def test_where_a_question_is_all_there_is_it_says_so(said, monkeypatch):
    law = Law("turned", 2, "turns left", lambda i, o: False, asks="Which way is left? " * 9)
    task = dataclasses.replace(fake.EXERCISE.tasks[0], laws=(law,))
    monkeypatch.setattr(fake, "EXERCISE", dataclasses.replace(fake.EXERCISE, tasks=(task,)))
    first = said(right_turn)
    assert "That is the only hint on this law" in first
    assert said(right_turn) == first
    assert max(map(len, first.splitlines())) <= 96


def test_of_a_right_answer_there_is_nothing_to_hint_at(said):
    assert said(turn) == "99-turn breaks no law: there is nothing to hint at\n"


@pytest.mark.parametrize(
    ("function", "begins"),
    [
        (None, "turn is not defined"),
        (lambda v, angle: (_ for _ in ()).throw(NotImplementedError), "not attempted yet"),
        (lambda v, angle: 1 / 0, "ZeroDivisionError: division by zero"),
    ],
)
def test_what_cannot_be_judged_yet_is_led_to_its_first_question(said, function, begins):
    text = said(function)
    assert text.startswith(begins)
    assert "\nA question to begin with: Where does the point (1, 0) go?\n" in text
    assert text.endswith("Hints go on once there is an answer to judge.\n")


@pytest.mark.parametrize("id", ["99-nope", "98-double", "", 7, None])
def test_a_task_there_is_not_gets_one_clear_line(said, id):
    assert re.fullmatch(r"✗ no .*\n", said(id=id))


def test_under_nbgrader_and_in_a_worker_nothing_is_given_away(said, monkeypatch):
    cells = fake.SOLUTION, "from slamlab.checks import hint\nhint('99-turn')"
    assert judged(*cells, exercise=fake.EXERCISE)["cells"] == {}
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    assert said(right_turn) == ""


def test_a_function_that_hangs_ends(said):
    def hangs(v, angle):
        while True:
            pass

    assert said(hangs).startswith("still running after 0.2 s")


def test_a_case_that_takes_long_to_shrink_is_shown_as_it_is(said):
    runs, all_inputs = [], sum(len(inputs["v"]) for inputs in SETS.values())

    def tires(v, angle):
        runs.append(v)
        if len(runs) > all_inputs:  # what is called now has smaller numbers
            raise TimeLimitExceeded
        return right_turn(v, angle)

    assert said(tires).startswith("A question: Where does the point (1, 0) go?")
    assert len(runs) > all_inputs


def test_what_a_function_prints_does_not_hide_the_hint(said):
    def talks(v, angle):
        print("here")
        return right_turn(v, angle)

    assert said(talks).startswith("A question")


def test_an_argument_that_was_changed_is_asked_for(said):
    def changes(v, angle):
        v += 1.0
        return turn(v - 1, angle)

    assert "Which line writes into an array" in said(changes)
    assert "turn changes v: work on a copy" in said(changes)


def test_a_check_that_offers_a_hint_brings_it_along(capsys):
    names = {"check": check, "turn": right_turn}
    eval("check('99-turn')", names)
    assert 'hint("99-turn")' in capsys.readouterr().out
    eval("hint('99-turn')", names)
    assert "A question: Where does the point (1, 0) go?" in capsys.readouterr().out


def test_a_check_offers_what_hint_has_not_said_yet(capsys):
    offered = []
    for _ in range(3):
        eval("check('99-turn')", {"check": check, "turn": right_turn})
        offered.append(re.findall(r'hint\("99-turn"\) (.*)', capsys.readouterr().out))
        eval("hint('99-turn')", {"hint": hint, "turn": right_turn})
        capsys.readouterr()
    assert offered == [["asks a question that leads on."], ["shows a step on the way."], []]


def test_in_a_notebook_a_hint_is_there_before_the_first_check():
    said = shell("from slamlab.checks import check", "hint('01-drift')")
    assert "A question to begin with" in said
    assert "mine" in shell("hint = lambda id: print('mine')", "import slamlab.checks", "hint(1)")


def shell(*cells):
    """What a fresh IPython prints of some cells."""
    lines = ["from IPython.core.interactiveshell import InteractiveShell as S", "s = S.instance()"]
    lines += [f"s.run_cell({cell!r})" for cell in cells]
    done = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True)
    return done.stdout


def test_a_hint_of_ones_own_is_left_alone():
    names = {"check": check, "turn": turn, "hint": 7}
    eval("check('99-turn')", names)
    assert names["hint"] == 7


def test_calls_without_an_id_stop_no_cell_in_a_worker():
    """In a notebook they say so, and go on."""
    cells = fake.SOLUTION, "hint()", "from slamlab.checks import check, hint\ncheck()\nhint()"
    assert judged(*cells, exercise=fake.EXERCISE)["cells"] == {}


def test_a_call_below_the_import_stops_no_cell_in_a_worker():
    """It needs no check before it there either: a notebook may be saved with it anywhere."""
    cells = fake.SOLUTION, "from slamlab.checks import ask, check", "hint('99-turn')\nx = y"
    assert judged(*cells, exercise=fake.EXERCISE)["cells"] == {
        3: "NameError: name 'y' is not defined (line 2 of the cell)"
    }


def test_another_answer_climbs_from_the_beginning_once_the_ladder_was_at_its_end(said):
    first, second, third = (said(right_turn) for _ in range(3))
    assert third.startswith("A question:") and "That was the last hint" in third
    assert said(lambda v, angle: 2 * turn(v, angle)) == first
    assert "On the way" in said(right_turn)  # not at its end: the next rung, whoever asks
    assert said(right_turn) == third
    assert said(lambda v, angle: 3 * turn(v, angle)) == first != second
