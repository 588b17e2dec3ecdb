"""Function calls of exercise 04: one call per input."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall, StudentError, argument_rows, to_array


def call_both_jacobians(functions, inputs):
    """Call J_xr and J_z for each input; return {"J_xr": (n, 2, 3), "J_z": (n, 2, 2)}. Raise
    StudentError "malformed" for other shapes."""
    return {
        name: _stack([functions[name](*row) for row in argument_rows(inputs)], name, shape)
        for name, shape in [("J_xr", (2, 3)), ("J_z", (2, 2))]
    }


def several_results(function, **shapes):
    """Make the call of a function with named results; it returns {name: (n, *shape)}. It raises
    StudentError "malformed" for other shapes."""

    def run(functions, inputs):
        found = [functions[function](*row) for row in argument_rows(inputs)]
        if any(not isinstance(one, tuple | list) or len(one) != len(shapes) for one in found):
            raise StudentError("malformed", f"{function} must end with: return {', '.join(shapes)}")
        return {
            name: _stack([one[k] for one in found], f"{function}'s {name}", shape)
            for k, (name, shape) in enumerate(shapes.items())
        }

    return run


def _stack(results, what, shape):
    arrays = [to_array(result, what) for result in results]
    if len(shape) < 2:  # one number, or one row: (), (1,) and (1, 1), or (5,) and (1, 5)
        arrays = [a.reshape(shape) if a.size == np.prod(shape) else a for a in arrays]
    wrong = next((a.shape for a in arrays if a.shape != shape), None)
    if wrong is not None:
        turned = " (transposed?)" if wrong == shape[::-1] else ""
        raise StudentError("malformed", f"{what} has shape {wrong}, expected {shape}{turned}")
    return np.array(arrays)


CALLS = {
    "04-h-robot": FunctionCall(("H_robot",)),
    "04-jxr-jz": FunctionCall(("J_xr", "J_z"), run=call_both_jacobians),
    "04-wheels": FunctionCall(
        ("predict_wheels",),
        run=several_results("predict_wheels", x=(3,), P=(3, 3), A=(3, 3), W=(3, 2)),
    ),
    "04-camera": FunctionCall(("camera",), run=several_results("camera", u=(), H=(5,))),
    "04-moments": FunctionCall(
        ("moments",), run=several_results("moments", mean=(3,), covariance=(3, 3))
    ),
}
