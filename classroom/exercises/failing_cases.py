"""Find the smallest failing case, the simplest input that breaks a law (shrinking)."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.function_calls import StudentError
from classroom.exercises.function_calls.changed_arguments import CHANGED
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.outputs import all_checked_outputs, checked_outputs, is_degenerate

DIGITS = (1, 2, 3)
KEPT = 0.2  # least share of a covariance's eigenvalues that must remain after rounding


@dataclass(frozen=True)
class FailingCase:
    """An input on which a law fails."""

    law: Law
    probe: str  # name of its probe, "" for a random input
    inputs: Mapping  # name to array; one row if the function is called for each row
    outputs: Mapping | StudentError
    one: bool  # whether it is one row


def smallest_failing_case(task, sets, answers, run=None) -> FailingCase | None:
    """Return the smallest FailingCase of the first broken law, or None if no case can be shown.

    run : inputs -> outputs; calls the student's functions to shrink the case and may raise
    StudentError. If ``run`` is None, no other inputs are tried."""
    found = all_checked_outputs(task, sets, answers)
    with np.errstate(all="ignore"):
        for law in task.all_laws:
            cases = [c for name in sets for c in _cases(task, law, name, sets[name], found[name])]
            if cases and run:  # a rounded random input may become simpler than a probe
                ends = [[c for c in cases if (c.probe == MAIN) == of] for of in (True, False)]
                cases = [_shrunk(task, _smallest_of(some), run) for some in ends if some]
            if cases:
                return _smallest_of(cases)
    return None


def smallest_raising_case(task, sets, error, run) -> FailingCase:
    """Return the smallest FailingCase that raises the same error as the random inputs."""
    found = {name: error if name == MAIN else _tried(task, run, sets[name]) for name in sets}
    cases = [
        _shrunk(task, FailingCase(task.all_laws[0], name, sets[name], found[name], False), run)
        for name in sets
        if _same_failure(found[name], error)
    ]
    return _smallest_of(cases)


def _smallest_of(cases):
    """Return the case with the fewest numbers; among whole sets, the set of random inputs."""
    return min(
        cases, key=lambda c: (not c.one and c.probe != MAIN, _size(c.inputs), c.probe != MAIN)
    )


def _cases(task, law, name, inputs, outputs):
    if not task.judges(law, name):
        return
    broken = task.broken(law, inputs, outputs)
    if isinstance(outputs, StudentError):
        yield FailingCase(law, name, inputs, outputs, False)
    elif broken.size == 1 or broken.size != _count(inputs):
        if broken.any():
            yield FailingCase(law, name, inputs, outputs, broken.size == _count(inputs))
    else:
        of = _rows(inputs)
        for k in np.flatnonzero(broken) if of else ():
            yield FailingCase(law, name, of[k], _row(outputs, k, broken.size), True)


def _rows(inputs):
    """Return the inputs row by row if all arrays have equally many rows, otherwise []."""
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
    arrays = [np.asarray(a, dtype=float) for a in inputs.values()]
    digits = sum((np.abs(a * 10 - np.rint(a * 10)) > 1e-9).sum() for a in arrays)
    return sum(a.size for a in arrays) + digits


def _shrunk(task, case, run):
    failed = isinstance(case.outputs, StudentError)
    if failed:  # the failing row is not known
        case = _halved(task, case, run)
    if not task.may_round or not case.one or case.probe != MAIN:
        return case
    for name in case.inputs:
        for inputs in rounder(task, case.inputs, name):
            outputs = _tried(task, run, inputs)
            if failed:
                as_before = _same_failure(outputs, case.outputs)
            else:
                as_before = _fails(task, case.law, inputs, outputs)
            if as_before:
                case = FailingCase(case.law, case.probe, inputs, outputs, True)
                break
    return case


def _halved(task, case, run):
    """Find by bisection one row that fails in the same way as the set, or return the set."""
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
    return FailingCase(case.law, case.probe, inputs, outputs, True) if alone else case


def rounder(task, inputs, name):
    """Yield valid inputs in which one array is rounded, with the fewest digits first."""
    for digits in DIGITS:
        array = _rounded(inputs[name], digits)
        if array is not None and task.are_inputs({**inputs, name: array}):
            yield {**inputs, name: array}


def _same_failure(found, error):
    """Whether one row fails in the same way as all rows, and not because it is a single row."""
    if not isinstance(found, StudentError) or found.kind != error.kind:
        return False
    if found.kind == "raised":  # the same exception, perhaps with other numbers
        return found.message.partition(":")[0] == error.message.partition(":")[0]
    return found.message == error.message


def _tried(task, run, inputs):
    try:
        return checked_outputs(task, inputs, run(inputs))
    except StudentError as error:
        return error


def _fails(task, law, inputs, outputs):
    """Whether outputs break a law that the expected outputs obey."""
    if isinstance(outputs, StudentError) or is_degenerate(inputs, outputs):
        return False
    try:
        if law.want and not np.all(law.holds(inputs, {**outputs, **law.want(inputs)})):
            return False
        return not np.all(law.holds(inputs, outputs))
    except Exception:  # invalid inputs: the law may be undefined there
        return False


def _rounded(array, digits):
    """Round an array to a number of digits; return None if this changes its properties."""
    if array.dtype.kind != "f" or not array.size or not np.abs(array).max() > 0:
        return None
    rounded = np.round(array, digits - 1 - int(np.floor(np.log10(np.abs(array).max()))))
    if np.array_equal(rounded, array):
        return None
    return rounded if _as_definite(rounded, array) else None


def _as_definite(rounded, array):
    """Whether rounded covariances remain positive (semi)definite and invertible."""
    if array.ndim < 2 or array.shape[-1] != array.shape[-2]:
        return True
    if not np.allclose(array, np.swapaxes(array, -1, -2)):
        return True
    before, after = np.linalg.eigvalsh(array), np.linalg.eigvalsh(rounded)
    dust = 1e-12 * np.abs(before).max(axis=-1, keepdims=True)
    if (before < -dust).any():  # a symmetric matrix, but not a covariance
        return True
    return bool(((after >= KEPT * before) & (after >= -dust)).all())
