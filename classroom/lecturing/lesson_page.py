"""Page of a lesson in lecture mode: a copy of the notebook in a headless browser."""

import shutil
import tempfile
from contextlib import contextmanager
from pathlib import Path

import nbformat
from nbformat.sign import NotebookNotary

from classroom.coursework.folder import NO_COURSE, OFF, course_folder
from classroom.lecturing.headless import chromium, jupyterlab
from slamlab.sources.public_datasets import data_folder

SCREEN = 1280, 720  # pixels
MINUTE = 60_000  # ms
PATIENCE = 3  # timeout for a page and for the lecture mode to start [min]
KERNEL = {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}
COMMAND = "slamlab:lecture"
SPARE = ".ink.spare.json"  # backup of the ink, read if the ink is damaged

_READY = """() => {
  const panel = window.jupyterapp?.shell.currentWidget;
  return Boolean(panel?.context?.isReady && panel.content?.widgets?.length);
}"""
# wait until JupyterLab is open: cells drawn earlier may never be ready
_START = """async ([command, patience]) => {
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
_CALL = """async ([module, name, argument]) => {
  const sheet = document.querySelector('link[href$="lecture/lecture.css"]').href;
  const asked = await import(new URL(module, sheet));
  return asked[name](window.jupyterapp.shell.currentWidget, argument);
}"""


class LessonError(Exception):
    """A lesson cannot be opened; the message explains why and what to do."""


def find_lesson(word, start="."):
    """Find a lesson's notebook by its number ("07" or "7") or path; raise LessonError if it is
    missing."""
    path = Path(word)
    if path.is_file():
        return path
    place = course_folder(start)
    if not word.isdecimal():
        raise LessonError(f"{word}: file not found. Name a lesson (07) or the path of a notebook")
    if place is None:
        raise LessonError(NO_COURSE)
    known = sorted((place / "notebooks").glob("[0-9][0-9]_*.ipynb"))
    found = [each for each in known if each.name.startswith(f"{int(word):02}_")]
    if not found:
        numbers = ", ".join(each.name[:2] for each in known)
        raise LessonError(f"lesson {word} does not exist. The lessons are {numbers}")
    return found[0]


class LessonPage:
    """A notebook in a Playwright page, with the page's ``errors`` and ``external_requests``."""

    def __init__(self, page):
        self.page, self.errors, self.external_requests = page, [], []
        page.on("pageerror", self._failed)
        page.on("request", self._requested)

    def start(self):
        """Start the lecture mode at the first slide; raise LessonError if the mode is missing."""
        started = self.page.evaluate(_START, [COMMAND, PATIENCE * MINUTE])
        if started == "late":
            raise LessonError(
                "the lecture mode did not start: " + "; ".join(self.errors or ["no reason given"])
            )
        if started == "unknown":
            raise LessonError(
                "JupyterLab does not have the lecture mode. Set up the course with `python lab.py`"
            )

    def call(self, module, name, argument=None):
        """Call a function in a module of the lecture mode, such as "rehearsal.js"."""
        return self.page.evaluate(_CALL, [module, name, argument])

    def _failed(self, error):
        # JupyterLab repeats a request that a busy machine fails: no fault of the lesson
        if "Failed to fetch" not in str(error):
            self.errors.append(str(error))

    def _requested(self, request):
        if not request.url.startswith(("http://127.0.0.1:", "http://localhost:", "data:", "blob:")):
            self.external_requests.append(request.url)


@contextmanager
def open_lesson(notebook, screen=SCREEN):
    """Open a copy of a notebook and its ink in a headless browser; yield a LessonPage.

    screen : (width, height) [pixels]. Raises Unavailable, LessonError."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder, chromium() as browser:
        root, course = Path(folder), Path(folder) / "course"
        course.mkdir()
        _copy(notebook, course / notebook.name, root / "data")
        for ink in (ink_of(notebook), notebook.with_suffix(SPARE)):
            if ink.exists():
                shutil.copy(ink, course)
        data = data_folder().resolve()
        # the copy uses the course's recordings, and records no progress
        with jupyterlab(root, {"SLAMLAB_DATA": data, OFF: 1}) as address:
            size = dict(zip(("width", "height"), screen, strict=True))
            page = browser.new_context(viewport=size).new_page()
            page.set_default_timeout(PATIENCE * MINUTE)
            page.goto(address.format(notebook.name))
            page.wait_for_function(_READY)
            yield LessonPage(page)


def _copy(notebook, to, data):
    """Copy a notebook, set its standard kernel, and sign the copy as trusted."""
    try:
        copied = nbformat.read(notebook, as_version=4)
    except (nbformat.reader.NotJSONError, nbformat.ValidationError) as error:
        raise LessonError(
            f"{notebook} is not a notebook: {str(error).splitlines()[0][:100]}"
        ) from None
    if not copied.cells:
        raise LessonError(f"{notebook} has no cells")
    copied.metadata["kernelspec"] = KERNEL
    nbformat.write(copied, to)
    data.mkdir()
    NotebookNotary(data_dir=str(data)).sign(copied)


def ink_of(notebook):
    return notebook.with_suffix(".ink.json")
