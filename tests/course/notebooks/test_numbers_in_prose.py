"""A number that a cell prints is computed in the prose, too, so that it cannot become wrong."""

import re

import pytest

from course.computed_values import MARK
from course.source import read
from tests.course.notebooks import LESSONS, code_cells, lesson, name, texts

TYPED = {  # numbers that do not come from the cells that print them as well
    "04_models_and_jacobians": {"1.96"},  # a quantile
    "10_set_membership_slam": {"0.878"},  # calculated by hand, as in the next
    "11_particle_filters": {"2.24"},
    "15_pose_graph_slam": {"0.196", "40.56", "45.00"},  # of ROS and of GTSAM
    "16_your_own_slam": {"2.25"},  # of a question
}
NUMBER = re.compile(r"(?<![\d.])\d+\.\d+(?![\d.])")
NAMED = re.compile(r"`[^`]*`|\]\([^)]*\)|(\(|tag{)\d\d\.\d+")  # code, links, numbers of equations


def numbers(text):
    """The decimal numbers of at least three digits."""
    found = NUMBER.findall(NAMED.sub("", text))
    return {each for each in found if len(each.replace(".", "").lstrip("0")) > 2}


@pytest.mark.parametrize("path", LESSONS, ids=name)
def test_no_number_is_typed_that_a_cell_prints(path):
    cells = code_cells(lesson(path))
    printed = [text for cell in cells for output in cell.outputs for text in texts(output)]
    given = numbers("\n".join(cell.source for cell in cells))
    prose = [MARK.sub("", cell.text) for cell in read(path).cells if cell.type == "markdown"]
    typed = numbers("\n".join(prose)) & numbers("\n".join(printed)) - given
    assert typed <= TYPED.get(path.stem, set())
