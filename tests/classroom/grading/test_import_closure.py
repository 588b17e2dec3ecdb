"""A worker can import what its exercise allows, but neither its answers nor the judge."""

import pkgutil

import pytest

from classroom import exercises, installed_course
from classroom.exercises import catalogue
from classroom.grading import staging
from classroom.grading.import_closure import closure

JUDGE = (
    *(
        f"classroom.exercises.{name}"
        for name in (
            "failing_case_text", "failing_cases", "catalogue", "exercise", "mistake_families",
            "unrecognised_mistakes", "fingerprints", "correctness_laws", "outputs", "run_task",
            "case_presentation", "verdict_text", "task", "time_limit", "verdict", "references",
        )
    ),
    "classroom.checks.hint_levels", "classroom.grading.judge", "classroom.grading.worker_client",
    "classroom.grading.records", "slamlab.models.symbolic",
)  # fmt: skip
EXERCISES = list(catalogue.EXERCISES)


def write(root, **files):
    for name, text in files.items():
        path = root.joinpath(*name.split("__"))
        path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def test_the_closure_has_imports_in_functions_relative_imports_and_parents_only(tmp_path):
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
    modules = "lab lab.room lab.room.door lab.room.window lab.shared lab.late lab.deep"
    assert set(closure(["lab.room.door"], tmp_path)) == set(modules.split())
    with pytest.raises(ModuleNotFoundError, match=r"no module lab\.none"):
        closure(["lab.none"], tmp_path)


def within(name, packages):
    return any(name == package or name.startswith(package + ".") for package in packages)


@pytest.mark.parametrize("id", EXERCISES)
def test_a_worker_has_no_answers_and_no_module_of_the_judge(id):
    exercise = catalogue.exercise(id)
    assert exercise.answers
    held = staging.worker_modules(exercise)
    assert [name for name in held if within(name, (*exercise.answers, *JUDGE))] == []
    folder = exercise.calls.rpartition(".")[0]
    course = {name for name in held if within(name, ["course.exercises"])}
    assert course == {"course.exercises", folder, exercise.calls}
    assert {"classroom.checks", exercise.calls, *exercise.allows} <= set(held)
    assert {name.partition(".")[0] for name in held} == {*installed_course.own_packages()}
    assert {file.suffix for file in held.values()} == {".py"}


def test_no_module_that_judges_exercises_is_in_a_worker():
    """Whatever is added beside the tasks is the judge's, except for the function calls."""
    rooms = {
        f"classroom.exercises.{found.name}" for found in pkgutil.iter_modules(exercises.__path__)
    }
    assert rooms - {"classroom.exercises.function_calls"} <= set(JUDGE)
    assert closure(JUDGE)


@pytest.mark.parametrize("id", EXERCISES)
def test_answers_and_function_calls_are_existing_modules_and_each_task_has_one(id):
    exercise = catalogue.exercise(id)
    assert closure(exercise.answers)
    for task in exercise.tasks:
        assert task.id.startswith(f"{id}-")
        assert exercise.calls.split(".")[2].startswith(f"ex{id}_")
        assert task.call is __import__(exercise.calls, fromlist=["CALLS"]).CALLS[task.id]
