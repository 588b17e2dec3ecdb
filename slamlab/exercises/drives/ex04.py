"""Drives of exercise 04: one call per input; what the calls return is stacked."""

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


def both_covariances(functions, inputs):
    """Call new_landmark on every input and keep its two results apart.

    Parameters
    ----------
    functions : "new_landmark"
    inputs : poses x (n, 3), covariances P (n, 3, 3), measurements z (n, 2), covariances R (n, 2, 2)

    Returns
    -------
    {"P_nn": (n, 2, 2), "P_rn": (n, 3, 2)}

    Raises
    ------
    StudentError : "malformed" when a call does not return two arrays of these shapes
    """
    pairs = [functions["new_landmark"](*row) for row in rows(inputs)]
    if any(not isinstance(pair, tuple | list) or len(pair) != 2 for pair in pairs):
        raise StudentError("malformed", "new_landmark must end with: return P_nn, P_rn")
    P_nn, P_rn = zip(*pairs, strict=True)
    return {
        "P_nn": _stacked(P_nn, "new_landmark's P_nn", (2, 2)),
        "P_rn": _stacked(P_rn, "new_landmark's P_rn", (3, 2)),
    }


def _stacked(results, what, shape):
    arrays = [numbers(result, what) for result in results]
    wrong = next((a.shape for a in arrays if a.shape != shape), None)
    if wrong is not None:
        turned = " (transposed?)" if wrong == shape[::-1] else ""
        raise StudentError("malformed", f"{what} has shape {wrong}, expected {shape}{turned}")
    return np.array(arrays)


DRIVES = {
    "04-h-robot": Drive(("H_robot",)),
    "04-h-landmark": Drive(("H_landmark",)),
    "04-a-odometry": Drive(("A_odometry",)),
    "04-jxr-jz": Drive(("J_xr", "J_z"), run=both_jacobians),
    "04-new-landmark": Drive(("new_landmark",), run=both_covariances),
}
