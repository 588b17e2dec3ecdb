"""A JupyterLab on a copy of the lessons, and pages of it."""

import shutil

import nbformat
import pytest

from course.source import ROOT
from tests.browser import driving, editing, live, measuring, waiting
from tests.browser.jupyter import Unavailable, Visit, chromium, jupyterlab


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
