"""The course's own exercises: solutions earn everything, what is handed out nothing."""

import ast
import json
import re
from pathlib import Path

import pytest

from classroom.exercises import catalogue
from classroom.exercises.function_calls import changed_arguments
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.grading import judge, notebooks
from course import source as sources
from course.task_programs import programs
from tests.classroom.grading.conftest import workers

ROOT = Path(__file__).resolve().parents[3]
EXERCISES = list(catalogue.EXERCISES)


def judged(folder, exercise, change=lambda cells: cells):
    data = (ROOT / folder / exercise.file).read_bytes()
    notebook = notebooks.parse(data)
    assert notebook.exercise == exercise.id
    return judge.judge_notebook(exercise, change(notebook.cells), b"a seed of the suite", workers())


@pytest.mark.parametrize("id", EXERCISES)
def test_a_solution_earns_full_marks_and_all_its_cells_run_in_a_worker(id):
    result = judged("solutions", catalogue.exercise(id))
    assert [v.task for v in result["verdicts"] if not v.full] == []
    assert result["cells"] == {}


@pytest.mark.parametrize("id", EXERCISES)
def test_what_is_handed_out_earns_nothing_and_all_its_cells_run_in_a_worker(id):
    result = judged("exercises", catalogue.exercise(id))
    assert {v.points for v in result["verdicts"]} == {0}
    assert {v.kind for v in result["verdicts"]} == {"not attempted"}
    assert result["cells"] == {}


@pytest.mark.parametrize("id", EXERCISES)
def test_an_argument_that_is_reported_as_changed_has_the_name_that_it_has_in_the_notebook(id):
    exercise = catalogue.exercise(id)
    cells = notebooks.parse((ROOT / "exercises" / exercise.file).read_bytes()).cells
    defined = [node for _, source in cells for node in ast.walk(ast.parse(source))]
    defined = {node.name: node for node in defined if isinstance(node, ast.FunctionDef)}
    for task in exercise.tasks:
        reported = changed_arguments.ARGUMENT_NAMES.get(task.id) or list(
            task.draw_inputs(b"a seed of the suite")[MAIN]
        )
        for function in set(task.call.functions) & set(defined):
            names = [argument.arg for argument in defined[function].args.args]
            assert names == reported[: len(names)], (task.id, function)


LONG = 300
"""Mutants of a task, at most, where the compiler of fingerprints takes few as a run takes long."""


@pytest.mark.parametrize("id", EXERCISES)
def test_where_a_run_takes_long_the_text_states_when_a_check_stops(id):
    texts, text = {}, ""
    for cell in sources.read(sources.numbered(id, "exercises")).cells:
        text += cell.text if cell.type == "markdown" else ""
        if cell.check:
            texts[cell.check], text = text, ""
    for one in programs(id):
        reported = re.findall(r"check\s+stops\s+after\s+(\d+)\s+s\b", texts[one.task.id])
        limit = [f"{one.task.call.seconds:g}"]
        assert reported in ([], limit), one.task.id
        assert reported or (one.file.mutants or LONG) >= LONG, one.task.id


def without(function):
    def change(cells):
        return [
            (
                number,
                re.sub(rf"^(def|class) {function}\b", rf"\1 not_{function}", source, flags=re.M),
            )
            for number, source in cells
        ]

    return change


def defined_in(id):
    path = ROOT / "solutions" / catalogue.exercise(id).file
    cells = json.loads(path.read_text("utf-8"))["cells"]
    code = "\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "code")
    made = ast.FunctionDef | ast.ClassDef
    return {node.name for node in ast.parse(code).body if isinstance(node, made)}


@pytest.mark.slow
@pytest.mark.parametrize("id", EXERCISES)
def test_one_missing_function_loses_only_its_task_and_is_named(id):
    exercise = catalogue.exercise(id)
    needed = {need for task in exercise.tasks for need in task.needs}
    task = next((t for t in exercise.tasks if t.id in needed), exercise.tasks[0])
    function = task.call.functions[0]
    assert function in defined_in(id)
    verdicts = {v.task: v for v in judged("solutions", exercise, without(function))["verdicts"]}
    for other in exercise.tasks:
        verdict = verdicts[other.id]
        if other is task:
            assert (verdict.points, verdict.problem) == (0, f"{function} is not defined")
        elif task.id in other.needs:
            assert verdict.full and function in verdict.replaced
        elif function not in other.call.functions and not other.needs:
            assert verdict.full
