"""A check awards no points for modules of the library that grading does not have."""

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
    "inside, from a package": """
def f(points):
    from slamlab import landmarks
    return landmarks.total_least_squares(points)
""",
    "by the module's name": """
import importlib
def f(points):
    return importlib.import_module("slamlab.landmarks.line_fitting").total_least_squares(points)
""",
    "as an attribute of the package": """
import slamlab.landmarks.line_fitting
def f(points):
    return slamlab.landmarks.line_fitting.total_least_squares(points)
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
    return find_forbidden_import(["f"], namespace, catalogue.exercise("08"))


@pytest.mark.parametrize("way", BORROWED)
def test_a_forbidden_import_is_found(way):
    found = asked(BORROWED[way])
    assert "slamlab.landmarks" in found and "which solves this exercise" in found


def test_a_module_that_the_worker_lacks_is_found_though_it_solves_nothing():
    found = asked(
        "from slamlab.posegraph.edge_error import error\ndef f(points):\n    return error"
    )
    assert found and found.endswith("which is unavailable during grading")


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
