"""Threads that parse at once do not disturb each other: the judge has several."""

import ast
import gc
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from course.source import ROOT
from slamlab.contest.sandbox_judging import RemoteEstimator
from slamlab.exercises.drives.student_estimator import GraderFault
from slamlab.grading import syntax
from slamlab.project.driving import drive

SOURCES = [path.read_text("utf-8") for path in sorted((ROOT / "slamlab/grading").glob("*.py"))]


class Litter:
    """What only the collector of garbage removes; meanwhile other threads go on."""

    def __init__(self):
        self.me = self

    def __del__(self):
        time.sleep(0)


def parsed_in_litter(source):
    for _ in range(20):
        Litter()
    return syntax.parse(source)


def test_trees_made_in_many_threads_are_those_of_one():
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
    rooms = [ROOT / "slamlab" / room for room in ("grading", "contest", "project", "reviewing")]
    files = [path for room in rooms for path in room.rglob("*.py") if path.name != "syntax.py"]
    assert len(files) > 50
    assert [p.name for p in files if "ast.parse(" in Path(p).read_text("utf-8")] == []


def test_what_fails_in_the_judge_is_no_fault_of_the_students():
    class Broken:
        def run(self, *_):
            raise SystemError("AST constructor recursion depth mismatch")

    with pytest.raises(GraderFault, match="recursion depth mismatch"):
        drive(lambda: RemoteEstimator(Broken()), [None])
