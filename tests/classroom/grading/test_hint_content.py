"""Every mistake has a question, every law a step, and every task a question to begin with."""

import pytest

from classroom.exercises import catalogue
from course.task_report import lacking


@pytest.mark.parametrize("id", catalogue.EXERCISES)
def test_no_hint_lacks_a_question_or_a_step(id):
    assert lacking(id) == []
