"""Fingerprints of mistakes, compiled to tables: ``python -m course.fingerprints 06``.

Each program runs on the open inputs twice, the second time with perturbed rounding, and rows of
outputs that differ are dropped. A task's table is not compiled again if neither its programs nor
its code have changed; hints and questions are always those of the sources. The tables contain
numbers, hints, questions and the names of quantities, but no programs.
"""

import argparse
import ast
import functools
import hashlib
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from classroom.exercises import catalogue, fingerprints
from classroom.exercises.function_calls import StudentError
from classroom.exercises.mistake_families import FAMILY_QUESTIONS, MISTAKE_FAMILIES
from classroom.exercises.task import OPEN_SEED
from classroom.exercises.time_limit import TimeLimitExceeded, time_limit
from classroom.grading.import_closure import imported
from course import quantities, quantity_texts
from course.mistakes import SOLUTION, Edit
from course.mutation_operators import mutants
from course.perturbed_rounding import environment
from course.source import ROOT
from course.task_programs import ProgramError, Programs, namespace, programs, visible_names

MUTATION = ROOT / "course" / "mutation_operators.py"
OTHER_PROCESSOR = ROOT / "course" / "perturbed_rounding"
MUTANT_SECONDS = 2.0
"""Time limit of one mutant, which may never end [s of CPU]."""


def table_file(exercise_id):
    """Return the file of an exercise's tables."""
    return ROOT / "course" / "exercises" / catalogue.folders()[exercise_id] / "fingerprints.npz"


def compiled(exercise_id, tasks=None) -> dict[str, np.ndarray]:
    """Compile the tables of an exercise: arrays by name, in the format of
    ``exercises.fingerprints``.

    Parameters
    ----------
    exercise_id : str
    tasks : ids of tasks, or None for all

    Raises
    ------
    ProgramError : with all errors of the programs
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
    """Return a hash of the code and the programs from which a task's table is compiled."""
    files = _modules(one) | {MUTATION, *OTHER_PROCESSOR.glob("*.py")}
    trees = [_WithoutProse().visit(ast.parse(file.read_text("utf-8"))) for file in sorted(files)]
    mistakes = [
        (found.name, found.before, [one.source(program) for program in found.programs])
        for found in one.mistakes
    ]
    others = one.ways, mistakes, one.file.mutants, sorted(MISTAKE_FAMILIES)
    texts = [*(ast.unparse(tree) for tree in trees), repr(others)]
    return hashlib.sha256("\n".join(texts).encode()).hexdigest()


TEXTS = {"asks", "begins", "needs", "references", "step", "why"}
"""Arguments of laws and tasks on which no fingerprint depends."""


class _WithoutProse(ast.NodeTransformer):
    """Empties strings that contain a space: docstrings and texts, on which no number depends, and
    removes arguments that only hints use, with the private names that only these arguments use.
    Keys of dictionaries stay, because they may name parts of the outputs."""

    def visit_Module(self, node):
        self.generic_visit(node)
        while True:
            names = [n for n in ast.walk(node) if isinstance(n, ast.Name)]
            used = {name.id for name in names if isinstance(name.ctx, ast.Load)}
            kept = [each for each in node.body if not _is_private(each) or _name(each) in used]
            if len(kept) == len(node.body):
                return node
            node.body = kept

    def visit_Call(self, node):
        node.keywords = [each for each in node.keywords if each.arg not in TEXTS]
        return self.generic_visit(node)

    def visit_ImportFrom(self, node):
        return None if node.module == "classroom.exercises.references" else node

    def visit_Dict(self, node):
        node.values = [self.visit(value) for value in node.values]
        return node

    def visit_Constant(self, node):
        prose = isinstance(node.value, str) and " " in node.value
        return ast.copy_location(ast.Constant(""), node) if prose else node

    def visit_JoinedStr(self, node):
        return ast.copy_location(ast.Constant(""), node)


def _name(node):
    if isinstance(node, ast.Assign):
        return getattr(node.targets[0], "id", "")
    return node.name if isinstance(node, ast.FunctionDef) else ""


def _is_private(node):
    return _name(node).startswith("_")


def _modules(one):
    """Return the files of a task's module and its function calls, and of the modules that these
    import from their folders."""
    inside = ("course.exercises.", "classroom.exercises.function_calls.")
    folder = one.folder
    waiting = [f"course.exercises.{folder.parent.name}.{folder.name}.task", one.exercise.calls]
    found = set()
    while waiting:
        name = waiting.pop()
        file = ROOT.joinpath(*name.split(".")).with_suffix(".py")
        if name.startswith(inside) and file not in found and file.is_file():
            found.add(file)
            waiting += imported(file, name)
    return found


def prints_of(one: Programs, source, sets, seconds=60.0):
    """Compute the fingerprints of one program by part; return None if judging takes too long."""
    try:
        with time_limit(seconds, cpu=True), np.errstate(all="ignore"):
            found = fingerprints.of_answers(one.task, sets, one.outputs(source, sets))
    except (StudentError, TimeLimitExceeded, Exception):  # a mutant may do anything
        return None
    return found if found and all(np.isfinite(p).all() for p in found.values()) else None


def _table(one):
    namespace(one.exercise.id)  # imports before any time limit begins
    sets = one.task.draw_inputs(OPEN_SEED)
    right = [prints_of(one, source, sets) for source in one.ways.values()]
    if None in right:
        raise ProgramError(f"{one.task.id}: the program {list(one.ways)[right.index(None)]} fails")
    rows, families = [(0, prints, "") for prints in right], sorted(MISTAKE_FAMILIES)
    for k, mistake in enumerate(one.mistakes, 1):
        for program in mistake.programs:
            hit = quantities.SEPARATOR.join(hit_by(one, program))
            rows.append((k, _mistake_prints(one, mistake, program, sets), hit))
    _check_precedence(one, [row[:2] for row in rows])
    for mutant, source in _mutants(one):
        label = 1 + len(one.mistakes) + families.index(mutant.family)
        hit = quantities.SEPARATOR.join(quantities.changed(source, mutant.source))
        rows.append((label, prints_of(one, mutant.source, sets, MUTANT_SECONDS), hit))
    parts = tuple(right[0])
    labels, values, hits = _distinct([row for row in rows if row[1]], parts)
    names, where = np.unique(np.array(hits, dtype=str), return_inverse=True)
    return {
        "names": np.array([mistake.name for mistake in one.mistakes], dtype=str),
        "parts": np.array(parts, dtype=str),
        "labels": labels,
        "prints": values,
        "quantities": names,
        "where": where.astype(np.int16),
    }


def _texts(one, names):
    """Return the texts of a table: hints and questions of the mistakes, and of the quantities with
    these names."""
    hits = [tuple(filter(None, name.split(quantities.SEPARATOR))) for name in names]
    visible = visible_names(one.task.id)
    texts = {
        "hints": [mistake.hint for mistake in one.mistakes],
        "asks": [_question(one, mistake) for mistake in one.mistakes],
        "places": [quantity_texts.place(hit, visible) for hit in hits],
        "questions": [quantity_texts.question(hit, one.file.questions) for hit in hits],
    }
    return {key: np.array(values, dtype=str) for key, values in texts.items()}


def hit_by(one, program) -> tuple[str, ...]:
    """Return the quantities that a mistake's program hits; () for a whole program."""
    if not isinstance(program, Edit) or program.above:
        return ()
    return quantities.changed(one.ways[program.way], one.source(program))


def asked_about(one, mistake) -> tuple[str, str]:
    """Return the question about a mistake, its own or that of the quantity that it hits, or "", and
    the description of this quantity, or ""."""
    hit = hit_by(one, mistake.programs[0])
    asks = mistake.asks or quantity_texts.question(hit, one.file.questions)
    return asks, quantity_texts.place(hit, visible_names(one.task.id))


def _question(one, mistake):
    """Return the question about a mistake, or that of the family of its change, or ""."""
    asks, place = asked_about(one, mistake)
    if asks or not place:
        return asks
    text = ast.unparse(ast.parse(one.source(mistake.programs[0])))
    return f"Look at {place}. {FAMILY_QUESTIONS[_families(one.ways[SOLUTION]).get(text, '')]}"


@functools.cache
def _families(source):
    return {mutant.source: mutant.family for mutant in mutants(source)}


def _mutants(one):
    """Create mutants of all right programs, or for a slow task a few evenly spaced mutants of
    its solution; pairs of Mutant and the right program."""
    most = one.file.mutants
    ways = list(one.ways.values())
    made = [
        [(mutant, source) for mutant in mutants(source)] for source in ways[: 1 if most else None]
    ]
    if most:
        return made[0][:: -(-len(made[0]) // most)]
    # name mutants are many, and those of the solution suffice
    return made[0] + [pair for others in made[1:] for pair in others if pair[0].family != "name"]


def _mistake_prints(one, mistake, program, sets):
    source = one.source(program)
    verdict = one.verdict(source, OPEN_SEED)
    if verdict.full:
        raise ProgramError(f"{one.task.id}: {mistake.name!r} gets full marks:\n{source}")
    prints = prints_of(one, source, sets)
    if prints is None:
        raise ProgramError(
            f"{one.task.id}: {mistake.name!r} cannot be judged ({verdict.problem}): make it a "
            f"Stumble, or edit less:\n{source}"
        )
    return prints


def _check_precedence(one, rows):
    """Raise ProgramError if two mistakes produce the same results and neither takes precedence."""
    mistakes, wrong = one.mistakes, []
    for i, (a, one_print) in enumerate(rows):
        for b, other in rows[:i]:
            if not 0 < b < a or any(not _close(other[p], one_print[p]) for p in other):
                continue
            first, second = mistakes[b - 1], mistakes[a - 1]
            if second.name not in first.before:
                wrong.append(f"{first.name!r} and {second.name!r}")
    if wrong:
        raise ProgramError(
            f"{one.task.id}: these mistakes give the same results; name the second in `before` of "
            f"the first: {'; '.join(sorted(set(wrong)))}"
        )


def _distinct(rows, parts):
    """Return distinct labels (n,), fingerprints (n, parts, SIZE) and the quantities hit, without
    the fingerprints of right mutants; a quantity is "" if it differs between equal rows."""
    missing = np.full(fingerprints.SIZE, np.nan)
    found = [(k, np.array([prints.get(p, missing) for p in parts]), hit) for k, prints, hit in rows]
    right = [values for label, values, _ in found if label == 0]
    kept = {}
    for label, values, hit in found:
        if label == 0 or not any(_close(values, r) for r in right):
            key = label, np.round(values, 5).tobytes()
            kept[key] = (values, hit if kept.get(key, (0, hit))[1] == hit else "")
    labels = np.array([label for label, _ in kept], dtype=np.int16)
    values = np.array([values for values, _ in kept.values()]).reshape(len(kept), len(parts), -1)
    return labels, values, [hit for _, hit in kept.values()]


def _close(a, b):
    return bool((np.abs(a - b) <= fingerprints.CLOSE * (1 + np.abs(a))).all())


def stable(arrays, others):
    """Remove rows that change under perturbed rounding.

    Parameters
    ----------
    arrays, others : results of :func:`compiled` without and with perturbed rounding

    Returns
    -------
    tables, int : the tables, and the number of rows removed
    """
    moved, margin = 0, fingerprints.CLOSE / 10
    for key in [key for key in arrays if key.endswith("/prints")]:
        named = {name: key.replace("prints", name) for name in ("labels", "prints", "where")}
        labels, prints = arrays[named["labels"]], arrays[key]
        there = np.nan_to_num(others[key])
        near = [
            (np.abs(there - p) <= margin * (1 + np.abs(p))).all(axis=(1, 2)).any()
            for p in np.nan_to_num(prints)
        ]
        keep = (labels == 0) | np.array(near)
        moved += int((~keep).sum())
        arrays = arrays | {name: arrays[name][keep] for name in named.values()}
    return arrays, moved


def stored(exercise_id) -> dict[str, np.ndarray]:
    """Load the tables of an exercise's tasks whose sources have not changed."""
    file = table_file(exercise_id)
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
    """Compile the tables of exercises and print their sizes."""
    parser = argparse.ArgumentParser(prog="python -m course.fingerprints", description=__doc__)
    parser.add_argument("exercise", nargs="*", help="exercises, such as 06 (default: all)")
    parser.add_argument("--to", help=argparse.SUPPRESS)
    parser.add_argument("--tasks", nargs="*", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    for id in arguments.exercise or [id for id in catalogue.EXERCISES if programs(id)]:
        try:
            if arguments.to:
                np.savez(arguments.to, **compiled(id, arguments.tasks))
            else:
                compile_table(id)
        except ProgramError as error:
            sys.exit(str(error))


def compile_table(id):
    """Compile the tables of an exercise whose programs or code changed, and store them."""
    kept = stored(id)
    tasks = [one.task.id for one in programs(id) if f"{one.task.id}/digest" not in kept]
    made, moved = compiled(id, tasks), 0
    if tasks:
        made, moved = stable(made, _with_perturbed_rounding(id, tasks))
    arrays = {}
    for one in programs(id):
        of = made if one.task.id in tasks else kept
        arrays |= {key: of[key] for key in of if key.startswith(f"{one.task.id}/")}
        texts = _texts(one, of[f"{one.task.id}/quantities"].tolist())
        arrays |= {f"{one.task.id}/{name}": array for name, array in texts.items()}
    file = table_file(id)
    np.savez_compressed(file, **arrays)
    rows = sum(len(a) for key, a in arrays.items() if key.endswith("/prints"))
    size = file.stat().st_size / 1024
    print(f"{id}: {rows} fingerprints, {size:.0f} kB; {moved} unstable ones dropped; ", end="")
    print("compiled", *(tasks or ["nothing"]))


def _with_perturbed_rounding(id, tasks):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "other.npz"
        command = [sys.executable, "-m", "course.fingerprints", id, "--to", str(file)]
        command += ["--tasks", *tasks]
        subprocess.run(command, check=True, cwd=ROOT, env=environment())
        with np.load(file) as there:
            return dict(there)


if __name__ == "__main__":
    main()
