"""Function calls of exercise 03: one call per estimate, run or circuit."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall, StudentError, argument_rows, to_array


def named_results(*names, shape=None):
    """Make the call of a function with several named results, in the order of its return statement;
    it returns {name: (n, ...)}. ``shape`` maps the arguments of a call to the shape of each
    result."""

    def run(functions, inputs):
        (function, call), *_ = functions.items()
        found = {name: [] for name in names}
        for row in argument_rows(inputs):
            wanted = shape(dict(zip(inputs, row, strict=True))) if shape else {}
            result = call(*row)
            if not isinstance(result, tuple | list) or len(result) != len(names):
                raise StudentError(
                    "malformed", f"{function} must end with: return {', '.join(names)}"
                )
            for name, part in zip(names, result, strict=True):
                array = to_array(_as_list(part), f"{function}'s {name}")
                found[name].append(_with_shape(array, f"{function}'s {name}", wanted.get(name)))
        return {name: _stack(parts, f"{function}'s {name}") for name, parts in found.items()}

    return run


def _as_list(part):
    # a generator or zip is accepted as a list
    return list(part) if hasattr(part, "__next__") else part


def _with_shape(array, what, shape):
    if shape is None or array.shape == shape:
        return array
    if array.ndim and len(array) != shape[0] and array.shape[1:] == shape[1:]:
        raise StudentError("malformed", f"{what} has {len(array)} entries, expected {shape[0]}")
    raise StudentError("malformed", f"{what} has shape {array.shape}, expected {shape}")


def _stack(arrays, what):
    shapes = sorted({array.shape for array in arrays})
    if len(shapes) > 1:
        raise StudentError("malformed", f"{what} has different shapes: {shapes[0]}, {shapes[1]}")
    return np.array(arrays)


def _estimate_shapes(given):
    return {"x": given["x"].shape, "P": given["P"].shape}


def _filter_shapes(given):
    steps = len(given["zs"])
    return {"xs": (steps, *given["x"].shape), "Ps": (steps, *given["P"].shape)}


def _test_shapes(given):
    return {"nees": (3,), "nis": (3,), "wrong": (2,)}


def _matrix_shapes(given):
    return dict.fromkeys(("F", "Q", "H"), (2, 2))


CALLS = {
    "03-update": FunctionCall(("update",), named_results("x", "P", shape=_estimate_shapes)),
    "03-filter": FunctionCall(("kalman_filter",), named_results("xs", "Ps", shape=_filter_shapes)),
    "03-consistent": FunctionCall(
        ("consistency",), named_results("nees", "nis", "wrong", shape=_test_shapes)
    ),
    "03-capacitor": FunctionCall(
        ("capacitor",), named_results("F", "Q", "H", shape=_matrix_shapes)
    ),
    "03-outliers": FunctionCall(
        ("wary_filter",), named_results("xs", "Ps", shape=_filter_shapes), seconds=20.0
    ),
}
