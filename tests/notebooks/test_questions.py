"""Questions of the lessons: kept apart, so that no notebook's code tells an answer."""

import nbformat
import pytest

from course import asking
from course.source import ROOT, read, sources
from slamlab.checks import ask
from slamlab.checks.stored_questions import stored_question

LESSONS = [path for path in sources() if path.parent.name == "lessons"]
NUMBER = """first()
ask(
    "04-far", "How far?", right=2.5, tolerance=0.1,
    unit="m", wrong={5.0: "that is the way there and back."},
)
last()"""


def test_a_notebook_asks_by_the_id_alone():
    assert asking.short(NUMBER) == 'first()\nask("04-far", unit="m")\nlast()'
    assert asking.short("x = 1") == "x = 1"


def test_what_is_computed_cannot_be_stored():
    assert asking.asks('ask("04-a", "?", right=len(x), tolerance=1)')
    with pytest.raises(ValueError):
        asking.asked('ask("04-a", "?", right=len(x), tolerance=1)')


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_what_a_lesson_asks_in_full_is_what_its_notebook_asks(path):
    source = read(path)
    found = [asking.asked(cell.text) for cell in source.cells if cell.type == "code"]
    for told in filter(None, found):
        assert stored_question(told.pop("id")) == told
    notebook = nbformat.read(ROOT / "notebooks" / source.file, as_version=4)
    asked = [cell.source for cell in notebook.cells if asking.asks(cell.source)]
    assert len(asked) == len(list(filter(None, found)))
    assert all(set(asking.asked(code)) <= {"id", "unit"} for code in asked)


def test_an_unknown_question_says_so():
    for id in ("04-nobody-asks", "99-x", "../../secret-1"):
        with pytest.raises(ValueError, match="no question"):
            ask(id)
