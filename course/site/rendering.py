"""Render what moves in a lesson: its live views as films, its sliders as pictures of every value.

A lesson is run once in a process of its own, ``python -m course.site.rendering NOTEBOOK FOLDER``, and
then kept as long as its code stays as it is.
"""

import hashlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat

from course.source import ROOT
from slamlab.coursework.folder import OFF
from slamlab.parallel import THREAD_VARIABLES

MOVES = ("views.explore(", "views.live(")
VERSION = 1  # of what is rendered; another one renders all anew
TOLD = "rendered.json"  # what was rendered, by the cell's id


class RenderingError(Exception):
    """A lesson cannot be run; the text says which and why."""


def moving(notebook):
    """The code cells of a notebook, if any of them moves; else none.

    Parameters
    ----------
    notebook : NotebookNode

    Returns
    -------
    list of NotebookNode, up to the last one that moves
    """
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    last = [n for n, cell in enumerate(code) if any(word in cell.source for word in MOVES)]
    return code[: last[-1] + 1] if last else []


def rendered(path, cache):
    """What moves in a lesson, rendered now or before.

    Parameters
    ----------
    path : Path, of the notebook
    cache : Path, folder of all that was rendered; older renderings of this lesson go

    Returns
    -------
    (dict, Path) : by a cell's id what :mod:`course.site.moving_pictures` told, and the folder

    Raises
    ------
    RenderingError
    """
    cells = moving(nbformat.read(path, as_version=4))
    code = json.dumps([VERSION, *([cell.id, cell.source] for cell in cells)])
    folder = cache / f"{path.stem}-{hashlib.sha256(code.encode()).hexdigest()[:16]}"
    if not cells:
        return {}, folder
    if not (folder / TOLD).exists():
        for old in cache.glob(f"{path.stem}-*"):
            shutil.rmtree(old)
        folder.mkdir(parents=True)
        _render(path, folder)
    return json.loads((folder / TOLD).read_text(encoding="utf-8")), folder


def _render(path, folder):
    env = os.environ | {"MPLBACKEND": "agg", "PYTHONHASHSEED": "0", OFF: "1"}
    env |= dict.fromkeys(THREAD_VARIABLES, "1")
    env["PYTHONPATH"] = os.pathsep.join([str(ROOT), env.get("PYTHONPATH", "")])
    if "SLAMLAB_DATA" in env:  # the lesson stands in another folder
        env["SLAMLAB_DATA"] = str(Path(env["SLAMLAB_DATA"]).resolve())
    done = subprocess.run(
        [sys.executable, "-m", __name__, str(path.resolve()), str(folder.resolve())],
        cwd=path.parent,
        env=env,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    if done.returncode:
        raise RenderingError(f"{path.stem} cannot be rendered:\n{done.stderr[-2000:]}")


def main(path, folder):
    """Run a lesson's cells; what moves in them is rendered into a folder.

    Parameters
    ----------
    path : str, of the notebook
    folder : str
    """
    from IPython.core.interactiveshell import InteractiveShell

    from course.site.moving_pictures import Renderer
    from slamlab import views

    shell, renderer = InteractiveShell.instance(), Renderer(Path(folder))
    views.explore, views.live = renderer.explore, renderer.live
    views.show = lambda *_, **__: None  # what stands still is stored
    for cell in moving(nbformat.read(path, as_version=4)):
        renderer.cell = cell.id
        shell.run_cell(cell.source).raise_error()
    (Path(folder) / TOLD).write_text(json.dumps(renderer.told), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
