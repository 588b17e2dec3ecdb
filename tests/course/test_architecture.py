"""The architecture: components in layers, no import upwards, packages that list their modules."""

import ast
import importlib
import itertools
import pickle
import pkgutil
import re
from collections import Counter

import pytest

import slamlab
from classroom.exercises import catalogue
from classroom.grading import staging
from classroom.grading.import_closure import imported
from course import architecture
from course.source import ROOT

COMPONENTS = list(architecture.descriptions())
BELOW = {"slamlab": {"slamlab"}, "classroom": {"slamlab", "classroom"}}
PACKAGES = [
    path for package in BELOW for path in sorted((ROOT / package).rglob("__init__.py"))
]  # fmt: skip
LAZY = [architecture.dotted(p) for p in PACKAGES if "slamlab._lazy" in p.read_text("utf-8")]
NAMESAKES = {"__init__.py", "__main__.py", "base.py", "common.py", "session.py", "driver.py"}
NAMESAKES |= {"errors.py", "consistency.py"}
"""The same part of several components or devices."""


def place(package):
    """A package's folder, as the id of a test."""
    return package.parent.relative_to(ROOT).as_posix()


def named(package):
    """The modules and packages that a package's docstring names."""
    text = ast.get_docstring(ast.parse(package.read_text("utf-8"))) or ""
    return set(re.findall(r"``(\w+)``", text)) | set(re.findall(r"^(\w+) {2,}\S", text, re.M))


def inside(package):
    """The modules and packages below a package that are not private."""
    found = {module.name for module in pkgutil.iter_modules([str(package.parent)])}
    return {name for name in found if not name.startswith("_")}


def test_the_help_of_the_packages_names_every_component():
    assert set(COMPONENTS) == set(architecture.modules())


@pytest.mark.parametrize("component", COMPONENTS)
def test_a_component_imports_only_components_that_are_named_before_it(component):
    assert architecture.uses()[component] <= set(COMPONENTS[: COMPONENTS.index(component)])


@pytest.mark.parametrize("package", BELOW)
def test_a_package_names_no_package_above_it_not_even_in_a_string(package):
    above = set(architecture.PACKAGES) - BELOW[package]
    theirs = {name for modules in architecture.modules().values() for name, _ in modules}
    theirs = {name for name in theirs if name.split(".")[0] in above}
    for path in (ROOT / package).rglob("*.py"):
        tree = ast.parse(path.read_text("utf-8"))
        found = {name.split(".")[0] for name in imported(path, architecture.dotted(path))}
        assert above.isdisjoint(found), path
        strings = [n.value for n in ast.walk(tree) if isinstance(n, ast.Constant)]
        assert theirs.isdisjoint(s for s in strings if isinstance(s, str)), path


def test_the_picture_is_of_todays_imports():
    assert architecture.mark() in architecture.PICTURE.read_text("utf-8"), (
        "run python -m course.architecture"
    )


@pytest.mark.parametrize("package", PACKAGES, ids=place)
def test_a_package_init_lists_its_modules(package):
    assert inside(package) <= named(package)


@pytest.mark.parametrize("package", BELOW)
def test_no_two_files_share_a_name_but_for_counterparts(package):
    names = Counter(path.name for path in (ROOT / package).rglob("*.py"))
    assert {name for name, count in names.items() if count > 1} <= NAMESAKES


@pytest.mark.parametrize("package", PACKAGES, ids=place)
def test_every_offered_name_exists(package):
    module = importlib.import_module(architecture.dotted(package))
    for offered in getattr(module, "__all__", ()):
        assert getattr(module, offered) is not None
        assert offered in dir(module)
    assert vars(module).keys() <= set(dir(module))
    with pytest.raises(AttributeError, match="no attribute 'nothing_of_the_kind'"):
        _ = module.nothing_of_the_kind


@pytest.mark.parametrize("name", LAZY)
def test_a_package_with_lazy_names_is_pickled_by_its_name(name):
    module = importlib.import_module(name)
    assert pickle.loads(pickle.dumps(module)) is module


def test_the_packages_import_a_name_from_its_module_not_through_lazy_names():
    """The import closure, which makes a worker's whitelist, does not resolve lazy names."""
    offered = {f"{lazy}.{n}" for lazy in LAZY for n in importlib.import_module(lazy).__all__}
    for name, path in itertools.chain(*architecture.modules().values()):
        if not name.startswith("course.") or name.endswith(".calls"):
            assert offered.isdisjoint(imported(path, name)), name


@pytest.mark.parametrize("id", catalogue.EXERCISES)
def test_a_worker_takes_no_package_with_lazy_names_as_a_whole(id):
    """The import closure does not resolve attributes such as ``models.h`` either."""
    for name, path in staging.worker_modules(catalogue.exercise(id)).items():
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ImportFrom):
                names = {f"{node.module}.{alias.name}" for alias in node.names}
                assert names.isdisjoint(LAZY), f"{name}, line {node.lineno}"


@pytest.mark.parametrize(
    ("component", "names"),
    [
        ("filters", "MAK, BOR, MCL"),
        ("devices", "RPLidar, Emir"),
        ("scanmatching", "match"),
        ("models", "h, g, J_xr, f_odometry"),
        ("simulation", "RPLIDAR_A2"),
        ("simulation.worlds", "World, room"),
        ("estimators", "GraphSlam, make, run"),
        ("live", "watch, edit_world"),
    ],
)
def test_common_names_are_offered_by_the_package(component, names):
    exec(f"from slamlab.{component} import {names}", {})


@pytest.mark.parametrize("guide", ["docs/architecture.md", "CONTRIBUTING.md"])
def test_a_guide_names_files_that_are_there(guide):
    named = re.findall(r"`([\w/]+\.(?:py|txt))`", (ROOT / guide).read_text("utf-8"))
    named = [name for name in named if "NN" not in name]
    assert named
    for name in named:
        places = [ROOT / name, *(ROOT / package / name for package in architecture.PACKAGES)]
        of_exercises = (ROOT / "course" / "exercises").glob(f"**/{name}")
        assert any(place.exists() for place in places) or any(of_exercises), name


# slamlab held 25 000 before it read the files and lidars of others, and 29 750 before it fetched
# recordings, searched for false loops and optimised graphs at the command line
@pytest.mark.parametrize(("package", "most"), [("slamlab", 29_900), ("classroom", 18_950)])
def test_a_package_stays_small(package, most):
    lengths = {
        path.relative_to(ROOT).as_posix(): path.read_text("utf-8").count("\n")
        for path in (ROOT / package).rglob("*.py")
    }
    assert sum(lengths.values()) <= most
    assert sum(lengths.values()) / len(lengths) < 110
    assert {name: length for name, length in lengths.items() if length > 250} == {}


def test_help_is_a_page():
    assert 15 < len(slamlab.__doc__.splitlines()) < 50
