"""A class whose results are reviewed; the fake exercise is known."""

import pytest

from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.records import Record
from classroom.grading.term import term
from classroom.reviewing.class_state import ClassState
from tests.classroom.grading.conftest import know_the_fake
from tests.classroom.reviewing.reviewed_class import COURSE, HOSTILE, LATER, ROSTER, attempt

_know = pytest.fixture(autouse=True)(know_the_fake)


@pytest.fixture
def state(tmp_path):
    """A class of four: late, flagged, unreadable, absent."""
    (tmp_path / "course.toml").write_text(COURSE, "utf-8")
    (tmp_path / "roster.csv").write_text(ROSTER, "utf-8")
    made = term.load(tmp_path / "course.toml")
    made.course.results.mkdir()
    with Gradebook(default_url(made.course.results), "Prof. X") as book:
        hostile = [(1, HOSTILE), (2, "import os")]
        book.add(attempt("s1", 3.5, hostile, signs=("cell 2: imports os",)))
        book.add(attempt("s2", 1.0, [(1, "x = 1")], handed_in=LATER))
        book.add(Record("s3.ipynb", "s3", "99", reason="the file is empty"))
        yield ClassState(made, book)
