"""Every lesson in a real browser: shown as a lecture, run, saved, controls used, reopened."""

import pytest

from tests.course.browser import walking
from tests.course.browser.test_walk_robots import ROBOTS

pytestmark = pytest.mark.walk
LESSONS = [lesson for lesson in walking.notebooks("notebooks") if lesson not in ROBOTS]


@pytest.mark.parametrize("ran", LESSONS, indirect=True)
class TestFirstDay(walking.LessonsFirstDay):
    def zooms(self, lesson):  # one after another
        return [list(walking.ZOOMS)[LESSONS.index(lesson) % len(walking.ZOOMS)]]


class TestNextDay:
    @pytest.mark.parametrize("notebook", LESSONS)
    def test_a_saved_lesson_shows_what_it_showed(self, day, seen, notebook):
        walking.shows_again(day, notebook, seen)
