"""Mutation testing of the tasks' laws: ``python -m course.mutation_testing 06``.

The command creates all small changes (mutants) of all right programs. A mutant that still receives
full marks survives and is listed with an input for which its outputs differ from those of the right
program. Either a probe is missing, or the mutant is also right: list it in ``mistakes.txt`` below
``## equivalent``, with the reason. A mutant whose outputs equal those of the right
program for all drawn inputs is equivalent.
"""

import argparse
import os
import sys
from collections import Counter
from dataclasses import dataclass

import numpy as np

from classroom.exercises import catalogue
from classroom.exercises.fingerprints import parts_of
from classroom.exercises.function_calls import StudentError
from classroom.exercises.outputs import checked_outputs
from classroom.exercises.task import OPEN_SEED
from classroom.exercises.time_limit import TimeLimitExceeded, time_limit
from course.fingerprints import MUTANT_SECONDS
from course.mutation_operators import Mutant, mutants
from course.task_programs import SOLUTION, Programs, namespace, programs

AGREE = 1e-9  # tolerance of equivalent programs, relative to 1 + |number|
SEEDS = 5  # number of seeds with which a survivor must keep full marks


@dataclass(frozen=True)
class Survivor:
    """A mutant that still receives full marks.

    Parameters
    ----------
    mutant : Mutant
    way : str, the right program it was made of
    differs : str or None, where its outputs differ; None if it is equivalent
    reason : str or None, why it is right as well, from ``mistakes.txt``
    """

    mutant: Mutant
    way: str
    differs: str | None
    reason: str | None


def survives(one: Programs, source, seeds=SEEDS) -> bool:
    """Return whether a program receives full marks with the open seed and several other seeds.

    The program runs in a separate process if the system can fork, because NumPy may crash Python
    after a failed matrix product of objects.
    """
    if not hasattr(os, "fork"):
        return _keeps_full_marks(one, source, seeds)
    child = os.fork()
    if child == 0:
        code = 1
        try:
            code = 0 if _keeps_full_marks(one, source, seeds) else 1
        finally:
            os._exit(code)
    return os.waitpid(child, 0)[1] == 0


def _keeps_full_marks(one, source, seeds):
    for seed in [OPEN_SEED, *(b"mutants %d" % k for k in range(1, seeds))]:
        try:
            with time_limit(MUTANT_SECONDS, cpu=True):
                if not one.verdict(source, seed).full:
                    return False
        except (TimeLimitExceeded, Exception):
            return False
    return True


def difference(one: Programs, source, way, draws) -> str | None:
    """Find the first difference between the outputs of two programs for several draws of inputs and
    the probes.

    Parameters
    ----------
    one : Programs
    source, way : str, two programs
    draws : int

    Returns
    -------
    str, or None if they agree to 1e-9 everywhere
    """
    for k in range(draws):
        sets = one.task.draw_inputs(b"draw %d" % k)
        try:
            with time_limit(max(MUTANT_SECONDS, one.task.call.seconds), cpu=True):
                pair = [one.outputs(text, sets) for text in (source, way)]
        except (StudentError, TimeLimitExceeded, Exception) as error:
            return f"draw {k}: {type(error).__name__} {error}"
        for name, inputs in sets.items():
            a, b = (_parts(one.task, inputs, answers[name]) for answers in pair)
            for part in b:
                if part not in a or not _agree(a[part], b[part]):
                    return f"draw {k}, {name or 'random inputs'}, {part}"
    return None


def survivors(one: Programs, draws, sample=None, rng=None):
    """Find the mutants of a task's right programs that still receive full marks.

    Parameters
    ----------
    one : Programs
    draws : int, number of draws on which survivors are compared with their original
    sample : int or None, number of mutants to try, of the solution only; None: all mutants
    rng : numpy.random.Generator or None, which chooses the sample

    Returns
    -------
    list of Survivor, int : the survivors, and the number of mutants tried
    """
    namespace(one.exercise.id)  # its imports must not count in a mutant's time limit
    found, tried = [], 0
    reasons = one.file.equivalent
    for way, source in one.ways.items() if sample is None else [(SOLUTION, one.ways[SOLUTION])]:
        made = mutants(source)
        if sample is not None and len(made) > sample:
            made = [made[k] for k in sorted(rng.choice(len(made), sample, replace=False))]
        tried += len(made)
        for mutant in made:
            if survives(one, mutant.source):
                differs = difference(one, mutant.source, source, draws)
                reason = next((why for text, why in reasons.items() if text in mutant.text), None)
                found.append(Survivor(mutant, way, differs, reason))
    return found, tried


def main():
    """List the survivors of exercises; exit with 1 if a mutant is neither killed nor explained."""
    parser = argparse.ArgumentParser(prog="python -m course.mutation_testing", description=__doc__)
    parser.add_argument(
        "exercise", nargs="*", help="an exercise (06) or a task (06-update); default: all"
    )
    parser.add_argument(
        "--draws", type=int, default=100, help="number of draws on which survivors are compared"
    )
    arguments = parser.parse_args()
    holes = 0
    for id in arguments.exercise or catalogue.EXERCISES:
        for one in programs(id[:2]):
            if len(id) == 2 or one.task.id == id:
                holes += _report(one, arguments.draws)
    sys.exit(bool(holes))


def _report(one, draws):
    found, tried = survivors(one, draws)
    holes = [s for s in found if s.differs and not s.reason]
    same = sum(1 for s in found if not s.differs)
    kinds = Counter(s.reason for s in found if s.differs and s.reason)
    killed = tried - len(found)
    print(
        f"{one.task.id}: {tried} mutants, {killed} killed, {same} equivalent on {draws} draws, "
        f"{sum(kinds.values())} also right, {len(holes)} survive"
    )
    for s in holes:
        print(f"    {s.way}, {s.mutant.family}: {s.mutant.text}\n        differs: {s.differs}")
    return len(holes)


def _parts(task, inputs, outputs):
    found = checked_outputs(task, inputs, outputs)
    if isinstance(found, StudentError):
        return {}
    return parts_of(task, inputs, found)


def _agree(a, b):
    return np.shape(a) == np.shape(b) and bool((np.abs(a - b) <= AGREE * (1 + np.abs(b))).all())


if __name__ == "__main__":
    main()
