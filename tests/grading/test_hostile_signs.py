"""Hostile signs: most attacks show some, and no honest notebook does."""

import pytest

from course.source import ROOT
from slamlab.exercises.verdict import Verdict
from slamlab.grading import hostile_signs, notebooks
from slamlab.grading.records import Record
from tests.grading import attacks

HONEST = sorted((ROOT / "solutions").glob("*.ipynb")) + sorted((ROOT / "exercises").glob("*.ipynb"))
ANSWERS = sorted((ROOT / "tests/answers").glob("ex*/*.py"))


@pytest.mark.parametrize("path", HONEST, ids=lambda path: f"{path.parent.name}-{path.stem[:4]}")
def test_an_honest_notebook_has_no_sign(path):
    assert hostile_signs.signs(notebooks.parse(path.read_bytes()).cells) == ()


@pytest.mark.parametrize("path", ANSWERS, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_an_answer_written_from_the_lessons_has_no_sign(path):
    assert hostile_signs.signs([(1, path.read_text("utf-8"))]) == ()


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
"""Attacks without a sign: each is what an honest one does who errs, prints or looks for a fault."""


@pytest.mark.parametrize("kind", ["FORGERIES", "SPIES", "HARMS"])
def test_every_attack_that_no_honest_one_writes_has_a_sign(kind):
    cells = getattr(attacks, kind)
    missed = {name for name, cell in cells.items() if not hostile_signs.signs([*GIVEN, (3, cell)])}
    assert missed == HARMLESS & set(cells)


@pytest.mark.parametrize(
    "source",
    [
        "np.clip(x, -1e9, 1e9)",
        "best = np.inf",
        "1e-300 + x**2",
        "'-' * 60",
        "class Pose: pass",
        "try:\n    x = 1\nexcept ValueError:\n    x = 2",
        "P.flat[0] = 1; robot.x = 3",
        "10**6",
    ],
)
def test_what_honest_ones_write_has_no_sign(source):
    assert hostile_signs.signs([*GIVEN, (3, source)]) == ()


def test_a_sign_names_its_cell():
    cells = [(1, "import numpy as np"), (3, "import os\nnp.isclose = print\n\nos.kill(1, 9)")]
    assert hostile_signs.signs(cells) == ("cell 3: imports os", "cell 3: changes np.isclose")


@pytest.mark.parametrize(
    "source",
    ["(" * 5000, "\0", "def f(:\n  os", "x = " + "-" * 60_000 + "1", "\ud800", "a" * 200_000],
)
def test_no_source_is_too_odd_to_be_looked_at(source):
    assert isinstance(hostile_signs.signs([(1, source)]), tuple)


def test_signs_are_bounded():
    many = [(n, "import os, gc, socket, ctypes") for n in range(1000)]
    assert len(hostile_signs.signs(many)) == hostile_signs.MOST


def test_who_ends_the_process_or_is_refused_is_told():
    died = Record(
        "a", "a", "99", verdicts=(Verdict("99-double", 0, 3, kind="died"),),
        cells={2: "PermissionError: [Errno 1] Operation not permitted", 3: "ValueError: x"},
    )  # fmt: skip
    assert hostile_signs.behaviour(died) == [
        "99-double: ended its process", "cell 2: was refused by the system",
    ]  # fmt: skip
