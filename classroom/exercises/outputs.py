"""Validation of the outputs of a student's functions: shapes, finite numbers, magnitude."""

import numpy as np

from classroom.exercises.correctness_laws import ROUNDING
from classroom.exercises.function_calls import StudentError, wrong_shape_message
from classroom.exercises.function_calls.changed_arguments import CHANGED

MAX_MAGNITUDE = 1e18
"""Largest allowed magnitude: rounding in a law could hide the error of a larger number."""
JITTER = 1e-6
"""Relative difference up to which rows count as equal."""
MAX_ROWS = 2000
"""Maximum rows of an output of any length: a law may compare all pairs of entries."""


def checked_outputs(task, inputs, outputs):
    """Validate the untrusted outputs of one set; return arrays by name or a StudentError."""
    if outputs is None:
        return StudentError("malformed", "no result was received")
    if isinstance(outputs, StudentError):
        return outputs
    shapes = shapes_of(task, inputs)
    problem = _malformed(task.call.functions[0], shapes, inputs, outputs)
    if problem:
        return StudentError("malformed", problem)
    found = {name: np.asarray(outputs[name], dtype=float) for name in shapes}
    return found | {CHANGED: np.asarray(outputs.get(CHANGED, ()))}


def all_checked_outputs(task, sets, answers):
    return {name: checked_outputs(task, sets[name], answers.get(name)) for name in sets}


def shapes_of(task, inputs):
    """Return the shape of each output by name for these inputs; None stands for any length."""
    return task.shapes(inputs) if callable(task.shapes) else task.shapes


def is_degenerate(inputs, outputs):
    """Whether all outputs are empty, constant, or a (scaled) argument, up to small noise."""
    arrays = [array for name, array in outputs.items() if name != CHANGED]
    rows = [array for array in arrays if array.ndim and len(array) != 1]
    return bool(rows) and all(_constant(array) or _copied(array, inputs) for array in rows)


def _constant(array):
    off = np.abs(array - array[:1])
    return bool((off <= JITTER * np.abs(array).max(initial=0.0) + ROUNDING).all())


def _copied(array, inputs):
    for given in inputs.values():
        if given.shape == array.shape and given.dtype.kind in "fiu" and given.any():
            factor = np.vdot(given, array) / np.vdot(given, given)
            if (np.abs(array - factor * given) <= JITTER * np.abs(array).max()).all():
                return True
    return False


def _malformed(function, shapes, inputs, outputs):
    count = min(len(a) for a in inputs.values())
    for name, shape in shapes.items():
        what = function if name == "result" else f"{function}'s {name}"
        if name not in outputs:
            return f"{what} is missing from the result"
        got, want = outputs[name].shape, shape
        if name == "result":  # one per input; the message is about a single call
            if got[:1] != (count,):
                return f"{what} answered {got[0] if got else 0} of {count} calls"
            got = got[1:]
        if len(got) != len(want) or any(w not in (None, g) for g, w in zip(got, want, strict=True)):
            return wrong_shape_message(what, got, want)
        longest = max((g for g, w in zip(got, want, strict=True) if w is None), default=0)
        if longest > MAX_ROWS:
            return f"{what} returned {longest} entries: no correct answer has more than {MAX_ROWS}"
        if not np.isfinite(outputs[name]).all():
            return f"{what} returned NaN or infinity"
        if outputs[name].size and np.abs(outputs[name].astype(float)).max() > MAX_MAGNITUDE:
            return f"{what} returned a number beyond ±{MAX_MAGNITUDE:g}, the limit of right answers"
    return None
