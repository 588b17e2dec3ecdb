"""pyproject.toml, environment.yml and the two locks declare the same packages."""

import ast
import itertools
import re
import sys
import tomllib
from functools import cache
from importlib.metadata import packages_distributions, requires

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import slamlab
from lab import LECTURE
from tests.course.setup import ROOT

PROJECT, LIBRARY = (
    tomllib.loads((ROOT / folder / "pyproject.toml").read_text(encoding="utf-8"))
    for folder in (".", "slamlab")
)
OURS = LIBRARY["project"]["name"]
EXTRAS = PROJECT["project"]["optional-dependencies"]
LIBRARY_EXTRAS = LIBRARY["project"]["optional-dependencies"]
BUILD = PROJECT["build-system"]["requires"]


def with_library(requirements):
    """Requirements with those of the library, and of its extras, in its place."""
    found = []
    for text in requirements:
        requirement = Requirement(text)
        if requirement.name == OURS:
            found += LIBRARY["project"]["dependencies"]
            found += [each for extra in requirement.extras for each in LIBRARY_EXTRAS[extra]]
        else:
            found.append(text)
    return found


DECLARED = with_library(PROJECT["project"]["dependencies"])
LAB = DECLARED + EXTRAS["grading"]  # what make lab installs
STUDENT, TEST = "requirements.lock", "requirements-test.lock"
CONDA_NAMES = {"matplotlib-base": "matplotlib"}
PLATFORMS = [
    {"sys_platform": "linux", "os_name": "posix", "platform_system": "Linux"},
    {"sys_platform": "darwin", "os_name": "posix", "platform_system": "Darwin"},
    {"sys_platform": "win32", "os_name": "nt", "platform_system": "Windows"},
]
PYTHONS = ["3.11.0", "3.11.9", "3.12.1", "3.13.0"]


def specifiers(requirements, machine=None):
    """The version specifiers of requirements, by canonical name; those that a machine has."""
    parsed = [Requirement(text) for text in requirements]
    wanted = [each for each in parsed if machine is None or on(machine, each)]
    return {canonicalize_name(each.name): each.specifier for each in wanted}


def on(machine, requirement):
    """Whether a requirement is one on that machine."""
    return requirement.marker is None or requirement.marker.evaluate(machine)


@cache
def entries(lock):
    """The entries of a lock: requirements with their hashes."""
    joined = (ROOT / lock).read_text(encoding="utf-8").replace("\\\n", " ")
    split = [line.split(" --hash=") for line in joined.splitlines()]
    return [(Requirement(head.strip()), hashes) for head, *hashes in split]


def a_machine(python, platform):
    """What markers ask of a machine."""
    short = ".".join(python.split(".")[:2])
    return {**platform, "python_full_version": python, "python_version": short}


def versions(lock, python, platform):
    """What a lock installs on one Python and one platform: versions by name."""
    machine, found = a_machine(python, platform), {}
    for requirement, _ in entries(lock):
        if on(machine, requirement):
            name = canonicalize_name(requirement.name)
            assert name not in found, f"{name} twice on {machine}"
            (pin,) = requirement.specifier
            found[name] = pin.version
    return found


def unmet(wanted, found):
    """The names whose locked version is missing or outside what is asked for."""
    return [n for n, allowed in wanted.items() if n not in found or found[n] not in allowed]


def test_conda_gets_the_dependencies_that_pip_gets():
    listed = yaml.safe_load((ROOT / "environment.yml").read_text(encoding="utf-8"))["dependencies"]
    (pip,) = [entry["pip"] for entry in listed if isinstance(entry, dict)]
    python, *others = [entry for entry in listed if isinstance(entry, str) and entry != "pip"]
    conda = specifiers(others)
    named = {CONDA_NAMES.get(name, name): allowed for name, allowed in conda.items()}
    assert pip[-2:] == ["-e ./slamlab", "-e ."]
    from_pip = specifiers(pip[:-2])
    assert not named.keys() & from_pip.keys()
    assert named | from_pip == specifiers(LAB)
    # as Binder reads it: repo2docker/buildpacks/conda, PYTHON_REGEX
    version = re.fullmatch(r"python=(\d+\.\d+)", python)[1]
    assert f"{version}.0" in PYTHONS
    assert version in Requirement("python" + PROJECT["project"]["requires-python"]).specifier


@pytest.mark.parametrize("lock", [STUDENT, TEST])
def test_a_lock_pins_and_hashes_every_package_and_names_no_address(lock):
    text = (ROOT / lock).read_text(encoding="utf-8")
    assert "://" not in text and "index" not in text and "@" not in text
    assert len(entries(lock)) > 50
    for requirement, hashes in entries(lock):
        assert [pin.operator for pin in requirement.specifier] == ["=="], requirement
        assert hashes and all(re.fullmatch(r"sha256:[0-9a-f]{64}\s*", h) for h in hashes)


@pytest.mark.parametrize("platform", PLATFORMS, ids=lambda platform: platform["sys_platform"])
@pytest.mark.parametrize("python", PYTHONS)
def test_the_locks_hold_what_is_declared_and_agree(python, platform):
    student, tests = versions(STUDENT, python, platform), versions(TEST, python, platform)
    assert not unmet(specifiers(LAB + BUILD), student)
    everything = with_library(each for extra in EXTRAS.values() for each in extra)
    everything += [each for extra in LIBRARY_EXTRAS.values() for each in extra]
    declared = specifiers(DECLARED + BUILD + everything, a_machine(python, platform))
    assert not unmet(declared, tests)
    assert student.items() <= tests.items()


def test_students_do_not_get_what_only_tests_lectures_and_benchmarks_need():
    locked = {canonicalize_name(requirement.name) for requirement, _ in entries(STUDENT)}
    # what JupyterLab itself brings along is no tool of ours
    shared = {"nbclient", "pyyaml", "requests"}
    others = [extra for title, extra in EXTRAS.items() if title != "grading"]
    extras = specifiers(with_library(itertools.chain(*others))).keys() - specifiers(DECLARED).keys()
    assert {"nbgrader", "pytest", "playwright"} <= extras
    assert locked & extras <= shared


def test_lectures_need_nothing_that_lab_does_not_install_for_lecturers():
    known = {canonicalize_name(requirement.name) for requirement, _ in entries(STUDENT)}
    for name in LECTURE:
        needed = [Requirement(text) for text in requires(name) or []]
        always = [r for r in needed if r.marker is None or r.marker.evaluate({"extra": ""})]
        assert {canonicalize_name(r.name) for r in always} <= known | set(LECTURE)


def test_one_version_of_both_distributions():
    assert PROJECT["project"]["version"] == LIBRARY["project"]["version"] == slamlab.__version__
    assert any(r.endswith(f"=={slamlab.__version__}") for r in PROJECT["project"]["dependencies"])


@pytest.mark.slow
@pytest.mark.parametrize("package", ["slamlab", "classroom"])
def test_a_package_imports_only_what_it_declares(package):
    distributions = packages_distributions()
    # what an extra holds is imported when it is asked for
    if package == "slamlab":
        wanted, extras = LIBRARY["project"]["dependencies"], LIBRARY_EXTRAS.values()
        ours = {"slamlab"}
    else:
        wanted = DECLARED
        extras = [EXTRAS[extra] for extra in ("grading", "nbgrader", "lecture", "lti")]
        ours = {"slamlab", "classroom"}
    declared = specifiers([*wanted, *itertools.chain(*extras)]).keys()
    for path in (ROOT / package).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and not node.level:
                names = [node.module]
            for name in {name.split(".")[0] for name in names} - sys.stdlib_module_names:
                origin = {canonicalize_name(found) for found in distributions.get(name, [])}
                assert name in ours or origin & declared, f"{path.name} imports {name}"
