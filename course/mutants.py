"""Try the laws of tasks on every small change of every right way: ``python -m course.mutants 06``.

A mutant that keeps full marks survives. It is listed with an input on which it differs from the
way it was made of: then a probe is missing, or it is right as well and is to be entered, with its
reason, in ``EQUIVALENT`` of the task's programs. One that agrees on all draws is equivalent.
"""

import argparse
import os
import sys
from collections import Counter
from dataclasses import dataclass

import numpy as np

from course.fingerprints import MUTANT_SECONDS
from course.mutation import Mutant, mutants
from course.programs import SOLUTION, Programs, namespace, programs
from slamlab.exercises.time_limit import TimeLimitExceeded, time_limit
from slamlab.exercises import catalogue
from slamlab.exercises.drives import StudentError
from slamlab.exercises.fingerprints import parts_of
from slamlab.exercises.outputs import measured
from slamlab.exercises.task import OPEN_SEED

AGREE = 1e-9  # of 1 + |number|: what two equivalent programs may differ by
SEEDS = 5  # with which a mutant must keep full marks to survive


@dataclass(frozen=True)
class Survivor:
    """A mutant that keeps full marks.

    Parameters
    ----------
    mutant : Mutant
    way : str, the right way it was made of
    differs : str or None, where its outputs differ; None: nowhere, it is equivalent
    reason : str or None, why it is right as well, from ``EQUIVALENT``
    """

    mutant: Mutant
    way: str
    differs: str | None
    reason: str | None


def survives(one: Programs, source, seeds=SEEDS) -> bool:
    """Whether a program keeps full marks, with the open seed and some others.

    It runs in a process of its own where there can be one: after a failed product of matrices of
    objects NumPy may crash Python.
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
    """Where two programs' outputs differ first, over some draws of inputs and probes.

    Parameters
    ----------
    one : Programs
    source, way : str, two programs
    draws : int

    Returns
    -------
    str, or None where they agree to 1e-9 everywhere
    """
    for k in range(draws):
        sets = one.task.draw(b"draw %d" % k)
        try:
            with time_limit(max(MUTANT_SECONDS, one.task.drive.seconds), cpu=True):
                pair = [one.answers(text, sets) for text in (source, way)]
        except (StudentError, TimeLimitExceeded, Exception) as error:
            return f"draw {k}: {type(error).__name__} {error}"
        for name, inputs in sets.items():
            a, b = (_parts(one.task, inputs, answers[name]) for answers in pair)
            for part in b:
                if part not in a or not _agree(a[part], b[part]):
                    return f"draw {k}, {name or 'random inputs'}, {part}"
    return None


def survivors(one: Programs, draws, sample=None, rng=None):
    """The mutants of all right ways of a task, or a sample of its solution's, that keep full marks.

    Parameters
    ----------
    one : Programs
    draws : int, on which survivors are compared with their way
    sample : int or None, so many mutants of the solution only
    rng : numpy.random.Generator or None, which ones

    Returns
    -------
    list of Survivor, int : and how many mutants were tried
    """
    namespace(one.exercise.id)  # its imports count for no mutant's time limit
    found, tried = [], 0
    reasons = getattr(one.module, "EQUIVALENT", {})
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
    """List the survivors of exercises; exits with 1 where one is neither killed nor explained."""
    parser = argparse.ArgumentParser(prog="python -m course.mutants", description=__doc__)
    parser.add_argument(
        "exercise", nargs="*", help="such as 06, or a task, 06-update; default: all"
    )
    parser.add_argument("--draws", type=int, default=100, help="on which survivors are compared")
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
        f"{sum(kinds.values())} right as well, {len(holes)} survive"
    )
    for s in holes:
        print(f"    {s.way}, {s.mutant.family}: {s.mutant.text}\n        differs: {s.differs}")
    return len(holes)


def _parts(task, inputs, outputs):
    found = measured(task, inputs, outputs)
    if isinstance(found, StudentError):
        return {}
    return parts_of(task, inputs, found)


def _agree(a, b):
    return np.shape(a) == np.shape(b) and bool((np.abs(a - b) <= AGREE * (1 + np.abs(b))).all())


if __name__ == "__main__":
    main()
