"""A check gives nothing for what grading does not hold: the package's own answers."""

import pytest

from slamlab.checks import check
from slamlab.checks.borrowed import borrowed
from slamlab.exercises import catalogue

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
    return borrowed(["f"], namespace, catalogue.exercise("08").answers)


@pytest.mark.parametrize("way", BORROWED)
def test_what_is_borrowed_is_found(way):
    assert "slamlab.landmarks" in asked(BORROWED[way])


@pytest.mark.parametrize("way", OWN)
def test_what_is_ones_own_is_not(way):
    assert asked(OWN[way]) is None


def test_a_borrowed_answer_earns_nothing_and_is_told_why(capsys):
    cell = 'from slamlab.geometry import compose as next_pose\ncheck("01-next-pose")'
    exec(cell, {"__name__": "__main__", "check": check})
    told = capsys.readouterr().out
    assert "0 of" in told
    assert "next_pose comes from slamlab.geometry" in told and "at grading it is not there" in told
