"""What a student sees who checks in a notebook: one clear verdict, never a traceback."""

import contextlib
import io
import re
import threading

import numpy as np
import pytest

from slamlab.checks import WARNINGS, attempt, check
from slamlab.exercises.drives import StudentError, shaped, wrong_shape
from tests.grading import fake


def checked(code, *ids, base=fake.SOLUTION):
    """What checks print, and their values, after some code ran in a notebook."""
    names = {"check": check, "attempt": attempt}
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(base + code, "<cell 1>", "exec"), names)
        values = [eval(f"check({id!r})", names) for id in ids or ("99-double",)]
    return printed.getvalue(), values


def double(body):
    return f"\ndef double(a):\n    {body}\n"


def test_a_right_function_earns_its_points_and_the_laws_are_said():
    said, values = checked("")
    assert "✓ 99-double · Double a number: 3.5 of 3.5 points" in said
    assert "✓ is twice as large (2 points)" in said
    assert values == [None]


def test_a_wrong_one_is_told_which_law_broke_how_often_and_the_hint_for_its_mistake():
    said, _ = checked(double("return a * a"))
    assert "1.5 of 3.5 points" in said
    assert "✗ is twice as large: broken by 20 of 20 inputs (0 of 2 points)" in said
    assert "Hint: you squared" in said


@pytest.mark.parametrize(
    ("code", "said"),
    [
        (double("raise NotImplementedError"), "not attempted yet"),
        (double("return 1 / 0"), "division by zero (line 15 of the cell, in double)"),
        (double("return double(a)"), "RecursionError"),
        (double("raise SystemExit(0)"), "SystemExit: 0"),
        (double("raise KeyboardInterrupt"), "stopped before it was done"),
        (double("raise type('Odd', (BaseException,), {})"), "Odd: no message"),
        (double("raise type('Odd', (Exception,), {'__str__': None})"), "Odd: no message"),
        (double("pass"), "double returned None, where numbers are wanted: does every way"),
        (double("return str(a)"), "double returned str, which is no array of real numbers"),
        (double("return 2j * a"), "double returned complex numbers"),
        (double("return [[1], [1, 2]]"), "double returned list, which is no array"),
        (double("b = []; b.extend([b, b]); return b"), "returned a list that contains itself"),
        (double("return [a, a]"), "double returned shape (2,), expected () (one number)"),
        (double("return [a] * int(a * 10)"), "double returned arrays of different shapes"),
        (double("return np.zeros(10**7)"), "10000000 numbers: at most 500000 are allowed"),
        (double("return a / 0 if a < 0 else np.inf"), "double returned NaN or infinity"),
        (double("return a") + "del double\n", "double is not defined yet: run the cell above"),
        (
            double("return a") + "doubel = double\ndel double\n",
            "double is not defined yet: run the cell above; there is doubel: is it meant?",
        ),
        (
            "class NoInput(NotImplementedError): pass\n" + double("raise NoInput('no input here')"),
            "NoInput: no input here",
        ),
        ("\ndouble = 2\n", "double is of type int, not a function"),
    ],
)  # fmt: skip
def test_what_cannot_be_judged_is_explained_in_a_line(code, said):
    printed, _ = checked(code)
    assert "0 of 3.5 points" in printed
    assert said in printed
    assert "Traceback" not in printed


@pytest.mark.slow
def test_a_loop_without_end_is_stopped_even_where_it_swallows_exceptions():
    swallow = (
        "\ndef double(a):\n    while True:\n        try:\n            sum(range(1000))\n        "
    )
    for handler in ("except Exception:", "except ZeroDivisionError:"):
        printed, _ = checked(swallow + f"{handler}\n            pass\n")
        assert "still running after 3 s" in printed


def test_what_was_judged_in_time_keeps_its_points_however_long_it_takes_to_explain():
    printed, _ = checked(double("import time; time.sleep(0.14); return a * a"))
    assert "1.5 of 3.5 points" in printed
    assert "Hint: you squared" in printed


def test_where_no_time_limit_can_be_set_it_says_so():
    said = []
    thread = threading.Thread(target=lambda: said.append(checked("")[0]))
    thread.start()
    thread.join()
    assert said[0].startswith("no time limit can be set here")
    assert "3.5 of 3.5 points" in said[0]


def test_a_task_that_needs_another_waits_for_it():
    printed, _ = checked(double("return a"), "99-total")
    assert "needs 99-double, solved and run first" in printed
    assert "0 of 2 points" in printed
    assert "2 of 2 points" in checked("", "99-total")[0]


@pytest.mark.parametrize("id", ["99-nope", "98-double", "", 7, None, "../99"])
def test_a_task_there_is_not_gets_one_clear_line(id):
    printed, _ = checked("", id)
    assert printed.startswith("✗ no ")
    assert printed.count("\n") == 1


def test_what_functions_print_is_shown_once_and_not_without_end():
    printed, _ = checked(double("print('so' * 50, flush=True); return 2 * a"))
    assert printed.startswith("your code printed:\nsoso")
    assert "characters more" in printed
    assert len(printed) < 1000


def test_what_python_warns_of_is_not_said_to_be_printed():
    many = "[np.array(1) / 0, np.log(0 * a), np.sqrt(-a), np.array(0) / 0]; "
    printed, _ = checked(double(f"print('so'); {many}return 2 * a"))
    assert re.match(r"your code printed:\nso\n(so\n)*", printed)
    assert (
        "\nPython warned: RuntimeWarning: divide by zero encountered in divide (line 15 of"
        in printed
    )
    assert printed.count("Python warned") == WARNINGS
    assert "\n… and of 1 more\n" in printed
    assert "RuntimeWarning" not in checked("", "99-double")[0]


@pytest.mark.parametrize(
    ("what", "said"),
    [
        ("close_loops", "close_loops returned shape (24, 2), expected (24, 3)"),
        ("corner's P", "corner's P has shape (24, 2), expected (24, 3)"),
        (
            "what relocalise returned",
            "what relocalise returned has shape (24, 2), expected (24, 3)",
        ),
    ],
)
def test_a_wrong_shape_is_told_in_one_way(what, said):
    assert wrong_shape(what, (24, 2), (24, 3)) == said
    with pytest.raises(StudentError, match=re.escape(said)):
        shaped(np.zeros((24, 2)), what, (24, 3))


def test_under_nbgrader_the_points_are_the_value_of_the_cell(monkeypatch):
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    wrong = double("return a * a")
    _, values = checked(wrong, "99-double", "99-total", "99-turn", "99-nope")
    assert values == [1.5, 0.0, 2.5, 0.0]
    assert all(type(value) is float for value in values)


def test_nothing_reaches_standard_error_which_nbgrader_takes_for_a_failure(monkeypatch, capsys):
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    _, values = checked("import sys" + double("print('careful', file=sys.stderr); return 2 * a"))
    assert values == [3.5]
    assert capsys.readouterr().err == ""


def test_attempt_gives_the_value_or_says_why_there_is_none(capsys):
    assert attempt(lambda: 3) == 3
    assert capsys.readouterr().out == ""

    @attempt
    def value():
        raise NotImplementedError

    assert value is None
    assert capsys.readouterr().out == "not attempted yet\n"
    for fails in (lambda: 1 / 0, lambda: not_there, lambda: exit(1)):  # noqa: F821
        assert attempt(fails) is None
        assert capsys.readouterr().out.startswith("this cell could not go on: ")
