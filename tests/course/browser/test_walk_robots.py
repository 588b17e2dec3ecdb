"""Lessons with robots in a real browser: as all others, and at every zoom."""

import pytest

from tests.course.browser import walking

pytestmark = pytest.mark.walk
ROBOTS = ["notebooks/09_slam_with_walls.ipynb", "notebooks/14_devices_and_live_slam.ipynb"]


@pytest.mark.parametrize("ran", ROBOTS, indirect=True)
class TestFirstDay(walking.LessonsFirstDay):
    def zooms(self, lesson):
        return walking.ZOOMS


class TestNextDay:
    @pytest.mark.parametrize("notebook", ROBOTS)
    def test_a_saved_lesson_shows_what_it_showed(self, day, seen, notebook):
        walking.shows_again(day, notebook, seen)
