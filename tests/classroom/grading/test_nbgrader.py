"""nbgrader gives the derived exercises the same scores as the judge."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.grading import CONFIG, NAME, derived
from classroom.exercises import catalogue
from classroom.grading import judge, notebooks, submissions
from tests.classroom.grading.conftest import workers


def nbgrader(course, *arguments):
    # nbgrader calls alembic by its bare name
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        [sys.executable, "-m", "nbgrader", *arguments],
        cwd=course,
        env=os.environ | {"PATH": path},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr[-3000:]


def place(course, folder, text):
    target = course / folder / NAME / f"{NAME}.ipynb"
    target.parent.mkdir(parents=True)
    target.write_text(text, encoding="utf-8")
    return target


def one_missing():
    notebook = json.loads(derived("solutions"))
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        cell["source"] = source.replace("def camera(", "def forgotten(")
    return json.dumps(notebook)


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    course = tmp_path_factory.mktemp("course")
    (course / "nbgrader_config.py").write_text(CONFIG)
    place(course, "source", derived("exercises"))
    nbgrader(course, "generate_assignment", NAME)
    texts = {"solved": derived("solutions"), "untouched": derived("exercises")}
    for student, text in (texts | {"forgot": one_missing()}).items():
        place(course, f"submitted/{student}", text)
    nbgrader(course, "autograde", NAME)
    return course


@pytest.mark.slow
@pytest.mark.parametrize("student", ["solved", "untouched", "forgot"])
def test_nbgrader_scores_each_task_as_the_judge_does(course, student):
    from nbgrader.api import Gradebook

    exercise = catalogue.exercise("04")
    file = course / "submitted" / student / NAME / f"{NAME}.ipynb"
    result = judge.judge_notebook(
        exercise, notebooks.parse(file.read_bytes()).cells, b"nbgrader", workers()
    )
    ours = {verdict.task: verdict.points for verdict in result["verdicts"]}
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as gradebook:
        submission = gradebook.find_submission(NAME, student)
        grades = submission.notebooks[0].grades
        theirs = {grade.name: grade.score for grade in grades}
        assert not submission.needs_manual_grade
    assert theirs == ours
    assert sum(ours.values()) == {"solved": 22, "untouched": 0, "forgot": 17}[student]


@pytest.mark.slow
def test_nbgraders_release_of_a_solution_keeps_the_function_heads(tmp_path):
    (tmp_path / "nbgrader_config.py").write_text(CONFIG)
    place(tmp_path, "source", derived("solutions"))
    nbgrader(tmp_path, "generate_assignment", NAME)
    released = json.loads((tmp_path / "release" / NAME / f"{NAME}.ipynb").read_text("utf-8"))
    handed_out = json.loads(derived("exercises"))
    first_lines = [
        [(cell["id"], "".join(cell["source"]).splitlines()[0]) for cell in content["cells"]]
        for content in (released, handed_out)
    ]
    assert first_lines[0] == first_lines[1]


def test_nbgraders_submitted_folder_is_graded(tmp_path):
    for folder in ("source", "release", "submitted/solved", "submitted/untouched"):
        place(tmp_path, folder, "{}")
    for _ in range(2):
        found = submissions.find_submissions(tmp_path)
        assert {s.student for s in found} == {"solved", "untouched"}
        shutil.rmtree(tmp_path / "release", ignore_errors=True)
