"""The smallest failing case: the one input, of all tried, that shows best how a law is broken."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.arguments import CHANGED
from slamlab.exercises.drives.input_sets import MAIN
from slamlab.exercises.law import Law
from slamlab.exercises.outputs import all_measured, degenerate, measured

DIGITS = (1, 2, 3)
KEPT = 0.2  # share of a covariance's eigenvalues, at least, when it is rounded


@dataclass(frozen=True)
class Case:
    """An input on which a law fails.

    Parameters
    ----------
    law : Law
    probe : str, the probe it comes from, "" for a random input
    inputs : name to array; one row, where the task takes them one by one
    outputs : name to array, or StudentError
    one : bool, whether it is one row
    """

    law: Law
    probe: str
    inputs: Mapping
    outputs: Mapping | StudentError
    one: bool


def smallest(task, sets, answers, run=None) -> Case | None:
    """The smallest case on which the first broken law fails.

    Parameters
    ----------
    task : Task
    sets : what ``task.draw`` made
    answers : set's name to outputs or StudentError
    run : inputs -> outputs, calls the student's functions to shrink the case; raises StudentError;
        None: only cases that were tried are looked at

    Returns
    -------
    Case, or None where no law is broken by a single input that can be shown
    """
    found = all_measured(task, sets, answers)
    with np.errstate(all="ignore"):
        for law in task.all_laws:
            cases = [c for name in sets for c in _cases(task, law, name, sets[name], found[name])]
            if cases and run:  # the random one may become rounder than any probe is
                ends = [[c for c in cases if (c.probe == MAIN) == of] for of in (True, False)]
                cases = [_shrunk(task, _smallest_of(some), run) for some in ends if some]
            if cases:
                return _smallest_of(cases)
    return None


def failing(task, sets, error, run) -> Case:
    """The smallest case on which a student's functions fail as they did on the random inputs.

    Parameters
    ----------
    task, run : as of :func:`smallest`
    sets : what ``task.draw`` made
    error : StudentError, met on the random inputs

    Returns
    -------
    Case
    """
    found = {name: error if name == MAIN else _tried(task, run, sets[name]) for name in sets}
    cases = [
        _shrunk(task, Case(task.all_laws[0], name, sets[name], found[name], False), run)
        for name in sets
        if _same_failure(found[name], error)
    ]
    return _smallest_of(cases)


def _smallest_of(cases):
    """The case with least to read; of whole sets, which nobody reads, the random one says most."""
    return min(
        cases, key=lambda c: (not c.one and c.probe != MAIN, _size(c.inputs), c.probe != MAIN)
    )


def _cases(task, law, name, inputs, outputs):
    """Each input of a set on which a law fails."""
    if not task.judges(law, name):
        return
    broken = task.broken(law, inputs, outputs)
    if isinstance(outputs, StudentError):
        yield Case(law, name, inputs, outputs, False)
    elif broken.size == 1 or broken.size != _count(inputs):
        if broken.any():
            yield Case(law, name, inputs, outputs, broken.size == _count(inputs))
    else:
        of = _rows(inputs)
        for k in np.flatnonzero(broken) if of else ():
            yield Case(law, name, of[k], _row(outputs, k, broken.size), True)


def _rows(inputs):
    """The inputs one by one, where all arrays have as many rows; else none."""
    count = _count(inputs)
    return [{n: a[k : k + 1] for n, a in inputs.items()} for k in range(count)] if count else []


def _count(inputs):
    counts = {len(array) if np.ndim(array) else -1 for array in inputs.values()}
    return counts.pop() if len(counts) == 1 and -1 not in counts else 0


def _row(outputs, k, count):
    return {
        n: a[k : k + 1] if n != CHANGED and np.ndim(a) and len(a) == count else a
        for n, a in outputs.items()
    }


def _size(inputs):
    """How much there is to read: how many numbers, and how many digits they have."""
    arrays = [np.asarray(a, dtype=float) for a in inputs.values()]
    digits = sum((np.abs(a * 10 - np.rint(a * 10)) > 1e-9).sum() for a in arrays)
    return sum(a.size for a in arrays) + digits


def _shrunk(task, case, run):
    """A case with fewer or rounder numbers on which the law fails as well.

    A probe's numbers stay: rounded they may no longer be what its name says.
    """
    failed = isinstance(case.outputs, StudentError)
    if failed:  # which of the rows it was is not known
        case = _halved(task, case, run)
    if not task.rounds or not case.one or case.probe != MAIN:
        return case
    for name in case.inputs:
        for inputs in rounder(task, case.inputs, name):
            outputs = _tried(task, run, inputs)
            if failed:
                as_before = _same_failure(outputs, case.outputs)
            else:
                as_before = _fails(task, case.law, inputs, outputs)
            if as_before:
                case = Case(case.law, case.probe, inputs, outputs, True)
                break
    return case


def _halved(task, case, run):
    """The one row of a set that fails as the set did, found by halving; the set where none does."""
    inputs, outputs = case.inputs, case.outputs
    while (count := _count(inputs)) > 1:
        for half in (slice(count // 2), slice(count // 2, None)):
            rows = {name: array[half] for name, array in inputs.items()}
            found = _tried(task, run, rows)
            if _same_failure(found, case.outputs):
                inputs, outputs = rows, found
                break
        else:
            return case
    alone = count == 1 and _same_failure(outputs, case.outputs)
    return Case(case.law, case.probe, inputs, outputs, True) if alone else case


def rounder(task, inputs, name):
    """Inputs with one array rounded, the roundest first, that keep what the task promises.

    Parameters
    ----------
    task : Task
    inputs : name to array of one row
    name : str, of the array

    Yields
    ------
    name to array
    """
    for digits in DIGITS:
        array = _rounded(inputs[name], digits)
        if array is not None and task.are_inputs({**inputs, name: array}):
            yield {**inputs, name: array}


def _same_failure(found, error):
    """Whether one row fails as all rows did, and not just because it is one."""
    if not isinstance(found, StudentError) or found.kind != error.kind:
        return False
    if found.kind == "raised":  # the same exception, perhaps with other numbers
        return found.message.partition(":")[0] == error.message.partition(":")[0]
    return found.message == error.message


def _tried(task, run, inputs):
    try:
        return measured(task, inputs, run(inputs))
    except StudentError as error:
        return error


def _fails(task, law, inputs, outputs):
    """Whether a law fails for sure: it can be asked, and what it wants would obey it."""
    if isinstance(outputs, StudentError) or degenerate(inputs, outputs):
        return False
    try:
        if law.want and not np.all(law.holds(inputs, {**outputs, **law.want(inputs)})):
            return False
        return not np.all(law.holds(inputs, outputs))
    except Exception:  # inputs that are none: a law may not be defined there
        return False


def _rounded(array, digits):
    """An array with so many digits of its largest number; None where that changes what it is."""
    if array.dtype.kind != "f" or not array.size or not np.abs(array).max() > 0:
        return None
    rounded = np.round(array, digits - 1 - int(np.floor(np.log10(np.abs(array).max()))))
    if np.array_equal(rounded, array):
        return None
    return rounded if _as_definite(rounded, array) else None


def _as_definite(rounded, array):
    """Whether matrices that were covariances still are, and those that had an inverse have one."""
    if array.ndim < 2 or array.shape[-1] != array.shape[-2]:
        return True
    if not np.allclose(array, np.swapaxes(array, -1, -2)):
        return True
    before, after = np.linalg.eigvalsh(array), np.linalg.eigvalsh(rounded)
    dust = 1e-12 * np.abs(before).max(axis=-1, keepdims=True)
    if (before < -dust).any():  # a symmetric matrix that is no covariance
        return True
    return bool(((after >= KEPT * before) & (after >= -dust)).all())
