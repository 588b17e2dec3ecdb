"""Drives of exercise 03: one call per belief, per drive of a cart, per circuit."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows


def several(*names, shape=None):
    """A drive that keeps the several results of each call apart.

    Parameters
    ----------
    names : of the results, in the order in which they are returned
    shape : (arguments of the call) -> result's name to its shape; None: not looked at

    Returns
    -------
    (functions, inputs) -> {name: (n, ...)}
    """

    def run(functions, inputs):
        (function, call), *_ = functions.items()
        found = {name: [] for name in names}
        for row in rows(inputs):
            wanted = shape(dict(zip(inputs, row, strict=True))) if shape else {}
            result = call(*row)
            if not isinstance(result, tuple | list) or len(result) != len(names):
                raise StudentError(
                    "malformed", f"{function} must end with: return {', '.join(names)}"
                )
            for name, part in zip(names, result, strict=True):
                array = numbers(_list(part), f"{function}'s {name}")
                found[name].append(_shaped(array, f"{function}'s {name}", wanted.get(name)))
        return {name: _stacked(parts, f"{function}'s {name}") for name, parts in found.items()}

    return run


def _list(part):
    # what a generator or zip holds is as good as a list of it
    return list(part) if hasattr(part, "__next__") else part


def _shaped(array, what, shape):
    """The array, when it has the shape expected: that of one call, as the student sees it."""
    if shape is None or array.shape == shape:
        return array
    if array.ndim and len(array) != shape[0] and array.shape[1:] == shape[1:]:
        raise StudentError(
            "malformed", f"{what} has {len(array)} entries, and {shape[0]} were expected"
        )
    raise StudentError("malformed", f"{what} has shape {array.shape}, expected {shape}")


def _stacked(arrays, what):
    shapes = sorted({array.shape for array in arrays})
    if len(shapes) > 1:
        raise StudentError("malformed", f"{what} has shape {shapes[0]}, and then {shapes[1]}")
    return np.array(arrays)


def _belief(given):
    return {"x": given["x"].shape, "P": given["P"].shape}


def _beliefs(given):
    steps = len(given["zs"])
    return {"xs": (steps, *given["x"].shape), "Ps": (steps, *given["P"].shape)}


def _matrices(given):
    return dict.fromkeys(("F", "Q", "H"), (2, 2))


DRIVES = {
    "03-gain": Drive(("gain",)),
    "03-update": Drive(("update",), several("x", "P", shape=_belief)),
    "03-filter": Drive(("kalman_filter",), several("xs", "Ps", shape=_beliefs)),
    "03-capacitor": Drive(("capacitor",), several("F", "Q", "H", shape=_matrices)),
    "03-ghosts": Drive(("wary_filter",), several("xs", "Ps", shape=_beliefs)),
}
