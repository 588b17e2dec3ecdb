"""Drives of exercise 04: one call per input; what the calls return is kept apart and stacked."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows


def both_jacobians(functions, inputs):
    """Call J_xr and J_z on every input.

    Parameters
    ----------
    functions : "J_xr" and "J_z"
    inputs : poses x (n, 3), measurements z (n, 2)

    Returns
    -------
    {"J_xr": (n, 2, 3), "J_z": (n, 2, 2)}

    Raises
    ------
    StudentError : "malformed" when a result is no array of that shape
    """
    return {
        name: _stacked([functions[name](*row) for row in rows(inputs)], name, shape)
        for name, shape in [("J_xr", (2, 3)), ("J_z", (2, 2))]
    }


def two_results(function, **shapes):
    """A run that calls a function on every input and keeps its two results apart.

    Parameters
    ----------
    function : str
    shapes : name of each result to its shape, in the order they are returned

    Returns
    -------
    (functions, inputs) -> {name: (n, *shape)}; raises StudentError "malformed" where a call
    does not return two arrays of these shapes
    """

    def run(functions, inputs):
        pairs = [functions[function](*row) for row in rows(inputs)]
        if any(not isinstance(pair, tuple | list) or len(pair) != 2 for pair in pairs):
            raise StudentError("malformed", f"{function} must end with: return {', '.join(shapes)}")
        return {
            name: _stacked([pair[k] for pair in pairs], f"{function}'s {name}", shape)
            for k, (name, shape) in enumerate(shapes.items())
        }

    return run


def _stacked(results, what, shape):
    arrays = [numbers(result, what) for result in results]
    if len(shape) < 2:  # one number, or one row: (), (1,) and (1, 1), or (5,) and (1, 5)
        arrays = [a.reshape(shape) if a.size == np.prod(shape) else a for a in arrays]
    wrong = next((a.shape for a in arrays if a.shape != shape), None)
    if wrong is not None:
        turned = " (transposed?)" if wrong == shape[::-1] else ""
        raise StudentError("malformed", f"{what} has shape {wrong}, expected {shape}{turned}")
    return np.array(arrays)


DRIVES = {
    "04-h-robot": Drive(("H_robot",)),
    "04-jxr-jz": Drive(("J_xr", "J_z"), run=both_jacobians),
    "04-new-landmark": Drive(
        ("new_landmark",), run=two_results("new_landmark", P_nn=(2, 2), P_rn=(3, 2))
    ),
    "04-camera": Drive(("camera",), run=two_results("camera", u=(), H=(5,))),
    "04-unsure-drive": Drive(
        ("unsure_drive",), run=two_results("unsure_drive", mean=(3,), covariance=(3, 3))
    ),
}
