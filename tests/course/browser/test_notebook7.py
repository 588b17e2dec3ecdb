"""The course in Notebook 7, which the extension also supports."""

import shutil

import pytest

from tests.course.browser.jupyter import jupyterlab

pytest.importorskip("notebook", reason="Notebook 7 is not installed")
pytestmark = pytest.mark.walk
# of Notebook 7 itself, with or without the course's extension
ITS_OWN = "Cannot read properties of undefined (reading 'schema')"


@pytest.fixture(scope="module")
def lab(lab_folder, tmp_path_factory):
    """The address of a server of its own.

    Where JupyterLab was used before, on the same server, its fonts are refused to Notebook 7, and
    its file browser's place is asked for: the server's faults, not the course's.
    """
    user_folder = tmp_path_factory.mktemp("notebook7")
    shutil.copytree(lab_folder.parent, user_folder / "course")
    with jupyterlab(user_folder) as address:
        yield address


@pytest.fixture
def notebook7(visit):
    visit.address = visit.address.replace("lab/tree/", "notebooks/").replace("?reset&", "?")
    return visit


@pytest.mark.parametrize(
    "name", ["notebooks/00_start_here.ipynb", "exercises/ex03_kalman_filter.ipynb"]
)
def test_a_notebook_runs_and_shows_its_figures_and_progress(notebook7, name):
    page = notebook7.page
    page.goto(notebook7.address.format(name))
    page.wait_for_selector(".jp-NotebookPanel .jp-Cell")
    page.locator(".slamlab-progress").wait_for()
    page.get_by_text("Python 3 (ipykernel)").first.wait_for()
    notebook7.run_all_and_wait()
    wrong = page.locator('[data-mime-type="application/vnd.jupyter.error"]')
    assert wrong.all_text_contents() == []
    pictures = page.locator(".jp-OutputArea-output img")
    assert pictures.evaluate_all("all => all.every((one) => one.alt && one.naturalWidth > 0)")
    assert [error for error in notebook7.errors if ITS_OWN not in error] == []
    assert notebook7.foreign_requests == []
