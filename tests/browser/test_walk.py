"""Every lesson in a real browser: lectured, run, saved, its controls worked, and opened again.

A lesson is run once, which takes longest: what is asked of it then follows on the same page.
"""

import pytest

from tests.browser import walking
from tests.browser.controls import Controls
from tests.browser.lecture import Lecture
from tests.browser.stops import SCREENS, walk_there_and_back

pytestmark = pytest.mark.walk
LESSONS = walking.notebooks("notebooks")
ZOOMS = {"usual": "0", "large": "0++", "largest": "0++++", "small": "0--", "smallest": "0----"}
ROBOTS = ("09_slam_with_walls", "14_the_emir_system")  # are driven in them: tried at every zoom
run = pytest.mark.parametrize("ran", LESSONS, indirect=True)
STILL = "notebooks/in_print.ipynb"  # the appendix has no controls
run_moving = pytest.mark.parametrize("ran", [one for one in LESSONS if one != STILL], indirect=True)


def zooms(lesson):
    """The zooms at which the controls of a lesson are worked: all, or one after another."""
    if any(name in lesson for name in ROBOTS):
        return list(ZOOMS)
    return [list(ZOOMS)[LESSONS.index(lesson) % len(ZOOMS)]]


@pytest.fixture
def lecture(day):
    """A lecture on what is open on a page; afterwards the page is as it was."""
    size = day.page.viewport_size
    day.page.set_viewport_size({"width": 1280, "height": 720})
    shown = Lecture(day)
    shown.start()
    yield shown
    shown.end_and_restore()
    day.page.set_viewport_size(size)


class TestFirstDay:
    @run
    def test_of_a_lesson_that_was_run_every_stop_fits_both_screens(self, ran, lecture):
        for screen in SCREENS:
            lecture.resize(*screen)
            lecture.press("Home")
            walk_there_and_back(lecture, ran, screen)

    @run
    def test_a_lesson_runs_and_is_saved(self, ran, day, student, seen):
        seen[ran] = walking.is_whole_and_saved(day, student / "course" / ran)

    @run_moving
    def test_every_control_works_where_it_is_seen_and_by_keys(self, ran, lecture):
        for zoom in zooms(ran):
            for key in ZOOMS[zoom]:
                lecture.press(key)
            lecture.press("Home")
            controls = Controls(lecture)
            wrong, count = [], 0
            for _ in lecture.walk():
                while found := list(controls.unworked()):  # one may show others
                    for kind, place in found:
                        wrong += controls.work(kind, place)
                    count += len(found)
            assert count and wrong == [], f"{zoom} zoom"
        assert lecture.visit.faults == []
        assert lecture.visit.abroad == []


class TestNextDay:
    @pytest.mark.parametrize("notebook", LESSONS)
    def test_a_saved_lesson_shows_what_it_showed(self, day, seen, notebook):
        if notebook not in seen:
            pytest.skip("it was not run")
        walking.shows(day, notebook, seen[notebook])
