"""How the package hangs together: rooms in an order, doors that say what is inside, old names."""

import ast
import importlib
import itertools
import pickle
import pkgutil
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

import slamlab
from course import architecture
from course.source import ROOT
from slamlab import _renamed
from slamlab.exercises import catalogue
from slamlab.grading import staging
from slamlab.grading.import_closure import imported

ROOMS = list(architecture.told())
PACKAGES = sorted((ROOT / "slamlab").rglob("__init__.py"))
LAZY = [architecture.dotted(p) for p in PACKAGES if "slamlab._lazy" in p.read_text("utf-8")]
FIRST_EDITION = (ROOT / "tests/notebooks/first_edition_imports.txt").read_text().splitlines()
NAMESAKES = {
    "__init__.py",
    "__main__.py",
    "base.py",
    "session.py",
    "driver.py",
    "errors.py",
    "consistency.py",
}
"""The same part of several rooms or devices; a study is called by its command's word."""


def place(package):
    """A package's folder, for people."""
    return package.parent.relative_to(ROOT).as_posix()


def named(package):
    """The modules and packages that a package's docstring names."""
    text = ast.get_docstring(ast.parse(package.read_text("utf-8"))) or ""
    return set(re.findall(r"``(\w+)``", text))


def inside(package):
    """The modules and packages below a package."""
    return {found.name for found in pkgutil.iter_modules([str(package.parent)])}


def named_as_an_offer(old):
    """Whether a module of the first edition is called as a name that its room's door offers."""
    room, _, name = f"slamlab.{old}".rpartition(".")
    return name in getattr(importlib.import_module(room), "__all__", ())


def test_the_help_of_the_package_names_every_room():
    assert set(ROOMS) == set(architecture.modules())


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_only_rooms_that_are_named_before_it(room):
    assert architecture.uses()[room] <= set(ROOMS[: ROOMS.index(room)])


def test_the_picture_is_of_todays_imports():
    assert architecture.mark() in architecture.PICTURE.read_text("utf-8"), (
        "run python -m course.architecture"
    )


# tasks and drives have a module an exercise
OPEN = [p for p in PACKAGES[1:] if p.parent.name not in ("tasks", "drives")]


@pytest.mark.parametrize("package", OPEN, ids=place)
def test_a_room_says_at_its_door_what_is_in_it(package):
    assert inside(package) <= named(package)


def test_no_two_files_share_a_name_but_for_counterparts():
    files = (ROOT / "slamlab").rglob("*.py")
    # a task's module is called by its topic, in the folder of its exercise
    names = Counter(path.name for path in files if path.parents[1].name != "tasks")
    assert {name for name, count in names.items() if count > 1} <= NAMESAKES | {
        path.name for path in (ROOT / "slamlab/exercises/drives").glob("*.py")
    }


@pytest.mark.parametrize("package", PACKAGES, ids=place)
def test_what_a_door_offers_is_there(package):
    room = importlib.import_module(architecture.dotted(package))
    for offered in getattr(room, "__all__", ()):
        assert getattr(room, offered) is not None
        assert offered in dir(room)
    assert vars(room).keys() <= set(dir(room))
    with pytest.raises(AttributeError, match="no attribute 'nothing_of_the_kind'"):
        _ = room.nothing_of_the_kind


@pytest.mark.parametrize("name", LAZY)
def test_a_room_with_a_lazy_door_is_pickled_by_its_name(name):
    room = importlib.import_module(name)
    assert pickle.loads(pickle.dumps(room)) is room


def test_the_package_imports_a_name_from_where_it_is_defined_not_through_a_lazy_door():
    """The import closure, which makes a worker's whitelist, does not see through such a door."""
    offered = {f"{room}.{name}" for room in LAZY for name in importlib.import_module(room).__all__}
    for name, path in itertools.chain(*architecture.modules().values()):
        assert offered.isdisjoint(imported(path, name)), name


@pytest.mark.parametrize("id", catalogue.EXERCISES)
def test_a_worker_takes_no_room_with_a_lazy_door_as_a_whole(id):
    """What would be asked of it, as in ``models.h``, the import closure does not see either."""
    for name, path in staging.worker_modules(catalogue.exercise(id)).items():
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ImportFrom):
                rooms = {f"{node.module}.{alias.name}" for alias in node.names}
                assert rooms.isdisjoint(LAZY), f"{name}, line {node.lineno}"


@pytest.mark.parametrize(
    ("room", "names"),
    [
        ("filters", "MAK, BOR, MCL"),
        ("devices", "RPLidar, Emir"),
        ("scanmatching", "match"),
        ("models", "h, g, J_xr, f_odometry"),
        ("simulation", "RPLIDAR_A2"),
        ("worlds", "World, room"),
        ("estimators", "GraphSlam, make, run"),
    ],
)
def test_what_one_looks_for_is_at_the_door(room, names):
    exec(f"from slamlab.{room} import {names}", {})


@pytest.mark.parametrize("guide", ["docs/architecture.md", "CONTRIBUTING.md"])
def test_a_guide_names_files_that_are_there(guide):
    named = re.findall(r"`([\w/]+\.(?:py|txt))`", (ROOT / guide).read_text("utf-8"))
    named = [name for name in named if "NN" not in name]
    assert named
    for name in named:
        assert (ROOT / name).exists() or (ROOT / "slamlab" / name).exists(), name


@pytest.mark.parametrize("old", [old for old in _renamed.NEW if named_as_an_offer(old)])
def test_no_module_takes_the_place_of_what_a_door_offers(old):
    package, _, leaf = f"slamlab.{old}".rpartition(".")
    importlib.import_module(f"slamlab.{old}")
    assert callable(getattr(importlib.import_module(package), leaf))


def test_help_is_a_page():
    assert 15 < len(slamlab.__doc__.splitlines()) < 50


@pytest.mark.parametrize("line", FIRST_EDITION)
def test_notebooks_of_the_first_edition_import_what_they_did(line):
    exec(line, {})


@pytest.mark.parametrize("old", _renamed.NEW)
def test_an_old_name_is_the_same_module(old):
    new = importlib.import_module(f"slamlab.{_renamed.NEW[old]}")
    assert importlib.import_module(f"slamlab.{old}") is new
    assert new.__name__ == new.__spec__.name == f"slamlab.{_renamed.NEW[old]}"


@pytest.mark.parametrize("id", catalogue.EXERCISES)
def test_an_old_name_opens_nothing_in_a_worker_that_its_exercise_does_not_allow(id, tmp_path):
    exercise = catalogue.exercise(id)
    staging.copy_modules(tmp_path, exercise)
    held = staging.worker_modules(exercise)
    refused = [old for old, new in _renamed.NEW.items() if f"slamlab.{new}" not in held]
    code = (
        "import importlib, slamlab\n"
        f"for name in {refused}:\n"
        "    try:\n        importlib.import_module('slamlab.' + name)\n"
        "    except ModuleNotFoundError:\n        continue\n"
        "    print(name)\n"
        "print(slamlab.__file__)"
    )
    command = [sys.executable, "-c", code]
    shown = subprocess.run(command, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert refused
    assert Path(shown.stdout.strip()) == tmp_path / "slamlab" / "__init__.py"
