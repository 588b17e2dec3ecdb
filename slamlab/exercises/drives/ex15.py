"""How exercise 15, closing the loop, is driven: edges one by one, graphs as lists of edges."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, rows, shaped


def _jacobians(functions, inputs):
    """Both Jacobians of every edge."""
    return _several(functions["jacobians"], inputs, "jacobians", {"A": (3, 3), "B": (3, 3)})


def _ranges(functions, inputs):
    """Error and Jacobians of every edge by radio."""
    return _several(functions["range_edge"], inputs, "range_edge", {"e": (), "A": (3,), "B": (3,)})


def _several(function, inputs, name, shapes):
    """What a function returns that ends with several values, each of them stacked."""
    found = [function(*row) for row in rows(inputs)]
    if any(not isinstance(values, tuple | list) or len(values) != len(shapes) for values in found):
        raise StudentError("malformed", f"{name} must end with: return {', '.join(shapes)}")
    return {
        output: np.array([shaped(values[k], f"{name}'s {output}", shape) for values in found])
        for k, (output, shape) in enumerate(shapes.items())
    }


def _steps(functions, inputs):
    """One step of every graph."""
    found = []
    for poses, *edges in rows(inputs):
        found.append(shaped(functions["step"](poses, _listed(*edges)), "step", poses.shape))
    return {"result": np.array(found)}


def _closed(functions, inputs):
    """The map of every drive: its wheels' edges are those from each pose to the next."""
    found = []
    for poses, measured, information, *loops in rows(inputs):
        chain = np.column_stack([np.arange(len(poses) - 1), np.arange(1, len(poses))])
        wheels = _listed(chain, measured, information)
        value = functions["close_loops"](poses, wheels, _listed(*loops))
        found.append(shaped(value, "close_loops", poses.shape))
    return {"result": np.array(found)}


def _listed(pairs, measured, information):
    """Edges as the exercise has them: i, j, z and Λ of each."""
    edges = zip(pairs, measured, information, strict=True)
    return [(int(i), int(j), z, L) for (i, j), z, L in edges]


DRIVES = {
    "15-error": Drive(("error",)),
    "15-jacobians": Drive(("jacobians",), _jacobians),
    "15-step": Drive(("step",), _steps),
    "15-range": Drive(("range_edge",), _ranges),
    "15-liars": Drive(("close_loops",), _closed),
}
