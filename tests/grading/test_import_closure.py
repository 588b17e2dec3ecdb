"""A worker holds what its exercise allows, and neither its answers nor the judge."""

import pkgutil

import pytest

from slamlab import exercises
from slamlab.exercises import catalogue
from slamlab.grading import staging
from slamlab.grading.import_closure import closure

JUDGE = (
    "slamlab.exercises.case_text",
    "slamlab.exercises.cases",
    "slamlab.exercises.catalogue",
    "slamlab.exercises.exercise",
    "slamlab.exercises.families",
    "slamlab.exercises.clues",
    "slamlab.exercises.fingerprints",
    "slamlab.exercises.law",
    "slamlab.exercises.outputs",
    "slamlab.exercises.reading",
    "slamlab.exercises.report",
    "slamlab.exercises.run_task",
    "slamlab.exercises.task",
    "slamlab.exercises.tasks",
    "slamlab.exercises.time_limit",
    "slamlab.exercises.verdict",
    "slamlab.checks.ladder",
    "slamlab.grading.judge",
    "slamlab.grading.worker_client",
    "slamlab.grading.records",
    "slamlab.models.symbolic",
)
EXERCISES = list(catalogue.EXERCISES)


def write(root, **files):
    for name, text in files.items():
        path = root.joinpath(*name.split("__"))
        path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def test_imports_in_functions_relative_ones_and_parents_count_and_other_libraries_do_not(tmp_path):
    (tmp_path / "lab" / "room").mkdir(parents=True)
    write(
        tmp_path,
        lab="",
        lab__room="from lab import shared\n",
        lab__room__door="import numpy\ndef f():\n    import lab.late\n    from . import window\n",
        lab__room__window="from ..deep import thing\n",
        lab__shared="VALUE = 1\n",
        lab__late="",
        lab__deep="thing = 1\n",
        lab__unseen="",
        numpy="",
    )
    assert set(closure(["lab.room.door"], tmp_path)) == {
        "lab",
        "lab.room",
        "lab.room.door",
        "lab.room.window",
        "lab.shared",
        "lab.late",
        "lab.deep",
    }


def test_a_module_that_is_none_is_an_error(tmp_path):
    with pytest.raises(ModuleNotFoundError, match=r"no module lab\.none"):
        closure(["lab.none"], tmp_path)


def within(name, packages):
    return any(name == package or name.startswith(package + ".") for package in packages)


@pytest.mark.parametrize("id", EXERCISES)
def test_a_worker_holds_no_answer_and_nothing_of_the_judge(id):
    exercise = catalogue.exercise(id)
    assert exercise.answers
    held = staging.worker_modules(exercise)
    assert [name for name in held if within(name, (*exercise.answers, *JUDGE))] == []
    assert {"slamlab.checks", exercise.drives, *exercise.allows} <= set(held)
    assert {name.partition(".")[0] for name in held} == {"slamlab"}
    assert {file.suffix for file in held.values()} == {".py"}


def test_the_judges_modules_of_the_exercises_are_all_held_back():
    """Whatever is added beside the tasks is the judge's, but for the drives."""
    rooms = {
        f"slamlab.exercises.{found.name}" for found in pkgutil.iter_modules(exercises.__path__)
    }
    assert rooms - {"slamlab.exercises.drives"} <= set(JUDGE)
    assert closure(JUDGE)


@pytest.mark.parametrize("id", EXERCISES)
def test_answers_and_drives_are_modules_there_are_and_each_task_has_its_drive(id):
    exercise = catalogue.exercise(id)
    assert closure(exercise.answers)
    for task in exercise.tasks:
        assert task.id.startswith(f"{id}-")
        assert exercise.drives.endswith(f"ex{id}")
        assert task.drive is __import__(exercise.drives, fromlist=["DRIVES"]).DRIVES[task.id]
