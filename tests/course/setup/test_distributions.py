"""The library installs alone, stays small and works; the course adds its commands to it."""

import json
import os
import re
import shutil
import subprocess
import sys
import venv

import pytest

from tests.course.setup import ROOT
from tests.course.setup.test_environment import TEST, a_machine, entries, on

pytestmark = pytest.mark.slow
MOST_DISTRIBUTIONS = 20
NOT_COUNTED = {"pip", "setuptools"}
HEAVY = {"numpy", "scipy", "matplotlib", "sympy", "IPython", "ipywidgets", "tornado", "filterpy"}
OWN = {"run", "live", "film", "convert", "optimise", "emulate", "record", "replay", "data"}
OWN |= {"completion"}
OF_THE_CLASS = {"check", "collect", "progress", "reset", "update", "rehearse", "handout"}
OF_THE_CLASS |= {"grade", "contest"}


class Environment:
    """An empty environment, in which versions are those of the lock, and nothing of the clone."""

    def __init__(self, folder):
        self.folder = folder / "alone"
        venv.EnvBuilder(with_pip=True, symlinks=os.name != "nt").create(folder / "venv")
        self._programs = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
        self._constraints = folder / "constraints.txt"
        here = a_machine(".".join(map(str, sys.version_info[:3])), {"sys_platform": sys.platform})
        pins = [f"{r.name}{r.specifier}" for r, _ in entries(TEST) if on(here, r)]
        self._constraints.write_text("\n".join(pins))
        self.folder.mkdir()

    def run(self, *words, **more):
        """Run a program of the environment in an empty folder; what it printed."""
        leaks = ("PYTHONPATH", "VIRTUAL_ENV", "PYTEST", "COV")
        kept = {k: v for k, v in os.environ.items() if not k.startswith(leaks)}
        program = self._programs / words[0]
        done = subprocess.run(
            [program, *map(str, words[1:])],
            **{"cwd": self.folder, "env": kept, "capture_output": True, "text": True, **more},
        )
        assert done.returncode == 0, f"{words}: {done.stdout[-3000:]}{done.stderr[-3000:]}"
        return done.stdout

    def install(self, *what):
        self.run("python", "-m", "pip", "install", "-q", "-c", self._constraints, *what)

    def commands(self):
        """The commands that the help lists."""
        return set(re.findall(r"^  (\w+) {2,}\w", self.run("slamlab", "--help"), re.MULTILINE))


@pytest.fixture(scope="module")
def wheels(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheels")
    for project in ("slamlab", "."):
        command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation"]
        subprocess.run([*command, "-w", folder, ROOT / project], check=True)
    library, course = sorted(folder.glob("*.whl"), key=lambda path: "_lab" not in path.name)
    return library, course


@pytest.fixture(scope="module")
def alone(wheels, tmp_path_factory):
    """An environment with the library and what it needs."""
    made = Environment(tmp_path_factory.mktemp("environment"))
    made.install(wheels[0])
    return made


def test_the_library_brings_few_distributions(alone):
    listed = json.loads(alone.run("python", "-m", "pip", "list", "--format", "json"))
    names = {each["name"] for each in listed} - NOT_COUNTED
    assert "slam-course-lab" in names
    assert len(names) <= MOST_DISTRIBUTIONS, sorted(names)


def test_importing_it_loads_nothing_heavy(alone):
    code = "import sys, slamlab; print(*{name.split('.')[0] for name in sys.modules})"
    loaded = set(alone.run("python", "-c", code).split())
    assert "slamlab" in loaded and not HEAVY & loaded


def test_it_maps_a_log(alone):
    alone.run("slamlab", "convert", "sim:room", "room.readings")
    alone.run("slamlab", "run", "room.readings", "--out", "out", "--tum", "room.tum")
    summary = json.loads((alone.folder / "out" / "summary.json").read_text())
    assert summary["frames"] > 10 and summary["skipped"] == 0
    assert (alone.folder / "out" / "map.png").stat().st_size > 5000
    assert len((alone.folder / "room.tum").read_text().splitlines()) == summary["frames"]


def test_its_tests_pass_with_pytest_alone(alone):
    """The examples of the guides are among them, as they stand on the page."""
    alone.install("pytest")
    copy = alone.folder / "copy"
    for path in ("tests/slamlab", "docs", "tests/__init__.py", "tests/conftest.py",
                 "tests/timeouts.py", "tests/property_testing.py", "README.md", "pyproject.toml",
                 "slamlab/README.md", "slamlab/pyproject.toml"):  # fmt: skip
        (copy / path).parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (ROOT / path).is_dir() else shutil.copy)(ROOT / path, copy / path)
    reported = alone.run(
        *("python", "-m", "pytest", "-q", "-m", "not slow and not walk and not soak"),
        "tests/slamlab",
        cwd=copy,
    )
    passed = int(re.search(r"(\d+) passed", reported)[1])
    assert passed > 300
    assert "test_examples" not in reported, "skipped or failed"


def test_the_course_adds_its_commands_to_those_of_the_library(alone, wheels):
    assert alone.commands() == OWN
    alone.install("--no-deps", wheels[1])
    assert alone.commands() == OWN | OF_THE_CLASS
