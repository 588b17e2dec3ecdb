"""Suspicious code: most attacks contain some, and no ordinary notebook does."""

import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading import notebooks, suspicious_code
from classroom.grading.records import Record
from course.source import ROOT
from tests.classroom.grading import attacks

ORDINARY = [*(ROOT / "solutions").glob("*.ipynb"), *(ROOT / "exercises").glob("*.ipynb")]
ANSWERS = list((ROOT / "course/exercises").glob("*/*/answers.py"))


def test_no_notebook_without_an_attack_and_no_answer_has_a_sign():
    cells = {path: notebooks.parse(path.read_bytes()).cells for path in ORDINARY}
    cells |= {path: [(1, path.read_text("utf-8"))] for path in ANSWERS}
    assert len(cells) > 60
    assert {path: found for path in cells if (found := suspicious_code.signs(cells[path]))} == {}


GIVEN = [(1, "import numpy as np"), (2, attacks.WRONG)]
HARMLESS = {
    "not a number for an answer",
    "infinity for an answer",
    "assertions switched off",
    "points printed",
    "everything raises",
    "one number that looks like a billion",
    "numbers that are none",
    "masks and matrices",
    "dates and objects",
    "half a letter",
    "a text with a zero in it",
    "a list in itself",
    "other numbers everywhere",
}
"""Attacks without a sign: ordinary students do the same by mistake, by printing or debugging."""


@pytest.mark.parametrize("kind", ["FORGERIES", "SPIES", "HARMS"])
def test_every_attack_that_no_ordinary_notebook_contains_has_a_sign(kind):
    cells = getattr(attacks, kind)
    missed = {
        name for name, cell in cells.items() if not suspicious_code.signs([*GIVEN, (3, cell)])
    }
    assert missed == HARMLESS & set(cells)


def test_code_of_ordinary_notebooks_has_no_sign():
    for source in (
        "np.clip(x, -1e9, 1e9)", "best = np.inf", "1e-300 + x**2", "'-' * 60", "class Pose: pass",
        "try:\n    x = 1\nexcept ValueError:\n    x = 2", "P.flat[0] = 1; robot.x = 3", "10**6",
    ):  # fmt: skip
        assert suspicious_code.signs([*GIVEN, (3, source)]) == (), source


def test_a_sign_names_its_cell():
    cells = [(1, "import numpy as np"), (3, "import os\nnp.isclose = print\n\nos.kill(1, 9)")]
    assert suspicious_code.signs(cells) == ("cell 3: imports os", "cell 3: changes np.isclose")


def test_any_source_can_be_analysed_and_signs_are_bounded():
    minus = "x = " + "-" * 60_000 + "1"
    for source in ("(" * 5000, "\0", "def f(:\n  os", minus, "\ud800", "a" * 200_000):
        assert isinstance(suspicious_code.signs([(1, source)]), tuple)
    many = [(n, "import os, gc, socket, ctypes") for n in range(1000)]
    assert len(suspicious_code.signs(many)) == suspicious_code.MAX_SIGNS


def test_an_answer_that_ends_the_process_or_is_refused_is_reported():
    died = Record(
        "a", "a", "99", verdicts=(Verdict("99-double", 0, 3, kind="died"),),
        cells={2: "PermissionError: [Errno 1] Operation not permitted", 3: "ValueError: x"},
    )  # fmt: skip
    assert suspicious_code.suspicious_behaviour(died) == [
        "99-double: ended its process", "cell 2: the system refused an action",
    ]  # fmt: skip
