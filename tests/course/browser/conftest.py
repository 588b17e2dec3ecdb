"""Fixtures: JupyterLab on a copy of the lessons, and its pages."""

import shutil
from contextlib import closing

import nbformat
import pytest

from course.source import ROOT
from tests.course.browser import driving, editing, live, measuring, waiting
from tests.course.browser.jupyter import Unavailable, Visit, chromium, jupyterlab
from tests.course.browser.lecture import Lecture

pytest.register_assert_rewrite("tests.course.browser.stops", "tests.course.browser.walking")


@pytest.fixture(scope="module")
def browser():
    """Chromium, without a window.

    Playwright's event loop runs as long as it is open: tests of other files may have their own.
    """
    try:
        with chromium() as opened:
            yield opened
    except Unavailable as reason:
        pytest.skip(str(reason))


@pytest.fixture(scope="session")
def lab_folder(tmp_path_factory):
    """The folder with all lessons and the notebooks of these tests."""
    notebooks = tmp_path_factory.mktemp("lab") / "course" / "notebooks"
    for folder in ("notebooks", "exercises"):
        shutil.copytree(ROOT / folder, notebooks.with_name(folder))
    for made in (live, waiting, editing, measuring, driving):
        nbformat.write(made.notebook(), notebooks / made.NAME)
    return notebooks


@pytest.fixture(scope="session")
def lab(lab_folder):
    """The address of a JupyterLab with that folder."""
    with jupyterlab(lab_folder.parent.parent) as address:
        yield address


@pytest.fixture
def visit(browser, lab):
    """A fresh page of JupyterLab."""
    context = browser.new_context(viewport={"width": 1280, "height": 800}, has_touch=True)
    yield Visit(context.new_page(), lab)
    context.close()


@pytest.fixture(scope="module")
def student(tmp_path_factory):
    """A student's computer: the course, and what JupyterLab keeps."""
    user_folder = tmp_path_factory.mktemp("student")
    for folder in ("notebooks", "exercises"):
        shutil.copytree(ROOT / folder, user_folder / "course" / folder)
    return user_folder


@pytest.fixture(scope="class")
def day(browser, student):
    """A page of a JupyterLab that runs for a day: the notebooks of a class, one after another."""
    with (
        jupyterlab(student) as address,
        closing(browser.new_context(viewport={"width": 1280, "height": 800})) as context,
    ):
        yield Visit(context.new_page(), address)


@pytest.fixture(scope="class")
def ran(request, day):
    """A notebook of which all cells were run: its path. The tests of a class share the run."""
    day.turn_to(request.param)
    day.wait_until_clean()
    day.run_all_and_wait()
    return request.param


@pytest.fixture
def lecture_of_day(day):
    """A lecture on what is open on that page; afterwards the page is as it was."""
    size = day.page.viewport_size
    day.page.set_viewport_size({"width": 1280, "height": 720})
    shown = Lecture(day)
    shown.start()
    yield shown
    shown.end_and_restore()
    day.page.set_viewport_size(size)


@pytest.fixture(scope="module")
def seen():
    """By notebook, the alternative texts of the pictures that were there when it was saved."""
    return {}
