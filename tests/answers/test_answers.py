"""Independent right answers keep their points; few wrong ones keep all, and none meets silence."""

from collections import Counter

import pytest

from course.programs import programs
from tests.answers import IDS, answers
from tests.answers.__main__ import kind, told

PASSED = 0.08
"""Share of an exercise's wrong answers that may keep full marks; the aim is 0.01."""


@pytest.mark.slow
@pytest.mark.parametrize("id", IDS)
def test_a_right_answer_keeps_its_points(id):
    of = {one.task.id: one for one in programs(id)}
    open_task = list(of)[-1]  # where another method may be good, and not the best
    for task, what, source in answers(id)[0]:
        verdict = told(of[task], source)
        assert verdict.points >= of[task].task.points * (0.5 if task == open_task else 1), what


@pytest.mark.soak
@pytest.mark.parametrize("id", IDS)
def test_a_wrong_answer_is_seen_and_something_is_said_of_it(id):
    of = {one.task.id: one for one in programs(id)}
    wrong = answers(id)[1]
    taken = Counter(kind(of[task], told(of[task], source)) for task, _, source in wrong)
    assert taken["silent"] == 0
    assert taken["passed"] <= PASSED * len(wrong)
