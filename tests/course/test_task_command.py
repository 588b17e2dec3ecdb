"""A new task begins as an example that runs, and a task is tried with one command."""

import os
import re
import shutil
import subprocess
import sys

import pytest

from course.source import ROOT


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of the packages, in which tasks can be added."""
    folder = tmp_path_factory.mktemp("course")
    for name in ("course", "classroom", "slamlab"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def run(copy, *arguments):
    return subprocess.run(
        [sys.executable, "-m", "course.task", *arguments],
        cwd=copy,
        env=os.environ | {"PYTHONPATH": str(copy)},
        capture_output=True,
        text=True,
    )


@pytest.mark.slow
def test_a_task_that_was_begun_runs_and_nothing_is_wrong_with_it(copy):
    begun = run(copy, "new", "1", "length-of-a-step")
    assert (begun.returncode, begun.stderr) == (0, "")
    for line in begun.stdout.splitlines()[1:-1]:
        assert (copy / line.strip()).is_file()
    again = run(copy, "new", "01", "length-of-a-step")
    assert again.returncode == 1 and "01-length-of-a-step already exists" in again.stderr

    tried = run(copy, "try", "01-length-of-a-step")
    assert tried.stdout.splitlines()[-1] == "Nothing is wrong.", tried.stdout + tried.stderr
    assert "mistakes: 1, programs: 1" in tried.stdout
    assert "independent answers: 1 right; 1 wrong" in tried.stdout

    mistakes = next((copy / "course" / "exercises").glob("ex01_*/length_of_a_step/mistakes.txt"))
    mistakes.write_text(mistakes.read_text().replace("- np.hypot(", "- np.sqrt("))
    wrong = run(copy, "try", "01-length-of-a-step")
    assert wrong.returncode == 1 and "Traceback" not in wrong.stderr
    assert "01-length-of-a-step: 'np.sqrt(step[0], step[1])' occurs 0 times" in wrong.stderr


def test_a_task_that_was_begun_follows_the_style(copy):
    assert run(copy, "new", "16", "a-gate").returncode == 0
    folder = next((copy / "course" / "exercises").glob("ex16_*"))
    headings = re.findall(r"^# ## (.*)", (folder / "notebook.py").read_text("utf-8"), re.M)
    assert "5 · …" in headings and any(heading.startswith("4 · ") for heading in headings)
    for check in (["check"], ["format", "--check"]):
        ruff = [sys.executable, "-m", "ruff", *check, "--config", ROOT / "pyproject.toml", folder]
        done = subprocess.run(ruff, cwd=copy, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("arguments", [("try", "01-none"), ("new", "99", "gate"), ("try", "none")])
def test_an_unknown_exercise_or_task_is_reported(arguments):
    done = run(ROOT, *arguments)
    assert done.returncode == 1 and done.stderr.startswith("no ") and "Traceback" not in done.stderr
