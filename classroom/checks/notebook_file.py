"""Find the file of this kernel's notebook, and the definitions that are not saved in it."""

import ast
import json
import os
from pathlib import Path


def notebook_file(names, folder="."):
    """Return the file of this kernel's notebook, or None if no file or several files match.

    The Jupyter server and Visual Studio Code pass the notebook's name to the kernel, but do not
    report a later change of this name. In other front ends, the notebook that contains most of the
    executed cells is chosen."""
    folder = Path(folder)
    ran = {source.strip() for source in _history(names)} - {""}
    for given in (os.environ.get("JPY_SESSION_NAME"), names.get("__vsc_ipynb_file__")):
        if given and given.endswith(".ipynb"):
            # the name may be relative to the server's folder; the kernel runs in the notebook's
            for path in (Path(given), folder / Path(given).name):
                if path.is_file():
                    return None if _was_renamed(path, ran) else path
    held = _held(folder, ran)
    most = max(held.values(), default=0)
    fitting = [path for path, count in held.items() if count == most]
    # a single cell, such as the imports, may be in many notebooks
    return fitting[0] if most >= 2 and len(fitting) == 1 else None


def _was_renamed(path, ran):
    """Whether another file contains the cells that were run, and the given file does not."""
    held = _held(path.parent, {source for source in ran if _defined(source)})
    return 2 * held.get(path, 0) < max(held.values(), default=0)


def _held(folder, ran):
    return {path: len(ran & set(_sources(path))) for path in sorted(folder.glob("*.ipynb"))}


def unsaved_definitions(path, names):
    """Return the functions and classes whose last run definition differs from the saved one."""
    last = {}
    for source in _history(names):
        last |= _defined(source)
    saved = {}
    for source in _sources(path):
        saved |= _defined(source)
    return [name for name in saved if name in last and last[name] != saved[name]]


def _history(names):
    ran = names.get("In", [])
    return [source for source in ran if isinstance(source, str)] if isinstance(ran, list) else []


def _sources(path):
    try:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        return ["".join(c["source"]).strip() for c in cells if c["cell_type"] == "code"]
    except (OSError, ValueError, KeyError, TypeError):
        return []


def _defined(source):
    """Return the definitions in a cell, except functions named ``_``, which ``@attempt`` calls."""
    try:
        body = ast.parse(source).body
    except (SyntaxError, ValueError):
        return {}
    kinds = ast.FunctionDef | ast.ClassDef
    found = {node.name: ast.dump(node) for node in body if isinstance(node, kinds)}
    return {name: form for name, form in found.items() if name != "_"}
