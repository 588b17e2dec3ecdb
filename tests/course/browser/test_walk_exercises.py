"""Every exercise in a real browser: opened, run, saved, reopened."""

import pytest

from tests.course.browser import walking

pytestmark = pytest.mark.walk
EXERCISES = walking.notebooks("exercises")


class TestFirstDay:
    @pytest.mark.parametrize("ran", EXERCISES, indirect=True)
    def test_an_exercise_runs_and_is_saved(self, ran, day, student, seen):
        seen[ran] = walking.is_whole_and_saved(day, student / "course" / ran)


class TestNextDay:
    @pytest.mark.parametrize("notebook", EXERCISES)
    def test_a_saved_exercise_shows_what_it_showed(self, day, seen, notebook):
        walking.shows_again(day, notebook, seen)
