"""A check awards no points for modules of the library that solve the exercise."""

import pytest

from classroom.checks import check
from classroom.checks.forbidden_imports import find_forbidden_import
from classroom.exercises import catalogue

BORROWED = {
    "under another name": "from slamlab.landmarks.line_fitting import total_least_squares as f",
    "inside": """
def f(points):
    from slamlab.landmarks.line_fitting import total_least_squares
    return total_least_squares(points)
""",
    "by a helper": """
from slamlab.landmarks import line_fitting
def helper(points):
    return line_fitting.total_least_squares(points)
def f(points):
    return helper(points)
""",
    "in a method": """
import slamlab.landmarks.line_fitting as line_fitting
class Fit:
    def of(self, points):
        return [line_fitting.total_least_squares(p) for p in points]
def f(points):
    return Fit().of(points)
""",
}
OWN = {
    "numpy": "import numpy as np\ndef f(points):\n    return np.mean(points, axis=0)",
    "what the exercise allows": """
from slamlab.geometry import wrap
def f(points):
    return wrap(points)
""",
    "the same name of one's own": """
def total_least_squares(points):
    return points
def f(points):
    return total_least_squares(points)
""",
}


def asked(source):
    """What is found in a notebook of exercise 08 whose function is f."""
    namespace = {"__name__": "__main__"}
    exec(source, namespace)
    return find_forbidden_import(["f"], namespace, catalogue.exercise("08").answers)


@pytest.mark.parametrize("way", BORROWED)
def test_a_forbidden_import_is_found(way):
    assert "slamlab.landmarks" in asked(BORROWED[way])


@pytest.mark.parametrize("way", OWN)
def test_own_code_is_not_a_forbidden_import(way):
    assert asked(OWN[way]) is None


def test_an_imported_answer_earns_nothing_and_the_reason_is_reported(capsys):
    cell = 'from slamlab.geometry import compose as next_pose\ncheck("01-next-pose")'
    exec(cell, {"__name__": "__main__", "check": check})
    output = capsys.readouterr().out
    assert "0 of" in output
    assert (
        "next_pose comes from slamlab.geometry" in output and "which solves this exercise" in output
    )
