"""In every lesson the reader types a few lines; the answer that unfolds below is correct."""

import copy
import re
from itertools import compress, pairwise

import pytest

from course.derive import derive
from course.execute import execute
from course.source import ROOT
from tests.course.notebooks import LESSONS, lesson, name

TAG = "your-turn"
FEWEST = 5
ANSWER = re.compile(
    r"<details><summary>Answer</summary>\n\n```python\n(.*?)\n```\n.*</details>", re.DOTALL
)
each_lesson = pytest.mark.parametrize("path", LESSONS[1:], ids=name)  # 00 only introduces them


def turns(cells):
    """The cells to complete, each with the cell that follows."""
    tagged = (TAG in cell.metadata.get("tags", []) for cell in cells)
    return list(compress(pairwise(cells), tagged))


def completed(code, answer):
    """A cell with its lines before ``compare`` replaced by the answer."""
    return f"{answer}\n{code[code.index('compare(') :]}"


@each_lesson
def test_the_reader_types_and_finds_the_answer_below(path):
    found = turns(lesson(path).cells)
    assert len(found) >= FEWEST
    for cell, after in found:
        before, _, last = cell.source.rpartition("\n")
        assert "..." in before and last.startswith("compare("), cell.id
        assert ANSWER.search(after.source), f"{cell.id}: no answer in the cell below"


@pytest.mark.slow
@each_lesson
def test_every_answer_is_correct_in_its_lesson(path):
    notebook = copy.deepcopy(derive(path)[0].notebook)
    found = turns(notebook.cells)
    for cell, after in found:
        cell.source = completed(cell.source, ANSWER.search(after.source)[1])
    ids = {cell.id for cell, _ in found}
    ran = execute(notebook, ROOT / "notebooks")
    printed = {cell.id: cell.outputs[0]["text"] for cell in ran.cells if cell.id in ids}
    assert set(printed.values()) == {"✓ Correct.\n"}, printed
