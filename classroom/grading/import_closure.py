"""Import closure: all modules that some modules import, directly or indirectly, according to their
sources. The closure is the whitelist of a worker: of this repository, a worker can import only
these modules. Lazy imports (:mod:`slamlab._lazy`) are not followed: modules for workers import each
name from the module that defines it.
"""

import ast
import importlib.util
from pathlib import Path

from classroom import installed_course
from classroom.grading import syntax

STUBBED = "classroom.checks"
"""In a worker, :mod:`classroom.grading.checks_stub` replaces this package."""


def closure(modules, root=None, with_packages=True) -> dict[str, Path]:
    """Return the course's modules that some modules import, also inside functions, as a dict from
    name to file. ``with_packages`` adds the packages that contain these modules. Raises
    ModuleNotFoundError.
    """
    modules = list(modules)
    tops = {*installed_course.own_packages(), *(name.split(".")[0] for name in modules)}
    roots = {top: root or _root(top) for top in tops}
    found, waiting = {}, []
    for name in modules:
        if _file(roots, name) is None:
            raise ModuleNotFoundError(f"{root or 'the course'} has no module {name}")
        waiting.append(name)
    while waiting:
        name = waiting.pop()
        file = _file(roots, name)
        if name in found or file is None:
            continue
        found[name] = file
        if "." in name and with_packages:
            waiting.append(name.rpartition(".")[0])
        if name != STUBBED:
            waiting += imported(file, name)
    return found


def _root(top):
    spec = importlib.util.find_spec(top)
    return Path(spec.origin).resolve().parents[1] if spec and spec.origin else None


def _file(roots, name):
    root = roots.get(name.split(".")[0])
    if root is None:
        return None
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
            # a name imported from a package may be a module
            yield from (f"{base}.{alias.name}" for alias in node.names)
