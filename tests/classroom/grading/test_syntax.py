"""Threads of the judge can parse at the same time."""

import ast
import gc
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from classroom.contest.sandbox_judging import RemoteEstimator
from classroom.exercises.function_calls.student_estimator import GraderFault
from classroom.grading import syntax
from classroom.project.estimator_runs import run_estimator
from course.source import ROOT

SOURCES = [path.read_text("utf-8") for path in sorted((ROOT / "classroom/grading").glob("*.py"))]


class Litter:
    """An object that only the garbage collector removes, while other threads continue."""

    def __init__(self):
        self.me = self

    def __del__(self):
        time.sleep(0)


def parsed_in_litter(source):
    for _ in range(20):
        Litter()
    return syntax.parse(source)


def test_trees_parsed_in_many_threads_equal_those_of_one_thread():
    switch, threshold = sys.getswitchinterval(), gc.get_threshold()
    sys.setswitchinterval(1e-6)
    gc.set_threshold(50, 2, 2)  # often, also in the middle of a tree
    try:
        with ThreadPoolExecutor(8) as threads:
            made = list(threads.map(parsed_in_litter, SOURCES))
    finally:
        sys.setswitchinterval(switch)
        gc.set_threshold(*threshold)
    assert [ast.dump(tree) for tree in made] == [ast.dump(ast.parse(s)) for s in SOURCES]


def test_no_other_module_of_the_judge_parses_by_itself():
    rooms = [ROOT / "classroom" / room for room in ("grading", "contest", "project", "reviewing")]
    files = [path for room in rooms for path in room.rglob("*.py") if path.name != "syntax.py"]
    assert len(files) > 50
    assert [p.name for p in files if "ast.parse(" in Path(p).read_text("utf-8")] == []


def test_an_error_of_the_judge_is_not_a_students_error():
    class Broken:
        def run(self, *_):
            raise SystemError("AST constructor recursion depth mismatch")

    with pytest.raises(GraderFault, match="recursion depth mismatch"):
        run_estimator(lambda: RemoteEstimator(Broken()), [None])
