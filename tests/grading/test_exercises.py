"""The course's own exercises: solutions earn everything, what is handed out nothing."""

import ast
import json
import re
from pathlib import Path

import numpy as np
import pytest

from course import source as sources
from course.programs import programs
from slamlab.exercises import catalogue
from slamlab.exercises.drives import arguments
from slamlab.exercises.drives.input_sets import MAIN
from slamlab.exercises.outputs import MAX_MAGNITUDE, MAX_ROWS, shapes_of
from slamlab.grading import judge, notebooks
from tests.grading.conftest import workers

ROOT = Path(__file__).resolve().parents[2]
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
    assert {v.kind for v in result["verdicts"]} <= {"not attempted", "needs"}
    assert result["cells"] == {}


@pytest.mark.parametrize("id", EXERCISES)
def test_an_argument_that_is_told_as_changed_has_the_name_that_it_has_in_the_notebook(id):
    exercise = catalogue.exercise(id)
    cells = notebooks.parse((ROOT / "exercises" / exercise.file).read_bytes()).cells
    defined = [node for _, source in cells for node in ast.walk(ast.parse(source))]
    defined = {node.name: node for node in defined if isinstance(node, ast.FunctionDef)}
    for task in exercise.tasks:
        told = arguments.NAMES.get(task.id) or list(task.draw(b"a seed of the suite")[MAIN])
        for function in set(task.drive.functions) & set(defined):
            names = [argument.arg for argument in defined[function].args.args]
            assert names == told[: len(names)], (task.id, function)


LONG = 300
"""Mutants of a task, at most, where the compiler of fingerprints takes few as a run takes long."""


@pytest.mark.parametrize("id", EXERCISES)
def test_where_a_run_takes_long_the_text_tells_when_a_check_stops(id):
    texts, text = {}, ""
    for cell in sources.read(next((ROOT / "course" / "exercises").glob(f"{id}_*.py"))).cells:
        text += cell.text if cell.type == "markdown" else ""
        if cell.check:
            texts[cell.check], text = text, ""
    for one in programs(id):
        told = re.findall(r"check\s+stops\s+after\s+(\d+)\s+s\b", texts[one.task.id])
        limit = [f"{one.task.drive.seconds:g}"]
        assert told in ([], limit), one.task.id
        assert told or getattr(one.module, "MUTANTS", LONG) >= LONG, one.task.id


CONSTANTS = [0.0, 1.0, -1.0, 5e-324, 1e3, -1e6, MAX_MAGNITUDE, -MAX_MAGNITUDE]


@pytest.mark.parametrize("id", EXERCISES)
@pytest.mark.parametrize("rows", [0, 1, MAX_ROWS])
def test_the_same_number_everywhere_solves_no_task(id, rows):
    for task in catalogue.exercise(id).tasks:
        sets = task.draw(b"a seed of the suite")
        inputs = sets[MAIN]
        count = min(len(array) for array in inputs.values())
        for constant in CONSTANTS:
            outputs = {}
            for name, shape in shapes_of(task, inputs).items():
                several = sum(size is None for size in shape)
                most = rows if several == 1 else min(rows, 30)
                shape = [most if size is None else size for size in shape]
                outputs[name] = np.full((count, *shape) if name == "result" else shape, constant)
            assert not task.judge(sets, {MAIN: outputs}).full, (task.id, constant)


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


@pytest.mark.parametrize("id", EXERCISES)
def test_one_missing_function_loses_its_task_and_those_that_need_it_and_is_named(id):
    exercise = catalogue.exercise(id)
    needed = {need for task in exercise.tasks for need in task.needs}
    task = next((t for t in exercise.tasks if t.id in needed), exercise.tasks[0])
    function = task.drive.functions[0]
    assert function in defined_in(id)
    verdicts = {v.task: v for v in judged("solutions", exercise, without(function))["verdicts"]}
    for other in exercise.tasks:
        verdict = verdicts[other.id]
        if other is task:
            assert (verdict.points, verdict.problem) == (0, f"{function} is not defined")
        elif task.id in other.needs:
            assert (verdict.points, verdict.kind) == (0, "needs")
            assert task.id in verdict.problem
        elif function not in other.drive.functions and not other.needs:
            assert verdict.full
