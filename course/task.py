"""Add a task to an exercise, or try a task.

``python -m course.task new 06 gate`` begins a task with an example that runs; edit its files.
``python -m course.task try 06-gate`` compiles its fingerprints and reports on all its programs.
``python -m course.task lacks 06`` lists the questions and steps that ``hint`` lacks.
"""

import argparse
import sys
import time

import numpy as np

from classroom.exercises import catalogue
from classroom.grading import staging
from course import fingerprints, mutation_testing
from course.answers import AnswerFileError
from course.mistakes import SOLUTION, MistakeFileError
from course.new_task import InvalidTask, begin
from course.source import ROOT
from course.task_programs import ProgramError, programs
from course.task_report import answers_report, explained, lacking

MUTANTS = 40
_ERRORS = ProgramError, MistakeFileError, AnswerFileError


def main(argv=None):
    """Run the command line and return its exit code."""
    parser = argparse.ArgumentParser(prog="python -m course.task", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    new = commands.add_parser("new", help="begin a task with an example that runs")
    new.add_argument("exercise", help="number of the exercise, such as 06")
    new.add_argument("name", help="name of the task, such as gate")
    tried = commands.add_parser("try", help="report on all programs of a task")
    tried.add_argument("task", help="id of the task, such as 06-gate")
    lacks = commands.add_parser("lacks", help="list the questions and steps that hint lacks")
    lacks.add_argument("exercise", nargs="*", help="exercises, such as 06 (default: all)")
    options = parser.parse_args(argv)
    try:
        if options.command == "new":
            catalogue.exercise(options.exercise)
            files = begin(options.exercise.zfill(2), options.name)
            print("Edit", *(file.relative_to(ROOT) for file in files), sep="\n  ")
            print(f"Then: python -m course.task try {options.exercise.zfill(2)}-{options.name}")
            return 0
        if options.command == "lacks":
            for id in options.exercise or catalogue.EXERCISES:
                print(*lacking(catalogue.exercise(id).id), sep="\n")
            return 0
        return _try(options.task)
    except (KeyError, ValueError, InvalidTask, *_ERRORS) as error:
        print(error.args[0], file=sys.stderr)
        return 1


def _try(id):
    catalogue.task(id)
    one = next((found for found in programs(id[:2]) if found.task.id == id), None)
    if one is None:
        raise ValueError(f"{id} has no file mistakes.txt")
    faults = [*_fingerprints(one), *_right(one), *_mutants(one), *_answers(one), *_seal(one)]
    print(*faults, sep="\n", end="\n" if faults else "")
    print("Nothing is wrong." if not faults else f"To mend: {len(faults)}")
    return 1 if faults else 0


def _fingerprints(one):
    print(
        f"compiling fingerprints of exercise {one.exercise.id}, which may take minutes", flush=True
    )
    fingerprints.compile_table(one.exercise.id)
    print(f"mistakes: {len(one.mistakes)}, programs: {sum(len(m.programs) for m in one.mistakes)}")
    for mistake in one.mistakes:
        for k, program in enumerate(mistake.programs, 1):
            found = explained(one, one.source(program)).diagnosis
            if found not in one.names_of(mistake) and not mistake.shaky:
                yield f"  {mistake.name}, program {k}, is recognised as {found}"


def _right(one):
    began = time.perf_counter()
    for name, source in one.ways.items():
        verdict = explained(one, source)
        if name == SOLUTION:
            print(f"a check takes {time.perf_counter() - began:.2f} s of {one.task.call.seconds:g}")
        if not verdict.full:
            lost = [law.name for law in verdict.laws if law.failed]
            yield f"  the right program {name!r} loses points: {verdict.problem or lost}"


def _mutants(one):
    found, tried = mutation_testing.survivors(one, 3, MUTANTS, np.random.default_rng(6))
    alive = [survivor for survivor in found if survivor.differs and not survivor.reason]
    print(f"mutants of the solution: {tried} tried, {tried - len(alive)} killed or equivalent")
    yield from (f"  survives: {each.mutant.text} ({each.differs})" for each in alive)


def _answers(one):
    misjudged, kinds = answers_report(one)
    right = sum(answer.kind == "right" for answer in one.answers)
    learnt = ", ".join(f"{count} {kind}" for kind, count in kinds.most_common()) or "none"
    print(f"independent answers: {right} right; {kinds.total()} wrong: {learnt}")
    for answer, verdict in misjudged:
        yield f"  the {answer.kind} answer {answer.what!r} earns {verdict.points:g} points"


def _seal(one):
    held = staging.worker_modules(one.exercise)
    folder = one.exercise.calls.rpartition(".")[0]
    extra = [name for name in held if name.startswith(f"{folder}.") and name != one.exercise.calls]
    print(f"seal: a worker holds {len(held)} modules, of the exercise only {one.exercise.calls}")
    yield from (f"  a worker can import {name}" for name in extra)


if __name__ == "__main__":
    sys.exit(main())
