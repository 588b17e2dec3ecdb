"""Lesson shown by the lecture mode in a browser without a window, on a copy of its own."""

import os
import shutil
import tempfile
from contextlib import contextmanager
from pathlib import Path

import nbformat
from nbformat.sign import NotebookNotary

from slamlab.coursework.folder import NO_COURSE, OFF, course_folder
from slamlab.files.published_recordings import DATA_FOLDER
from slamlab.lecturing.headless import chromium, jupyterlab

SCREEN = 1280, 720  # pixels
MINUTE = 60_000  # ms
PATIENCE = 3  # minutes for a page to be ready, and for a deck to begin: a guard against hanging
KERNEL = {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}
COMMAND = "slamlab:lecture"
SPARE = ".ink.spare.json"  # beside the ink, read where that is torn

_READY = """() => {
  const panel = window.jupyterapp?.shell.currentWidget;
  return Boolean(panel?.context?.isReady && panel.content?.widgets?.length);
}"""
# cells that are drawn while JupyterLab still opens may never be ready
_BEGIN = """async ([command, patience]) => {
  const app = window.jupyterapp, panel = app.shell.currentWidget;
  if (!app.commands.hasCommand(command)) return "unknown";
  const begin = async () => {
    await Promise.all([app.restored, panel.revealed, panel.sessionContext.ready]);
    panel.content.activeCellIndex = 0;
    await app.commands.execute(command);
    await document.fonts.ready;
    return panel.slamlabDeck ? "begun" : "late";
  };
  const late = new Promise((resolve) => { setTimeout(resolve, patience, "late"); });
  return Promise.race([begin(), late]);
}"""
_ASK = """async ([module, name, argument]) => {
  const sheet = document.querySelector('link[href$="lecture/lecture.css"]').href;
  const asked = await import(new URL(module, sheet));
  return asked[name](window.jupyterapp.shell.currentWidget, argument);
}"""


class ShowError(Exception):
    """A lesson cannot be shown; the text says why and what to do."""


def lesson(word, start="."):
    """Find a lesson's notebook.

    Parameters
    ----------
    word : str, its number, such as "07" or "7", or the path of a notebook
    start : Path, in the course's folder

    Returns
    -------
    Path

    Raises
    ------
    ShowError : there is none
    """
    path = Path(word)
    if path.is_file():
        return path
    place = course_folder(start)
    if not word.isdecimal():
        raise ShowError(f"{word}: no such file; name a lesson (07) or a notebook's path")
    if place is None:
        raise ShowError(NO_COURSE)
    known = sorted((place / "notebooks").glob("[0-9][0-9]_*.ipynb"))
    found = [each for each in known if each.name.startswith(f"{int(word):02}_")]
    if not found:
        numbers = ", ".join(each.name[:2] for each in known)
        raise ShowError(f"no lesson {word}; there are {numbers}")
    return found[0]


class Shown:
    """A notebook in the page of a browser; ``errors`` and ``abroad`` tell what went wrong there.

    Parameters
    ----------
    page : Page of Playwright
    """

    def __init__(self, page):
        self.page, self.errors, self.abroad = page, [], []
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("request", self._requested)

    def begin(self):
        """Start the lecture at the first slide; ShowError where there is no lecture mode."""
        begun = self.page.evaluate(_BEGIN, [COMMAND, PATIENCE * MINUTE])
        if begun == "late":
            raise ShowError("the lecture did not begin: " + "; ".join(self.errors or ["no reason"]))
        if begun == "unknown":
            raise ShowError(
                "JupyterLab does not know the lecture mode: set the course up with `python lab.py`"
            )

    def ask(self, module, name, argument=None):
        """Call a function of one of the lecture mode's modules on the notebook's panel.

        Parameters
        ----------
        module : str, such as "rehearsal.js"
        name : str, of the function
        argument : what JSON holds, passed on

        Returns
        -------
        What the function gives, as plain Python values
        """
        return self.page.evaluate(_ASK, [module, name, argument])

    def _requested(self, request):
        if not request.url.startswith(("http://127.0.0.1:", "http://localhost:", "data:", "blob:")):
            self.abroad.append(request.url)


@contextmanager
def shown(notebook, screen=SCREEN):
    """Open a copy of a notebook, and of its ink, in a browser without a window.

    Parameters
    ----------
    notebook : Path
    screen : (width, height) [pixels]

    Yields
    ------
    Shown

    Raises
    ------
    Unavailable : no browser, or no JupyterLab
    ShowError : it is no notebook
    """
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder, chromium() as browser:
        home, course = Path(folder), Path(folder) / "course"
        course.mkdir()
        _copy(notebook, course / notebook.name, home / "data")
        for ink in (ink_of(notebook), notebook.with_suffix(SPARE)):
            if ink.exists():
                shutil.copy(ink, course)
        data = Path(os.environ.get("SLAMLAB_DATA") or DATA_FOLDER).resolve()
        # the copy has the course's recordings, and what it is asked is nobody's progress
        with jupyterlab(home, {"SLAMLAB_DATA": data, OFF: 1}) as address:
            size = dict(zip(("width", "height"), screen, strict=True))
            page = browser.new_context(viewport=size).new_page()
            page.set_default_timeout(PATIENCE * MINUTE)
            page.goto(address.format(notebook.name))
            page.wait_for_function(_READY)
            yield Shown(page)


def _copy(notebook, to, data):
    """A copy that runs here, without a dialog on its kernel, and is trusted as its owner does."""
    try:
        copied = nbformat.read(notebook, as_version=4)
    except (nbformat.reader.NotJSONError, nbformat.ValidationError) as error:
        raise ShowError(f"{notebook} is no notebook: {str(error).splitlines()[0][:100]}") from None
    if not copied.cells:
        raise ShowError(f"{notebook} has no cells")
    copied.metadata["kernelspec"] = KERNEL
    nbformat.write(copied, to)
    data.mkdir()
    NotebookNotary(data_dir=str(data)).sign(copied)


def ink_of(notebook):
    """The file of what was drawn on a notebook's slides, be it there or not."""
    return notebook.with_suffix(".ink.json")
