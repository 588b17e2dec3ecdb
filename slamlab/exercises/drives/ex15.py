"""How exercise 15, closing the loop, is driven: edges one by one, graphs as lists of edges."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows


def _jacobians(functions, inputs):
    """Both Jacobians of every edge."""
    pairs = [functions["jacobians"](*row) for row in rows(inputs)]
    if any(not isinstance(pair, tuple | list) or len(pair) != 2 for pair in pairs):
        raise StudentError("malformed", "jacobians must end with: return A, B")
    return {
        name: np.array([_shaped(pair[k], f"jacobians' {name}", (3, 3)) for pair in pairs])
        for k, name in enumerate("AB")
    }


def _steps(functions, inputs):
    """One step of every graph."""
    found = []
    for poses, pairs, measured, information in rows(inputs):
        edges = [
            (int(i), int(j), z, L)
            for (i, j), z, L in zip(pairs, measured, information, strict=True)
        ]
        found.append(_shaped(functions["step"](poses.copy(), edges), "step", poses.shape))
    return {"result": np.array(found)}


def _shaped(value, what, shape):
    array = numbers(value, what)
    if array.shape != shape:
        raise StudentError("malformed", f"{what} has shape {array.shape}, expected {shape}")
    return array


DRIVES = {
    "15-error": Drive(("error",)),
    "15-jacobians": Drive(("jacobians",), _jacobians),
    "15-step": Drive(("step",), _steps),
    "15-weight": Drive(("weight",)),
    "15-cell": Drive(("update",)),
}
