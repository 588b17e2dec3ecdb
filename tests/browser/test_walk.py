"""Every lesson and exercise, opened, run, saved, and opened again, in a real browser."""

import shutil
from contextlib import closing

import pytest

from course.source import ROOT
from tests.browser.jupyter import Visit, jupyterlab

pytestmark = pytest.mark.walk
NOTEBOOKS = [
    path.relative_to(ROOT).as_posix()
    for folder in ("notebooks", "exercises")
    for path in sorted((ROOT / folder).glob("*.ipynb"))
]
PICTURES = ".jp-OutputArea-output img"
LIMIT = 800_000  # of a lesson's file [bytes], outputs of a run included


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """A student's computer: the course, and what JupyterLab keeps."""
    home = tmp_path_factory.mktemp("walk")
    for folder in ("notebooks", "exercises"):
        shutil.copytree(ROOT / folder, home / "course" / folder)
    return home


@pytest.fixture(scope="class")
def visit(browser, home):
    """A page of a JupyterLab that runs for a day: the notebooks of a class, one after another."""
    with (
        jupyterlab(home) as address,
        closing(browser.new_context(viewport={"width": 1280, "height": 800})) as context,
    ):
        yield Visit(context.new_page(), address)


@pytest.fixture(scope="module")
def seen():
    """By notebook, the alternative texts of the pictures that were there when it was saved."""
    return {}


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


class TestFirstDay:
    @pytest.mark.parametrize("notebook", NOTEBOOKS)
    def test_a_notebook_is_opened_run_and_saved(self, visit, home, seen, notebook):
        page = visit.page
        visit.turn_to(notebook)
        visit.wait_until_clean()
        visit.run_all_and_wait()
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
        seen[notebook] = alternatives(visit)
        assert all(seen[notebook])
        assert visit.faults == []
        assert visit.abroad == []
        assert (home / "course" / notebook).stat().st_size < LIMIT


class TestNextDay:
    @pytest.mark.parametrize("notebook", NOTEBOOKS)
    def test_a_saved_notebook_shows_what_it_showed(self, visit, seen, notebook):
        if notebook not in seen:
            pytest.skip("it was not run")
        visit.turn_to(notebook)
        visit.look_through()
        visit.wait_until_clean()
        unfold_outputs(visit)
        assert alternatives(visit) == seen[notebook]
        assert visit.page.get_by_text("Error displaying widget").count() == 0
        assert visit.page.get_by_text("model not found").count() == 0
