"""Verdicts of changed solutions: the solution with one change, and its explained verdict."""

from classroom.exercises import catalogue
from classroom.exercises.run_task import run_and_explain
from course.task_programs import SOLUTION, namespace, programs

OF = {one.task.id: one for id in catalogue.EXERCISES for one in programs(id)}
"""Task's id to its programs."""


def explained_verdict(id, source):
    return run_and_explain(OF[id].task, namespace(id[:2], source))


def broken(verdict):
    return {law.name for law in verdict.laws if law.failed}


def edited(id, *pairs, way=SOLUTION):
    source = OF[id].ways[way]
    for find, replace in pairs:
        assert source.count(find) == 1
        source = source.replace(find, replace)
    return source


def changed(id, by):
    """The solution, whose results are changed by some lines before they are returned."""
    name = OF[id].task.call.functions[0]
    source = OF[id].ways[SOLUTION].replace(f"def {name}(", "def _right(")
    return f"{source}\n\ndef {name}(*given):\n    out = _right(*given)\n    {by}\n    return out\n"


def mistake(id, name):
    return next(OF[id].source(one.programs[0]) for one in OF[id].mistakes if one.name == name)
