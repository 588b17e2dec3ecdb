"""Commands without extras work without them; the others name the missing extra in one line."""

import subprocess
import sys
import textwrap

import pytest

from classroom.grading import nbgrader_gradebook
from classroom.grading.lti.keys import library
from slamlab.extras import ExtraMissing

ABSENT = ("sqlalchemy", "jinja2")
COMMANDS = (
    "grade {there} --out {there}/out",
    "grade init {there}",
    "grade release 04",
    "grade merge {there} --out {there}/out",
    "grade adjust ana 04-h-robot 1 --reason late",
    "grade rejudge",
    "grade verify",
    "grade forget ana",
    "grade review",
    "grade similarity",
    "grade lti key",
    "contest {there} --out {there}/out",
)


def without(code):
    """Output and errors of a fresh process without the packages of the extra ``grading``."""
    head = f"import sys; sys.modules |= dict.fromkeys({ABSENT!r})\n"
    words = [sys.executable, "-c", head + textwrap.dedent(code)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done


def test_a_student_checks_without_what_a_grader_has():
    without("import classroom.grading.judge, classroom.checks.validation")


def test_each_command_of_a_grader_states_in_one_line_what_to_install(tmp_path):
    commands = [command.format(there=tmp_path).split() for command in COMMANDS]
    done = without(f"""
        from slamlab.cli import main
        for command in {commands!r}:
            assert main(command) == 2, command
        """)
    for command, message in zip(COMMANDS, done.stderr.splitlines(), strict=True):
        assert message.startswith(f"slamlab {command.split()[0]}")
        assert message.endswith(' is not installed: pip install "slam-course[grading]"')


@pytest.mark.parametrize(
    ("module", "act", "extra"),
    [
        ("authlib", library, "lti"),
        ("nbgrader", lambda: nbgrader_gradebook.export([], "sqlite://"), "nbgrader"),
    ],
)
def test_a_missing_library_is_named_with_its_extra(module, act, extra, monkeypatch):
    names = [name for name in sys.modules if name.split(".")[0] == module]
    for name in (module, *names):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ExtraMissing, match=rf'pip install "slam-course\[{extra}\]"'):
        act()
