"""A student's session: a notebook is opened, run and saved; then it is opened again.

A lesson is lectured, too, and its controls are worked. It is run once, which takes longest: what is
asked of it then follows on the same page.
"""

import pytest

from course.source import ROOT
from tests.course.browser.controls import Controls
from tests.course.browser.stops import SCREENS, walk_there_and_back

PICTURES = ".jp-OutputArea-output img"
ZOOMS = {"usual": "0", "large": "0++", "largest": "0++++", "small": "0--", "smallest": "0----"}
STILL = "notebooks/in_print.ipynb"  # the appendix has no controls
LIMIT = 800_000  # of a notebook's file [bytes], outputs of a run included


def notebooks(folder):
    """The notebooks of a folder of the course, by their paths."""
    return [path.relative_to(ROOT).as_posix() for path in sorted((ROOT / folder).glob("*.ipynb"))]


def alternatives(visit):
    """The alternative texts of all pictures."""
    return visit.page.locator(PICTURES).evaluate_all("all => all.map((one) => one.alt)")


def unfold_outputs(visit):
    """Open the outputs that wait for an answer, of all cells; a file keeps them folded."""
    # all at once: each that is opened is one fewer to count by
    folded = visit.page.locator(".jp-OutputPlaceholder:visible")
    folded.evaluate_all("all => all.forEach((one) => one.click())")
    assert folded.count() == 0


def move_by_keyboard(page, handle):
    """Move a slider by a step."""
    before = handle.get_attribute("aria-valuetext")
    handle.focus()
    page.keyboard.press("ArrowLeft")
    if handle.get_attribute("aria-valuetext") == before:  # it stood at its left end
        page.keyboard.press("ArrowRight")
    assert handle.get_attribute("aria-valuetext") != before


def is_whole_and_saved(visit, file):
    """Look through a notebook that was run, move its sliders, and save it.

    Parameters
    ----------
    visit : Visit
    file : Path

    Returns
    -------
    list of str, the alternative texts of its pictures
    """
    page = visit.page
    visit.look_through()
    unfold_outputs(visit)
    wrong = page.locator('[data-mime-type="application/vnd.jupyter.error"]')
    assert wrong.all_text_contents() == []
    assert visit.serious_faults() == []
    for handle in page.get_by_role("slider").all():
        assert handle.get_attribute("aria-label")
        move_by_keyboard(page, handle)
    visit.settle()
    visit.save()
    seen = alternatives(visit)
    assert all(seen)
    assert visit.faults == []
    assert visit.foreign_requests == []
    assert file.stat().st_size < LIMIT
    return seen


def shows_again(visit, notebook, seen):
    """Open a notebook: it shows the pictures that were there when it was saved, by notebook."""
    if notebook not in seen:
        pytest.skip("it was not run")
    visit.turn_to(notebook)
    visit.look_through()
    visit.wait_until_clean()
    unfold_outputs(visit)
    assert alternatives(visit) == seen[notebook]
    assert visit.page.get_by_text("Error displaying widget").count() == 0
    assert visit.page.get_by_text("model not found").count() == 0


def every_control_works(lecture, zoom):
    """Work all controls of a lecture where they are seen and by keys, at one of the zooms.

    Returns
    -------
    int, how many there are
    """
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
    assert wrong == [], f"{zoom} zoom"
    return count


class LessonsFirstDay:
    """Checks of lessons that were run; a file lists the lessons and the zooms."""

    def test_every_stop_of_a_lesson_that_was_run_fits_both_screens(self, ran, lecture_of_day):
        for screen in SCREENS:
            lecture_of_day.resize(*screen)
            lecture_of_day.press("Home")
            walk_there_and_back(lecture_of_day, ran, screen)

    def test_a_lesson_runs_and_is_saved(self, ran, day, student, seen):
        seen[ran] = is_whole_and_saved(day, student / "course" / ran)

    def test_every_control_works_where_it_is_seen_and_by_keys(self, ran, lecture_of_day):
        for zoom in self.zooms(ran):
            assert every_control_works(lecture_of_day, zoom) or ran == STILL
        assert lecture_of_day.visit.faults == []
        assert lecture_of_day.visit.foreign_requests == []
