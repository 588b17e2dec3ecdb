"""Fingerprints of outputs recognise a mistake (misconception) and choose its hint from a table.

Each part of a task's outputs on the open inputs is reduced to a few numbers. The table contains the
fingerprints of correct solutions, named mistakes and families of small changes, but not the
programs."""

import functools
import zlib
from dataclasses import dataclass

import numpy as np

from classroom.exercises import catalogue
from classroom.exercises.correctness_laws import Mistake
from classroom.exercises.function_calls import StudentError
from classroom.exercises.function_calls.changed_arguments import CHANGED
from classroom.exercises.mistake_families import (
    FAMILY_HINT,
    FAMILY_QUESTIONS,
    MISTAKE_FAMILIES,
)
from classroom.exercises.outputs import all_checked_outputs

SIZE = 4  # numbers of a fingerprint
CLOSE = 1e-6  # relative to 1 + |number|: larger than rounding, smaller than another mistake
RIGHT = "right"
_STEPS = np.array([0.7548776662466927, 0.5698402909980532, 0.8191725133961645, 0.6710436067037893])


@dataclass(frozen=True)
class Table:
    """The fingerprints of one task's programs, compiled by ``course.fingerprints``."""

    parts: tuple[str, ...]
    prints: np.ndarray  # (n, parts, SIZE), NaN if a program lacks a part
    labels: np.ndarray  # (n,) int
    names: tuple[str, ...]  # of each label: RIGHT, named mistakes in order of precedence, families
    hints: tuple[str, ...]  # of each label, "" for RIGHT
    mistakes: int  # labels from 1 to this one are named mistakes
    asks: tuple[str, ...]  # question of each label, or ""
    where: np.ndarray  # (n,) int, the quantity that each program hits
    places: tuple[str, ...]  # description of each quantity, or ""
    questions: tuple[str, ...]  # about each quantity, or ""

    def explain(self, label, programs):
        """Return the mistake with a label, if the programs in the mask (n,) explain an answer."""
        hit = set(self.where[programs & (self.labels == label)].tolist())
        place, question = "", ""
        if len({self.places[k] for k in hit}) == 1:
            place = self.places[min(hit)]
        if len({self.questions[k] for k in hit}) == 1:
            question = self.questions[min(hit)]
        family = label > self.mistakes
        hint, asks = self.hints[label], self.asks[label]
        if not family:
            return RecognisedMistake(self.names[label], hint, False, asks=asks or question)
        if place:
            hint, asks = f"{hint} in {place}", f"Look at {place}. {asks}"
        hint = FAMILY_HINT.format(hint)
        asks = question or (asks if place else "")
        return RecognisedMistake(self.names[label], hint, True, asks=asks)

    def same(self, prints):
        """Return (n, parts) bool: whether each part of each program has these fingerprints."""
        asked = np.array([prints.get(part, np.full(SIZE, np.nan)) for part in self.parts])
        off = np.abs(self.prints - asked)
        return (off <= CLOSE * (1 + np.abs(self.prints))).all(axis=2)


def fingerprint(arrays):
    """Reduce arrays to SIZE numbers: weighted sums with non-repeating weights."""
    total, start = np.zeros(SIZE), 1
    for array in arrays:
        flat = np.ravel(array).astype(float)
        at = np.arange(start, start + flat.size + 1)  # one more, so that an empty array counts
        weights = np.sin(2 * np.pi * np.multiply.outer(_STEPS, at)) + np.cos(_STEPS)[:, None]
        total += weights @ np.append(flat, np.shape(array)[-1] if np.ndim(array) else 0)
        start += flat.size + 1
    return total


def parts_of(task, inputs, outputs):
    """Return the parts of outputs that can be wrong independently, by name."""
    outputs = {key: array for key, array in outputs.items() if key != CHANGED}
    return task.parts(inputs, outputs) if task.parts else outputs


def of_answers(task, sets, answers):
    """Compute the fingerprint of each part, by name; {} if the call on random inputs failed."""
    return _of_measured(task, sets, all_checked_outputs(task, sets, answers))


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
class RecognisedMistake(Mistake):
    """A mistake in a program of the table; ``family`` is False for a mistake with a name."""

    family: bool


def find_mistake(task, sets, answers) -> RecognisedMistake | None:
    """Return the mistake that explains an answer, or None unless exactly one mistake explains it.

    Programs that compute the whole answer are tried first, then programs that compute all wrong
    parts, then the first part that only one mistake explains. Named mistakes precede families; if
    two families explain an answer, it remains unexplained."""
    table = tables(task.id[:2]).get(task.id)
    if table is None:
        return None
    found = all_checked_outputs(task, sets, answers)
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
        explaining = [same.all(axis=1) & (table.labels <= table.mistakes)]
    for k, programs in enumerate(explaining + parts):
        labels = set(table.labels[programs].tolist())
        label = _single(labels, table.mistakes, first=k < len(explaining))
        if label:
            return table.explain(label, programs)
    return None


@functools.cache
def tables(exercise_id) -> dict[str, Table]:
    """Load the tables of an exercise's tasks, by id; {} if no tables were compiled."""
    file = catalogue.file(exercise_id, "fingerprints.npz")
    if not file.is_file():
        return {}
    with file.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
        arrays = dict(stored)
    found = {}
    for task in [key.partition("/")[0] for key in arrays if key.endswith("/names")]:
        of = {key.split("/", 1)[1]: a for key, a in arrays.items() if key.startswith(f"{task}/")}
        mistakes, families = of["names"].tolist(), sorted(MISTAKE_FAMILIES)
        found[task] = Table(
            tuple(of["parts"].tolist()),
            of["prints"],
            of["labels"],
            (RIGHT, *mistakes, *families),
            ("", *of["hints"].tolist(), *(MISTAKE_FAMILIES[name] for name in families)),
            len(mistakes),
            ("", *of["asks"].tolist(), *(FAMILY_QUESTIONS[name] for name in families)),
            of["where"],
            tuple(of["places"].tolist()),
            tuple(of["questions"].tolist()),
        )
    return found


def _single(labels, mistakes, first):
    """Return the only (or first) named mistake; if none is named, the only family, or None."""
    labels = labels - {0}
    named = sorted(label for label in labels if label <= mistakes)
    if named and (first or len(named) == 1):
        return named[0]
    return labels.pop() if len(labels) == 1 else None


def _right_elsewhere(task, sets, found):
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
    """Encode the kind of a failure as a number, because messages differ between versions."""
    return np.array([zlib.crc32(error.kind.encode()) / 1e6])
