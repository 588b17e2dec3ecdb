"""If only the library is installed, test modules that need more are skipped with a message."""

import ast
import importlib
import importlib.util
from pathlib import Path

import pytest

from slamlab.extras import ExtraMissing

ROOT = Path(__file__).resolve().parents[2]


def missing(path):
    """The packages that a file needs, itself or through the library or other files of the tests,
    and that are not there."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names = {a.name for node in ast.walk(tree) if isinstance(node, ast.Import) for a in node.names}
    names |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    tops = {name.split(".")[0] for name in names if name}
    found = {top for top in tops if importlib.util.find_spec(top) is None}
    for name in (name for name in names if name and name.startswith("tests.")):
        file = ROOT.joinpath(*name.split(".")).with_suffix(".py")
        found.update(missing(file) if file.is_file() else ())
    for name in (name for name in names if name and name.startswith("slamlab.")):
        try:
            importlib.import_module(name)
        except ExtraMissing as error:
            found.add(error.name)
        except ImportError:  # the test itself reports the error
            continue
    return sorted(found)


class _Skipped(pytest.Module):
    def collect(self):
        pytest.skip(f"needs {', '.join(missing(self.path))}", allow_module_level=True)


def pytest_pycollect_makemodule(module_path, parent):
    return _Skipped.from_parent(parent, path=module_path) if missing(module_path) else None
