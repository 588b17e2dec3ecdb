"""The file of the notebook whose kernel this is, and what of it is not saved."""

import ast
import json
import os
from pathlib import Path


def notebook_file(names, folder="."):
    """Find the file of the notebook whose kernel this is.

    Jupyter's server and Visual Studio Code tell their kernels, but not of a new name. Elsewhere it
    is the one notebook in the kernel's folder that holds most of the cells that were run.

    Parameters
    ----------
    names : dict, the notebook's names
    folder : Path, where the kernel stands

    Returns
    -------
    Path, or None where no file fits, or two do
    """
    folder = Path(folder)
    ran = {source.strip() for source in _history(names)} - {""}
    for told in (os.environ.get("JPY_SESSION_NAME"), names.get("__vsc_ipynb_file__")):
        if told and told.endswith(".ipynb"):
            # the server may name it from its own folder on; the kernel stands beside it
            for path in (Path(told), folder / Path(told).name):
                if path.is_file():
                    return None if _was_renamed(path, ran) else path
    held = _held(folder, ran)
    most = max(held.values(), default=0)
    fitting = [path for path, count in held.items() if count == most]
    # one cell may be in many notebooks, as the imports are
    return fitting[0] if most >= 2 and len(fitting) == 1 else None


def _was_renamed(path, ran):
    """Whether another file holds what was run, and one that bears its old name does not."""
    held = _held(path.parent, {source for source in ran if _defined(source)})
    return 2 * held.get(path, 0) < max(held.values(), default=0)


def _held(folder, ran):
    """How many of some cells each notebook of a folder holds: path to int."""
    return {path: len(ran & set(_sources(path))) for path in sorted(folder.glob("*.ipynb"))}


def unsaved_definitions(path, names):
    """List the functions and classes that were run last in another form than the file holds.

    Parameters
    ----------
    path : Path, of the notebook
    names : dict, the notebook's names

    Returns
    -------
    list of str, their names, in the file's order
    """
    last = {}
    for source in _history(names):
        last |= _defined(source)
    saved = {}
    for source in _sources(path):
        saved |= _defined(source)
    return [name for name in saved if name in last and last[name] != saved[name]]


def _history(names):
    """The sources of the cells that were run, as IPython remembers them."""
    ran = names.get("In", [])
    return [source for source in ran if isinstance(source, str)] if isinstance(ran, list) else []


def _sources(path):
    """The sources of the code cells of a notebook's file; none where it cannot be read."""
    try:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        return ["".join(c["source"]).strip() for c in cells if c["cell_type"] == "code"]
    except (OSError, ValueError, KeyError, TypeError):
        return []


def _defined(source):
    """What a cell defines: name to its form without comments and layout.

    ``_`` is a trial under ``@attempt``: many cells have one, and none of them is handed in.
    """
    try:
        body = ast.parse(source).body
    except (SyntaxError, ValueError):
        return {}
    kinds = ast.FunctionDef | ast.ClassDef
    found = {node.name: ast.dump(node) for node in body if isinstance(node, kinds)}
    return {name: form for name, form in found.items() if name != "_"}
