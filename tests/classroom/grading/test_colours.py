"""Marks are coloured where colours are shown, and nothing else is."""

import sys

import pytest

from classroom.checks import check
from classroom.exercises import verdict_text
from tests.classroom.grading import fake

TEXT = "✓ 99-double: 1 of 2 points\n  ✗ is twice as large [31m\n  ✓ keeps the sign"


def test_only_the_marks_are_coloured():
    seen = verdict_text.coloured(TEXT, True)
    assert seen.count("\x1b[32m✓\x1b[0m") == 2
    assert seen.count("\x1b[31m✗\x1b[0m") == 1
    assert seen.count("\x1b") == 6
    plain = seen
    for code in ("\x1b[32m", "\x1b[31m", "\x1b[0m"):
        plain = plain.replace(code, "")
    assert plain == TEXT == verdict_text.coloured(TEXT, False)


@pytest.mark.parametrize(
    ("terminal", "notebook", "no_color", "colours"),
    [
        (False, False, None, False),
        (True, False, None, True),
        (False, True, None, True),
        (True, True, "1", False),
        (True, False, "", True),  # as no-color.org has it
    ],
)
def test_colours_are_for_notebooks_and_terminals_that_want_them(
    terminal, notebook, no_color, colours, monkeypatch
):
    monkeypatch.setattr(sys.stdout, "isatty", lambda: terminal, raising=False)
    monkeypatch.setattr(verdict_text, "_in_notebook", lambda: notebook)
    monkeypatch.delenv("NO_COLOR", raising=False)
    if no_color is not None:
        monkeypatch.setenv("NO_COLOR", no_color)
    assert ("\x1b" in verdict_text.coloured(TEXT)) == colours


def test_check_prints_plain_text_into_a_pipe(capsys):
    names = {"check": check}
    exec(fake.SOLUTION + "check('99-double')", names)
    output = capsys.readouterr().out
    assert output.startswith("✓ 99-double")
    assert "\x1b" not in output
