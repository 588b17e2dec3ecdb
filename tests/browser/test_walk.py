"""Every lesson and exercise, opened, run, saved, and opened again, in a real browser."""

import shutil

import pytest

from course.source import ROOT
from tests.browser.jupyter import BUSY, Visit, jupyterlab

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


@pytest.fixture(scope="module")
def first_day(home):
    """The address of JupyterLab, as long as the notebooks are run."""
    with jupyterlab(home) as address:
        yield address


@pytest.fixture(scope="module")
def seen():
    """By notebook, the alternative texts of the pictures that were there when it was saved."""
    return {}


@pytest.fixture
def page(browser):
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    yield context.new_page()
    context.close()


def alternatives(visit):
    """The alternative texts of all pictures."""
    return visit.page.locator(PICTURES).evaluate_all("all => all.map((one) => one.alt)")


def unfold_outputs(visit):
    """Open the outputs that wait for an answer, of all cells; a file keeps them folded."""
    visit.look_through()
    for folded in visit.page.locator(".jp-OutputPlaceholder:visible").all():
        folded.click()


@pytest.mark.parametrize("notebook", NOTEBOOKS)
def test_a_notebook_is_opened_run_and_saved(page, first_day, home, seen, notebook):
    visit = Visit(page, first_day)
    visit.open(notebook)
    page.wait_for_timeout(1500)  # JupyterLab writes what it knows of the kernel
    assert not visit.is_dirty
    visit.run_all_and_wait()
    unfold_outputs(visit)
    wrong = page.locator('[data-mime-type="application/vnd.jupyter.error"]')
    assert wrong.all_text_contents() == []
    assert visit.serious_faults() == []
    for handle in page.get_by_role("slider").all():
        assert handle.get_attribute("aria-label")
        before = handle.get_attribute("aria-valuetext")
        handle.focus()
        page.keyboard.press("ArrowLeft")
        if handle.get_attribute("aria-valuetext") == before:  # it stood at its left end
            page.keyboard.press("ArrowRight")
        assert handle.get_attribute("aria-valuetext") != before
    page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]")
    visit.save()
    seen[notebook] = alternatives(visit)
    assert all(seen[notebook])
    assert [error for error in visit.errors if BUSY not in error] == []
    assert visit.abroad == []
    assert (home / "course" / notebook).stat().st_size < LIMIT


@pytest.fixture(scope="module")
def next_day(home):
    """The address of another JupyterLab in the same place."""
    with jupyterlab(home) as address:
        yield address


@pytest.mark.parametrize("notebook", NOTEBOOKS)
def test_a_saved_notebook_shows_on_the_next_day_what_it_showed(page, next_day, seen, notebook):
    if notebook not in seen:
        pytest.skip("it was not run")
    visit = Visit(page, next_day)
    visit.open(notebook)
    page.wait_for_timeout(1500)
    assert not visit.is_dirty
    unfold_outputs(visit)
    assert alternatives(visit) == seen[notebook]
    assert page.get_by_text("Error displaying widget").count() == 0
    assert page.get_by_text("model not found").count() == 0
