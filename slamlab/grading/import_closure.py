"""Import closure: all modules that some modules import, read from their text without running it.

It makes the whitelist of modules of a worker, see :mod:`slamlab.grading.staging`. It does not see
through a lazy door (:mod:`slamlab._lazy`), which names modules as strings: what a worker may hold
imports each name from the module that defines it.
"""

import ast
from pathlib import Path

from slamlab.grading import syntax

ROOT = Path(__file__).resolve().parents[2]
STUBBED = "slamlab.checks"
"""In a worker this package's own code is :mod:`slamlab.grading.checks_stub`."""


def closure(modules, root=ROOT, with_packages=True) -> dict[str, Path]:
    """The transitive import closure of some modules, imports inside functions included.

    Only modules of the same top-level packages count; other libraries are not looked into.

    Parameters
    ----------
    modules : iterable of dotted names
    root : Path, the folder that holds the top-level packages
    with_packages : bool, whether the packages that a module stands in count, which run first

    Returns
    -------
    dotted name to file

    Raises
    ------
    ModuleNotFoundError : when one of the modules given is no file there
    """
    modules = list(modules)
    tops = {name.split(".")[0] for name in modules}
    found, waiting = {}, []
    for name in modules:
        if _file(root, name) is None:
            raise ModuleNotFoundError(f"there is no module {name} in {root}")
        waiting.append(name)
    while waiting:
        name = waiting.pop()
        file = _file(root, name)
        if name in found or file is None or name.split(".")[0] not in tops:
            continue
        found[name] = file
        if "." in name and with_packages:
            waiting.append(name.rpartition(".")[0])
        if name != STUBBED:
            waiting += imported(file, name)
    return found


def _file(root, name):
    path = Path(root, *name.split("."))
    for file in (path / "__init__.py", path.with_suffix(".py")):
        if file.is_file():
            return file
    return None


def imported(file, name):
    package = name if file.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(syntax.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                above = package.split(".")[: len(package.split(".")) - node.level + 1]
                base = ".".join([*above, base] if base else above)
            yield base
            # what is imported from a package may be a module of it
            yield from (f"{base}.{alias.name}" for alias in node.names)
