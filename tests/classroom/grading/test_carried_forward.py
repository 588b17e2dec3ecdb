"""Error carried forward: a wrong function costs points only in its own task."""

import ast

import numpy as np
import pytest

from classroom.exercises import catalogue, references
from classroom.exercises.references import Reference, ReferenceCalls
from classroom.exercises.run_task import run
from classroom.exercises.task import OPEN_SEED
from classroom.grading import staging, worker_client
from course.mistakes import SOLUTION
from course.task_programs import namespace, programs
from tests.classroom.grading import fake
from tests.classroom.grading.test_judge import judged

PROGRAMS = {one.task.id: one for id in catalogue.EXERCISES for one in programs(id)}
PAIRS = [(need, task.id) for id in catalogue.EXERCISES for task in catalogue.exercise(id).tasks
         for need in task.needs]  # fmt: skip
WRONG = "\ndef double(a): return a + 1.5\n"
ASK = """
import sys
def ask(name, *arguments):
    frame = sys._getframe()
    while 'ask' not in frame.f_locals or frame.f_code.co_name != 'serve':
        frame = frame.f_back
    return frame.f_locals['ask'](name, {str(k): np.array(a) for k, a in enumerate(arguments)})
"""


def full_with(task_id, needed, source):
    """Judge the right solution of a task with a mistake in a function that it needs."""
    task, exercise = catalogue.task(task_id), task_id[:2]
    right = catalogue.task(needed).references
    sets = task.draw_inputs(OPEN_SEED)
    return run(task, namespace(exercise, source), sets, right).full


def mistaken(need):
    one = PROGRAMS[need]
    yield from ((m.name, one.source(p)) for m in one.mistakes for p in m.programs)
    yield from ((s.kind, one.source(p)) for s in one.file.stumbles for p in s.programs)


@pytest.mark.parametrize(("need", "task"), PAIRS)
def test_a_right_solution_keeps_full_points_with_a_mistake_in_a_function_that_it_needs(need, task):
    name, source = next(mistaken(need))
    assert full_with(task, need, source), name


@pytest.mark.slow
@pytest.mark.parametrize(("need", "task"), PAIRS)
def test_a_right_solution_keeps_full_points_with_every_mistake(need, task):
    # a function is replaced whatever it computes, so a mistake matters only by its other effects
    lost = [name for name, source in mistaken(need) if not full_with(task, need, source)]
    assert lost == []


def called(source):
    """Names that a program calls and does not define itself."""
    nodes = list(ast.walk(ast.parse(source)))
    own = {n.name for n in nodes if isinstance(n, ast.FunctionDef)}
    own |= {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    calls = (n.func for n in nodes if isinstance(n, ast.Call))
    return {f.id for f in calls if isinstance(f, ast.Name)} - own


@pytest.mark.parametrize("id", PROGRAMS)
def test_a_task_needs_each_earlier_task_whose_function_a_right_program_calls(id):
    one = PROGRAMS[id]
    right = [*one.ways.values(), *(a.source for a in one.answers if a.kind == "right")]
    names = set().union(*map(called, right))
    tasks = one.exercise.tasks
    earlier = {f: task.id for task in tasks[: tasks.index(one.task)] for f in task.call.functions}
    assert {earlier[name] for name in names & set(earlier)} <= set(one.task.needs)


@pytest.mark.parametrize("id", sorted({need for need, _ in PAIRS}))
def test_a_reference_solves_its_task(id):
    one = PROGRAMS[id]
    for seed in (OPEN_SEED, b"another"):
        names = namespace(id[:2], one.ways[SOLUTION])
        assert run(one.task, names, one.task.draw_inputs(seed), one.task.references).full


def test_a_task_is_judged_with_right_functions_in_place_of_wrong_ones_and_this_is_stated():
    result = judged(fake.SOLUTION, WRONG)["verdicts"]
    assert [v.points for v in result] == [1.5, 2.5, 2]
    assert [v.replaced for v in result] == [(), (), ("double",)]
    assert result[2].carried == "tried with a correct double() in place of yours"
    assert [v.replaced for v in judged(fake.SOLUTION)["verdicts"]] == [()] * 3


def test_a_right_function_is_called_as_the_student_calls_theirs_and_fails_as_a_function():
    for call in ("a=x", "[x][0]", "np.float32(x)"):
        cell = f"def total(a): x = a.sum(); return double({call})"
        assert judged(fake.SOLUTION, WRONG, cell)["verdicts"][2].points > 0
    for call in ("", "x, x", "b=x", "{}", "'a'", "x, a=x"):
        cell = f"def total(a): x = a.sum(); return double({call})"
        assert judged(fake.SOLUTION, WRONG, cell)["verdicts"][2].kind == "raised"


ATTACKS = {
    "asks in the function's own task": f"{ASK}\ndef double(a): return ask('double', a)",
    "asks while a cell runs": f"{ASK}\ntry: kept = ask('double', 1.0)\nexcept Exception: pass",
    "asks in a task that does not need it": f"{ASK}\ndef turn(v, angle): return ask('double', v)",
    "asks for another function": f"{ASK}\ndef total(a): return ask('turn', a, 1.0)",
    "asks for a name that is none": f"{ASK}\ndef total(a): return ask(['double'], a)",
    "reads it": "import inspect\ndef total(a): return len(inspect.getsource(double))",
    "looks for it": """
import gc
def total(a):
    found = [o for o in gc.get_objects() if type(o).__name__ == 'Reference']
    return found[0](a.sum())""",
    "imports it": """
def total(a):
    from tests.classroom.grading.fake import EXERCISE
    return 2 * a.sum()""",
    "keeps it": """
kept = []
def turn(v, angle): return kept[0](v)
def total(a):
    kept.append(double)
    return kept[0](None)""",
    "wears it out": """
def total(a):
    while True:
        try: double(a.sum())
        except ValueError: pass""",
    "asks for too much": "def total(a): return double(np.zeros(30_000_000))",
    "sends objects": "def total(a): return double(np.array([object()] * 3))",
}


@pytest.mark.parametrize("name", ATTACKS)
def test_an_attack_on_a_right_function_earns_nothing(name, monkeypatch):
    for module in (references, worker_client):
        monkeypatch.setattr(module, "MAX_CALLS", 100)
    result = judged(fake.SOLUTION, WRONG, ATTACKS[name])["verdicts"]
    assert result[0].points <= 1.5  # the sign, which the wrong function has by itself
    attacked = {"asks in the function's own task": 0, "asks while a cell runs": 0}
    attacked |= {"asks in a task that does not need it": 1, "keeps it": 1}
    k = attacked.get(name, 2)
    assert not result[k].full


def test_a_worker_holds_no_right_function():
    for exercise in (catalogue.exercise(id) for id in catalogue.EXERCISES):
        held = staging.worker_modules(exercise)
        assert not {"classroom.exercises.references", "classroom.exercises.task"} & set(held)


def test_calls_of_a_right_function_are_bounded_and_counted(monkeypatch):
    monkeypatch.setattr(references, "MAX_CALLS", 3)
    calls = ReferenceCalls([Reference("double", "a", lambda i: {"result": 2 * i["a"]})])
    large = {"0": np.zeros(references.MAX_NUMBERS + 1)}
    with pytest.raises(ValueError, match="too many numbers"):
        calls.values("double", large)
    for _ in range(2):
        assert calls.values("double", {"a": np.array(3.0)}) == [6]
    with pytest.raises(ValueError, match="too often"):
        calls.values("double", {"a": np.array(3.0)})
    assert calls.count == 4
