"""Render the moving outputs of a lesson: live views as films, sliders as pictures of every value.

A lesson is run once in a separate process, ``python -m course.site.rendering NOTEBOOK FOLDER``. The
result is cached until the code changes.
"""

import gc
import hashlib
import json
import os
import shutil
import subprocess
import sys
import traceback
from pathlib import Path

import nbformat

from classroom.coursework.folder import OFF
from course.source import ROOT
from slamlab.parallel import THREAD_VARIABLES

MOVES = ("views.explore(", "live.watch(")
VERSION = 2  # of the renderings; a new version renders all again
RESULTS = "rendered.json"  # renderings by the cell's id


class RenderingError(Exception):
    """A lesson cannot be run; the message names the lesson, the cell, the line and the cause."""


def moving(notebook):
    """Return the code cells of a notebook up to the last one with a moving output.

    Parameters
    ----------
    notebook : NotebookNode

    Returns
    -------
    list of NotebookNode, empty if no output moves
    """
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    last = [n for n, cell in enumerate(code) if any(word in cell.source for word in MOVES)]
    return code[: last[-1] + 1] if last else []


def rendered(path, cache):
    """Render the moving outputs of a lesson, unless they are cached.

    Parameters
    ----------
    path : Path, of the notebook
    cache : Path, folder of all renderings; older ones of this lesson are deleted

    Returns
    -------
    (dict, Path) : renderings of :mod:`course.site.moving_pictures` by the cell's id, and the folder

    Raises
    ------
    RenderingError
    """
    cells = moving(nbformat.read(path, as_version=4))
    code = json.dumps([VERSION, *([cell.id, cell.source] for cell in cells)])
    folder = cache / f"{path.stem}-{hashlib.sha256(code.encode()).hexdigest()[:16]}"
    if not cells:
        return {}, folder
    if not (folder / RESULTS).exists():
        for old in cache.glob(f"{path.stem}-*"):
            shutil.rmtree(old)
        folder.mkdir(parents=True)
        _render(path, folder)
    return json.loads((folder / RESULTS).read_text(encoding="utf-8")), folder


def _render(path, folder):
    env = os.environ | {"MPLBACKEND": "agg", "PYTHONHASHSEED": "0", OFF: "1"}
    env |= dict.fromkeys(THREAD_VARIABLES, "1")
    env["PYTHONPATH"] = os.pathsep.join([str(ROOT), env.get("PYTHONPATH", "")])
    if "SLAMLAB_DATA" in env:  # the lesson is in another folder
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
    """Run a lesson's cells and render their moving outputs into a folder.

    Parameters
    ----------
    path : str, of the notebook
    folder : str
    """
    from IPython.core.interactiveshell import InteractiveShell

    from course.site.moving_pictures import Renderer
    from slamlab import live, views

    gc.set_threshold(100_000)  # figures are many objects, and little of them is garbage
    shell, renderer = InteractiveShell.instance(), Renderer(Path(folder))
    views.explore, live.watch = renderer.explore, renderer.live
    views.show = lambda *_, **__: None  # still pictures are stored already
    for number, cell in enumerate(moving(nbformat.read(path, as_version=4)), start=1):
        renderer.cell = cell.id
        done = shell.run_cell(cell.source)
        if error := done.error_before_exec or done.error_in_exec:
            sys.exit(_place(error, f"code cell {number} ({cell.id})", cell.source.splitlines()))
    (Path(folder) / RESULTS).write_text(json.dumps(renderer.rendered), encoding="utf-8")


def _place(error, cell, lines):
    """Return the traceback of a cell's error, and the cell, the line and the error."""
    frames = traceback.extract_tb(error.__traceback__)
    in_cells = [each.lineno for each in frames if each.filename.startswith("<ipython-input")]
    line = in_cells[0] if in_cells else error.lineno  # of a SyntaxError
    shown = "".join(traceback.format_exception(error))
    return f"{shown}{cell}, line {line}: {lines[line - 1].strip()}"


if __name__ == "__main__":
    main(*sys.argv[1:])
