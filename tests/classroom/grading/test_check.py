"""What a student sees who checks in a notebook: one clear verdict, never a traceback."""

import contextlib
import io
import re
import threading

import numpy as np
import pytest

from classroom.checks import attempt, check
from classroom.checks.timed_runs import WARNINGS
from classroom.exercises.function_calls import StudentError, to_shaped_array, wrong_shape_message
from tests.classroom.grading import fake


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


def test_a_right_function_earns_its_points_and_the_laws_are_reported():
    message, values = checked("")
    assert "✓ 99-double · Double a number: 3.5 of 3.5 points" in message
    assert "✓ is twice as large (2 points)" in message
    assert values == [None]


@pytest.mark.parametrize("seconds", [0, 0.14])  # the answer is in time, its explanation is not
def test_a_wrong_answer_gets_the_broken_law_and_its_count_and_no_remedy(seconds):
    message, _ = checked(double(f"import time; time.sleep({seconds}); return a * a"))
    assert "1.5 of 3.5 points" in message
    assert "✗ is twice as large: broken by 20 of 20 inputs (0 of 2 points)" in message
    assert 'hint("99-double") asks about a mistake that the check recognised.' in message
    assert "you squared" not in message


@pytest.mark.parametrize(
    ("code", "message"),
    [
        (double("raise NotImplementedError"), "not attempted yet"),
        (double("return 1 / 0"), "division by zero (line 15 of the cell, in double)"),
        (double("return double(a)"), "RecursionError"),
        (double("raise KeyboardInterrupt"), "stopped before the check was finished"),
        (double("raise type('Odd', (BaseException,), {})"), "Odd: no message"),
        (double("pass"), "double returned None, but must return numbers. Does every branch"),
        (double("return str(a)"), "double returned str, which is not an array of real numbers"),
        (double("return 2j * a"), "double returned complex numbers"),
        (double("return [[1], [1, 2]]"), "double returned list, which is not an array"),
        (double("b = []; b.extend([b, b]); return b"), "returned a list that contains itself"),
        (double("return [a, a]"), "double returned shape (2,), expected () (one number)"),
        (double("return [a] * int(a * 10)"), "double returned arrays of different shapes"),
        (double("return np.zeros(10**7)"), "10000000 numbers: at most 500000 are allowed"),
        (double("return a / 0 if a < 0 else np.inf"), "double returned NaN or infinity"),
        (double("return a") + "del double\n", "double is not defined yet: run the cell above"),
        (
            double("return a") + "doubel = double\ndel double\n",
            "double is not defined yet: run the cell above, or did you mean doubel?",
        ),
        (
            "class NoInput(NotImplementedError): pass\n" + double("raise NoInput('no input here')"),
            "NoInput: no input here",
        ),
        ("\ndouble = 2\n", "double is of type int, not a function"),
    ],
)  # fmt: skip
def test_what_cannot_be_judged_is_explained_in_a_line(code, message):
    printed, _ = checked(code)
    assert "0 of 3.5 points" in printed
    assert message in printed
    assert "Traceback" not in printed


@pytest.mark.slow
def test_a_loop_without_end_is_stopped_even_where_it_swallows_exceptions():
    swallow = "try:\n            sum(range(1000))\n        except Exception:\n            pass"
    assert "still running after 3 s" in checked(double(f"while True:\n        {swallow}"))[0]


def test_where_no_time_limit_can_be_set_it_reports_it():
    messages = []
    thread = threading.Thread(target=lambda: messages.append(checked("")[0]))
    thread.start()
    thread.join()
    assert messages[0].startswith("No time limit can be set here")
    assert "3.5 of 3.5 points" in messages[0]


def test_a_task_that_needs_a_wrong_function_is_checked_with_a_right_one_that_does_not_stay():
    keeps = "\nkept = []\ndef total(a):\n    kept.append(double)\n    return double(a.sum())"
    names = {"check": check}
    exec(compile(fake.SOLUTION + double("return a") + keeps, "<cell 1>", "exec"), names)
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        eval("check('99-total')", names)
    assert "tried with a correct double() in place of yours" in printed.getvalue()
    assert "2 of 2 points" in printed.getvalue()
    assert names["double"](1.0) == 1.0
    exec("def total(a):\n    raise NotImplementedError", names)
    with contextlib.redirect_stdout(io.StringIO()) as blank:
        eval("check('99-total')", names)
    assert "not attempted yet" in blank.getvalue() and "tried with" not in blank.getvalue()
    with pytest.raises(RuntimeError, match="only while a task is judged"):
        names["kept"][0](1.0)
    assert "in place of" not in checked("", "99-total")[0]


def test_an_unknown_task_gets_one_clear_line():
    for id in ("99-nope", "98-double", "", 7, None, "../99"):
        printed, _ = checked("", id)
        assert printed.startswith("✗ no ")
        assert printed.count("\n") == 1


def test_output_of_functions_is_shown_once_and_truncated():
    printed, _ = checked(double("print('so' * 50, flush=True); return 2 * a"))
    assert printed.startswith("Your code printed:\nsoso")
    assert "more characters" in printed
    assert len(printed) < 1000


def test_what_python_warns_of_is_not_reported_as_printed():
    many = "[np.array(1) / 0, np.log(0 * a), np.sqrt(-a), np.array(0) / 0]; "
    printed, _ = checked(double(f"print('so'); {many}return 2 * a"))
    assert re.match(r"Your code printed:\nso\n(so\n)*", printed)
    warning = "RuntimeWarning: divide by zero encountered in divide (line 15 of"
    assert f"\nPython warned: {warning}" in printed
    assert printed.count("Python warned") == WARNINGS
    assert "\n… and 1 more\n" in printed
    assert "RuntimeWarning" not in checked("", "99-double")[0]


def test_a_wrong_shape_is_reported_in_one_form():
    for what, verb in {
        "close_loops": "returned shape",
        "corner's P": "has shape",
        "what relocalise returned": "has shape",
    }.items():
        message = f"{what} {verb} (24, 2), expected (24, 3)"
        assert wrong_shape_message(what, (24, 2), (24, 3)) == message
        with pytest.raises(StudentError, match=re.escape(message)):
            to_shaped_array(np.zeros((24, 2)), what, (24, 3))


def test_under_nbgrader_the_points_are_the_value_of_the_cell(monkeypatch, capsys):
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    wrong = double("return a * a")
    _, values = checked(wrong, "99-double", "99-total", "99-turn", "99-nope")
    assert values == [1.5, 2.0, 2.5, 0.0]
    assert all(type(value) is float for value in values)
    loud = "import sys" + double("print('careful', file=sys.stderr); return 2 * a")
    assert checked(loud)[1] == [3.5]
    assert capsys.readouterr().err == "", "nbgrader would take it for a failure"


def test_attempt_gives_the_value_or_explains_why_there_is_none(capsys):
    assert attempt(lambda: 3) == 3
    assert capsys.readouterr().out == ""

    @attempt
    def value():
        raise NotImplementedError

    assert value is None
    assert capsys.readouterr().out == "not attempted yet\n"
    for fails in (lambda: 1 / 0, lambda: not_there, lambda: exit(1)):  # noqa: F821
        assert attempt(fails) is None
        assert capsys.readouterr().out.startswith("This cell stopped: ")
