"""Fingerprints: recognise a mistake by what it computes, from a table compiled of wrong programs.

Each part of a task's outputs on the open inputs is reduced to a few numbers. The table holds those
of the right solutions, of the slips (named mistakes) and of families of small changes; it holds no
program. ``course.fingerprints`` compiles it.
"""

import functools
import zlib
from dataclasses import dataclass
from importlib import resources

import numpy as np

from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.arguments import CHANGED
from slamlab.exercises.families import FAMILIES
from slamlab.exercises.law import Mistake
from slamlab.exercises.outputs import all_measured

SIZE = 4  # numbers of a fingerprint
CLOSE = 1e-6  # of 1 + |number|: rounding moves one by less, another mistake by more
RIGHT = "right"
_STEPS = np.array([0.7548776662466927, 0.5698402909980532, 0.8191725133961645, 0.6710436067037893])


@dataclass(frozen=True)
class Table:
    """The fingerprints of one task's programs.

    Parameters
    ----------
    parts : names of the parts
    prints : (n, parts, SIZE), NaN where a program has no such part
    labels : (n,) int
    names : name of each label: ``RIGHT``, then slips in the order of their precedence, then
    families
    hints : the hint of each label, empty for ``RIGHT``
    slips : int, labels from 1 to this one are slips
    """

    parts: tuple[str, ...]
    prints: np.ndarray
    labels: np.ndarray
    names: tuple[str, ...]
    hints: tuple[str, ...]
    slips: int

    def same(self, prints):
        """(n, parts) bool, which parts of which programs have these fingerprints."""
        asked = np.array([prints.get(part, np.full(SIZE, np.nan)) for part in self.parts])
        off = np.abs(self.prints - asked)
        return (off <= CLOSE * (1 + np.abs(self.prints))).all(axis=2)


def fingerprint(arrays):
    """Reduce arrays to a few numbers: sums with weights that never repeat.

    Parameters
    ----------
    arrays : iterable of arrays

    Returns
    -------
    (SIZE,)
    """
    total, start = np.zeros(SIZE), 1
    for array in arrays:
        flat = np.ravel(array).astype(float)
        at = np.arange(start, start + flat.size + 1)  # one more: an empty array counts, too
        weights = np.sin(2 * np.pi * np.multiply.outer(_STEPS, at)) + np.cos(_STEPS)[:, None]
        total += weights @ np.append(flat, np.shape(array)[-1] if np.ndim(array) else 0)
        start += flat.size + 1
    return total


def parts_of(task, inputs, outputs):
    """The parts of a task's measured outputs that can be wrong by themselves, by name."""
    outputs = {key: array for key, array in outputs.items() if key != CHANGED}
    return task.parts(inputs, outputs) if task.parts else outputs


def of_answers(task, sets, answers):
    """The fingerprint of each part of a task's outputs.

    Parameters
    ----------
    task : Task
    sets : what ``task.draw(OPEN_SEED)`` made
    answers : set's name to outputs or StudentError

    Returns
    -------
    part's name to (SIZE,); empty where the random inputs could not be run
    """
    return _of_measured(task, sets, all_measured(task, sets, answers))


def _of_measured(task, sets, found):
    parts = {}
    for name, outputs in found.items():
        if not isinstance(outputs, StudentError):
            arrays = parts_of(task, sets[name], outputs)
        elif parts:
            arrays = dict.fromkeys(parts, _failure(outputs))
        else:
            return {}
        for part, array in arrays.items():
            parts.setdefault(part, []).append(np.asarray(array, dtype=float))
    return {part: fingerprint(arrays) for part, arrays in parts.items()}


@dataclass(frozen=True)
class Recognised(Mistake):
    """A mistake that a program explains; a slip may be called as a family is.

    Parameters
    ----------
    family : bool, whether it is of a family, not a slip with a hint of its own
    """

    family: bool


def recognise(task, sets, answers) -> Recognised | None:
    """Name the mistake that explains an answer, if exactly one does.

    One program that computes all of it explains it best; else one that computes all that is wrong.
    Where none does there are several mistakes, and the first part that only one explains is told;
    but not of an answer that fails on some inputs: that alone would make its parts like those of
    every program that fails there, and where nothing else is wrong no family is told. Slips go
    before families; two families explain nothing.

    Parameters
    ----------
    task, sets, answers : as of :func:`of_answers`

    Returns
    -------
    Recognised or None
    """
    table = tables(task.id[:2]).get(task.id)
    if table is None:
        return None
    found = all_measured(task, sets, answers)
    with np.errstate(all="ignore"):
        same = table.same(_of_measured(task, sets, found))
    wrong = ~same[table.labels == 0].any(axis=0)
    if not wrong.any():
        return None
    explaining, parts = [same.all(axis=1)], []
    if not any(isinstance(outputs, StudentError) for outputs in found.values()):
        explaining.append(same[:, wrong].all(axis=1))
        parts = list(same[:, wrong].T)
    elif _right_elsewhere(task, sets, found):
        explaining = [same.all(axis=1) & (table.labels <= table.slips)]
    for k, programs in enumerate(explaining + parts):
        labels = set(table.labels[programs].tolist())
        label = _single(labels, table.slips, first=k < len(explaining))
        if label:
            return Recognised(table.names[label], table.hints[label], label > table.slips)
    return None


@functools.cache
def tables(exercise_id) -> dict[str, Table]:
    """The tables of an exercise's tasks, by their ids; empty where none were compiled."""
    file = resources.files("slamlab").joinpath("data", "fingerprints", f"{exercise_id}.npz")
    if not file.is_file():
        return {}
    with file.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
        arrays = dict(stored)
    found = {}
    for task in [key.partition("/")[0] for key in arrays if key.endswith("/names")]:
        of = {key.split("/", 1)[1]: a for key, a in arrays.items() if key.startswith(f"{task}/")}
        slips, families = of["names"].tolist(), sorted(FAMILIES)
        found[task] = Table(
            tuple(of["parts"].tolist()),
            of["prints"],
            of["labels"],
            (RIGHT, *slips, *families),
            ("", *of["hints"].tolist(), *(FAMILIES[name] for name in families)),
            len(slips),
        )
    return found


def _single(labels, slips, first):
    """The label that explains: the only slip, or the first, else the only family, or None."""
    labels = labels - {0}
    named = sorted(label for label in labels if label <= slips)
    if named and (first or len(named) == 1):
        return named[0]
    return labels.pop() if len(labels) == 1 else None


def _right_elsewhere(task, sets, found):
    """Whether all is right that came back at all."""
    came = {
        name: outputs for name, outputs in found.items() if not isinstance(outputs, StudentError)
    }
    return not any(
        np.any(task.broken(law, sets[name], outputs))
        for name, outputs in came.items()
        for law in task.all_laws
        if task.judges(law, name)
    )


def _failure(error):
    """A number that stands for the kind of a failure; what it says differs from place to place."""
    return np.array([zlib.crc32(error.kind.encode()) / 1e6])
