"""Compile the fingerprints of slips and small mistakes: ``python -m course.fingerprints 06``.

Programs are run on the open inputs twice, the second time as on another processor; rows that move
are dropped. Of a task whose sources are as they were the table is kept. What ships is numbers and
hints, no program.
"""

import argparse
import ast
import hashlib
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from course.mutation import mutants
from course.other_processor import environment
from course.programs import SOLUTION, ProgramError, Programs, namespace, programs
from course.source import ROOT
from slamlab.exercises.time_limit import TimeLimitExceeded, time_limit
from slamlab.exercises import catalogue, fingerprints
from slamlab.exercises.drives import StudentError
from slamlab.exercises.families import FAMILIES
from slamlab.exercises.task import OPEN_SEED
from slamlab.grading.import_closure import imported

FOLDER = ROOT / "slamlab" / "data" / "fingerprints"
MUTATION = ROOT / "course" / "mutation.py"
OTHER_PROCESSOR = ROOT / "course" / "other_processor"
TASKS = "slamlab.exercises"
MUTANT_SECONDS = 2.0
"""Time limit of one mutant, which may never end [s of CPU]."""


def compiled(exercise_id, tasks=None) -> dict[str, np.ndarray]:
    """The tables of an exercise as arrays by name, as ``exercises.fingerprints`` reads them.

    Parameters
    ----------
    exercise_id : str
    tasks : ids of tasks, or None: of all

    Raises
    ------
    ProgramError : with everything that is wrong with the programs
    """
    arrays, problems = {}, []
    for one in programs(exercise_id):
        if tasks is not None and one.task.id not in tasks:
            continue
        try:
            table = _table(one) | {"digest": np.array(digest(one))}
            arrays |= {f"{one.task.id}/{key}": array for key, array in table.items()}
        except ProgramError as error:
            problems.append(str(error))
    if problems:
        raise ProgramError("\n".join(problems))
    return arrays


def digest(one: Programs) -> str:
    """A hash of the sources from which a task's table is compiled."""
    files = _modules(one) | {MUTATION, *OTHER_PROCESSOR.glob("*.py")}
    texts = [ast.unparse(ast.parse(file.read_text("utf-8"))) for file in sorted(files)]
    texts += [*one.ways.values(), *sorted(FAMILIES)]
    return hashlib.sha256("\n".join(texts).encode()).hexdigest()


def _modules(one):
    """The files of a task's two modules, its drive, and what they import of their folders."""
    topic, exercise = one.module.__name__.rpartition(".")[2], f"ex{one.exercise.id}"
    inside = ("course.tasks.", f"{TASKS}.tasks.", f"{TASKS}.drives.")
    waiting = [one.module.__name__, f"{TASKS}.tasks.{exercise}.{topic}"]
    waiting.append(f"{TASKS}.drives.{exercise}")
    found = set()
    while waiting:
        name = waiting.pop()
        file = ROOT.joinpath(*name.split(".")).with_suffix(".py")
        if name.startswith(inside) and file not in found and file.is_file():
            found.add(file)
            waiting += imported(file, name)
    return found


def prints_of(one: Programs, source, sets, seconds=60.0):
    """The fingerprints of one program, part by part; None where it cannot be judged in time."""
    try:
        with time_limit(seconds, cpu=True), np.errstate(all="ignore"):
            found = fingerprints.of_answers(one.task, sets, one.answers(source, sets))
    except (StudentError, TimeLimitExceeded, Exception):  # a mutant may do anything
        return None
    return found if found and all(np.isfinite(p).all() for p in found.values()) else None


def _table(one):
    namespace(one.exercise.id)  # what it imports takes time of its own, and is not to be cut short
    sets = one.task.draw(OPEN_SEED)
    right = [prints_of(one, source, sets) for source in one.ways.values()]
    if None in right:
        raise ProgramError(f"{one.task.id}: the way {list(one.ways)[right.index(None)]} fails")
    rows = [(0, prints) for prints in right]
    for k, slip in enumerate(one.slips, 1):
        for program in slip.programs:
            rows.append((k, _slip_prints(one, slip, program, sets)))
    _check_precedence(one, rows)
    families = sorted(FAMILIES)
    for mutant in _mutants(one):
        label = 1 + len(one.slips) + families.index(mutant.family)
        rows.append((label, prints_of(one, mutant.source, sets, MUTANT_SECONDS)))
    parts = tuple(right[0])
    labels, values = _distinct([(label, prints) for label, prints in rows if prints], parts)
    return {
        "names": np.array([slip.name for slip in one.slips], dtype=str),
        "hints": np.array([slip.hint for slip in one.slips], dtype=str),
        "parts": np.array(parts, dtype=str),
        "labels": labels,
        "prints": values,
    }


def _mutants(one):
    """Mutants of all ways; of a slow task's solution only, evenly chosen, ``MUTANTS`` of them."""
    most = getattr(one.module, "MUTANTS", None)
    if most:
        made = mutants(one.ways[SOLUTION])
        return made[:: -(-len(made) // most)]
    made = [mutants(source) for source in one.ways.values()]
    # names are too many, and those of the solution suffice
    return made[0] + [m for others in made[1:] for m in others if m.family != "name"]


def _slip_prints(one, slip, program, sets):
    source = one.source(program)
    verdict = one.verdict(source, OPEN_SEED)
    if verdict.full:
        raise ProgramError(f"{one.task.id}: the slip {slip.name!r} keeps full marks:\n{source}")
    prints = prints_of(one, source, sets)
    if prints is None:
        raise ProgramError(
            f"{one.task.id}: the slip {slip.name!r} cannot be judged ({verdict.problem}): it is a "
            f"Stumble, or an edit of too much:\n{source}"
        )
    return prints


def _check_precedence(one, rows):
    """That slips which compute the same say which goes first."""
    slips, wrong = one.slips, []
    for i, (a, one_print) in enumerate(rows):
        for b, other in rows[:i]:
            if not 0 < b < a or any(not _close(other[p], one_print[p]) for p in other):
                continue
            first, second = slips[b - 1], slips[a - 1]
            if second.name not in first.before:
                wrong.append(f"{first.name!r} and {second.name!r}")
    if wrong:
        raise ProgramError(
            f"{one.task.id}: these slips compute the same, and the first does not name the second "
            f"in its `before`: {'; '.join(sorted(set(wrong)))}"
        )


def _distinct(rows, parts):
    """Labels (n,) and fingerprints (n, parts, SIZE), each once, without mutants that are right."""
    missing = np.full(fingerprints.SIZE, np.nan)
    found = [(label, np.array([prints.get(p, missing) for p in parts])) for label, prints in rows]
    right = [values for label, values in found if label == 0]
    kept = {}
    for label, values in found:
        if label == 0 or not any(_close(values, r) for r in right):
            kept.setdefault((label, np.round(values, 5).tobytes()), values)
    labels = np.array([label for label, _ in kept], dtype=np.int16)
    return labels, np.array(list(kept.values())).reshape(len(kept), len(parts), -1)


def _close(a, b):
    return bool((np.abs(a - b) <= fingerprints.CLOSE * (1 + np.abs(a))).all())


def stable(arrays, others):
    """Tables without the rows that move on another processor.

    Parameters
    ----------
    arrays, others : what :func:`compiled` made on two processors

    Returns
    -------
    tables, int : and how many rows moved
    """
    moved, margin = 0, fingerprints.CLOSE / 10
    for key in [key for key in arrays if key.endswith("/prints")]:
        labels, prints = arrays[key.replace("prints", "labels")], arrays[key]
        there = np.nan_to_num(others[key])
        near = [
            (np.abs(there - p) <= margin * (1 + np.abs(p))).all(axis=(1, 2)).any()
            for p in np.nan_to_num(prints)
        ]
        keep = (labels == 0) | np.array(near)
        moved += int((~keep).sum())
        arrays = arrays | {key: prints[keep], key.replace("prints", "labels"): labels[keep]}
    return arrays, moved


def stored(exercise_id) -> dict[str, np.ndarray]:
    """What was compiled of an exercise's tasks whose sources have not changed since."""
    file = FOLDER / f"{exercise_id}.npz"
    if not file.is_file():
        return {}
    with np.load(file) as stream:
        arrays = dict(stream)
    same = {
        one.task.id
        for one in programs(exercise_id)
        if str(arrays.get(f"{one.task.id}/digest")) == digest(one)
    }
    return {key: array for key, array in arrays.items() if key.partition("/")[0] in same}


def main():
    """Compile the tables of exercises and say how large they are."""
    parser = argparse.ArgumentParser(prog="python -m course.fingerprints", description=__doc__)
    parser.add_argument("exercise", nargs="*", help="such as 06; default: all")
    parser.add_argument("--to", help=argparse.SUPPRESS)
    parser.add_argument("--tasks", nargs="*", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    for id in arguments.exercise or [id for id in catalogue.EXERCISES if programs(id)]:
        try:
            if arguments.to:
                np.savez(arguments.to, **compiled(id, arguments.tasks))
            else:
                _compile(id)
        except ProgramError as error:
            sys.exit(str(error))


def _compile(id):
    kept = stored(id)
    tasks = [one.task.id for one in programs(id) if f"{one.task.id}/digest" not in kept]
    made, moved = compiled(id, tasks), 0
    if tasks:
        made, moved = stable(made, _on_other_processor(id, tasks))
    arrays = {}
    for one in programs(id):
        of = made if one.task.id in tasks else kept
        arrays |= {key: of[key] for key in of if key.startswith(f"{one.task.id}/")}
    FOLDER.mkdir(parents=True, exist_ok=True)
    np.savez_compressed(FOLDER / f"{id}.npz", **arrays)
    rows = sum(len(a) for key, a in arrays.items() if key.endswith("/prints"))
    size = (FOLDER / f"{id}.npz").stat().st_size / 1024
    print(f"{id}: {rows} fingerprints, {size:.0f} kB; {moved} dropped that moved; ", end="")
    print("compiled", *(tasks or ["nothing"]))


def _on_other_processor(id, tasks):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "other.npz"
        command = [sys.executable, "-m", "course.fingerprints", id, "--to", str(file)]
        command += ["--tasks", *tasks]
        subprocess.run(command, check=True, cwd=ROOT, env=environment())
        with np.load(file) as there:
            return dict(there)


if __name__ == "__main__":
    main()
