"""Outputs of a student's functions, measured before they are judged: shapes, numbers,
degeneracy."""

import numpy as np

from slamlab.exercises.drives import StudentError, wrong_shape
from slamlab.exercises.drives.arguments import CHANGED
from slamlab.exercises.law import ROUNDING

MAX_MAGNITUDE = 1e9
"""Largest absolute output: beyond it a law's own rounding could hide how wrong a number is."""
JITTER = 1e-6
"""Share of the largest number by which rows may differ and still count as the same."""
MAX_ROWS = 2000
"""Most rows of an output of any length: a law may compare each entry with each."""


def measured(task, inputs, outputs):
    """The outputs of one set as float arrays, or what is wrong with them.

    Parameters
    ----------
    task : Task
    inputs : name to array
    outputs : name to array, not to be trusted; a StudentError, or None, where nothing came back

    Returns
    -------
    name to float array, or StudentError
    """
    if outputs is None:
        return StudentError("malformed", "nothing came back")
    if isinstance(outputs, StudentError):
        return outputs
    shapes = shapes_of(task, inputs)
    problem = _malformed(task.drive.functions[0], shapes, inputs, outputs)
    if problem:
        return StudentError("malformed", problem)
    found = {name: np.asarray(outputs[name], dtype=float) for name in shapes}
    return found | {CHANGED: np.asarray(outputs.get(CHANGED, ()))}


def all_measured(task, sets, answers):
    """The outputs of all sets, each as :func:`measured` gives it, by the sets' names.

    Parameters
    ----------
    task : Task
    sets : what ``task.draw`` made
    answers : set's name to outputs, not to be trusted, or StudentError

    Returns
    -------
    set's name to name to float array, or to StudentError
    """
    return {name: measured(task, sets[name], answers.get(name)) for name in sets}


def shapes_of(task, inputs):
    """Output name to the shape it must have on these inputs, None for any length."""
    return task.shapes(inputs) if callable(task.shapes) else task.shapes


def degenerate(inputs, outputs):
    """Whether nothing was computed: all outputs empty, constant, or an argument, perhaps scaled.

    A little noise upon them, less than any law would let pass, makes no answer of them.

    Parameters
    ----------
    inputs, outputs : name to array

    Returns
    -------
    bool
    """
    arrays = [array for name, array in outputs.items() if name != CHANGED]
    rows = [array for array in arrays if array.ndim and len(array) != 1]
    return bool(rows) and all(_constant(array) or _copied(array, inputs) for array in rows)


def _constant(array):
    off = np.abs(array - array[:1])
    return bool((off <= JITTER * np.abs(array).max(initial=0.0) + ROUNDING).all())


def _copied(array, inputs):
    """Whether an array is one of the inputs times one number."""
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
            return f"{what} is missing from what came back"
        got, want = outputs[name].shape, shape
        if name == "result":  # one per input: the student thinks of a single call
            if got[:1] != (count,):
                return f"{what} answered {got[0] if got else 0} of {count} calls"
            got = got[1:]
        if len(got) != len(want) or any(w not in (None, g) for g, w in zip(got, want, strict=True)):
            return wrong_shape(what, got, want)
        longest = max((g for g, w in zip(got, want, strict=True) if w is None), default=0)
        if longest > MAX_ROWS:
            return f"{what} returned {longest} entries: at most {MAX_ROWS} are allowed"
        if not np.isfinite(outputs[name]).all():
            return f"{what} returned NaN or infinity"
        if outputs[name].size and np.abs(outputs[name].astype(float)).max() > MAX_MAGNITUDE:
            return f"{what} returned numbers larger than any that is asked for"
    return None
