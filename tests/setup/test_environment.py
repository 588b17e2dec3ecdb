"""What is declared in pyproject.toml, in environment.yml and in the two locks is one thing."""

import ast
import re
import subprocess
import sys
import tomllib
from functools import cache
from importlib.metadata import packages_distributions, requires

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from lab import LECTURE
from tests.setup import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
DECLARED = PROJECT["project"]["dependencies"]
EXTRAS = PROJECT["project"]["optional-dependencies"]
BUILD = PROJECT["build-system"]["requires"]
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
    return {
        canonicalize_name(each.name): each.specifier
        for each in parsed
        if machine is None or on(machine, each)
    }


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
    assert "-e ." in pip
    from_pip = specifiers(entry for entry in pip if entry != "-e .")
    assert not named.keys() & from_pip.keys()
    assert named | from_pip == specifiers(DECLARED)
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
    assert not unmet(specifiers(DECLARED + BUILD), student)
    everything = [requirement for extra in EXTRAS.values() for requirement in extra]
    declared = specifiers(DECLARED + BUILD + everything, a_machine(python, platform))
    assert not unmet(declared, tests)
    assert student.items() <= tests.items()


def test_students_do_not_get_what_only_tests_lectures_and_benchmarks_need():
    locked = {canonicalize_name(requirement.name) for requirement, _ in entries(STUDENT)}
    # what JupyterLab itself brings along is no tool of ours
    shared = {"nbclient", "pyyaml", "requests"}
    extras = {name for extra in EXTRAS.values() for name in specifiers(extra)}
    assert {"nbgrader", "pytest", "playwright"} <= extras
    assert locked & extras <= shared


def test_lectures_need_nothing_that_lab_does_not_install_for_lecturers():
    known = {canonicalize_name(requirement.name) for requirement, _ in entries(STUDENT)}
    for name in LECTURE:
        needed = [Requirement(text) for text in requires(name) or []]
        always = [r for r in needed if r.marker is None or r.marker.evaluate({"extra": ""})]
        assert {canonicalize_name(r.name) for r in always} <= known | set(LECTURE)


@pytest.mark.slow
def test_the_package_imports_only_what_it_declares():
    distributions = packages_distributions()
    # what an extra holds is imported when it is asked for
    extras = [
        name for extra in ("dask", "ros", "nbgrader", "lecture", "lti") for name in EXTRAS[extra]
    ]
    declared = specifiers(DECLARED + extras).keys()
    for path in (ROOT / "slamlab").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and not node.level:
                names = [node.module]
            for name in {name.split(".")[0] for name in names} - sys.stdlib_module_names:
                origin = {canonicalize_name(found) for found in distributions.get(name, [])}
                assert name == "slamlab" or origin & declared, f"{path.name} imports {name}"


def test_importing_the_package_loads_no_library_of_drawing_algebra_or_filtering():
    code = "import sys, slamlab; print(*sorted({name.split('.')[0] for name in sys.modules}))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert "slamlab" in loaded
    assert not loaded & {"matplotlib", "sympy", "filterpy", "scipy"}
