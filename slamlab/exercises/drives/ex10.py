"""Drives of exercise 10: drives and sightings one by one, and None where nothing is left."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows


def rings(functions, inputs):
    """Call ring on every pair of boxes; None is an answer, too.

    Parameters
    ----------
    functions : "ring"
    inputs : boxes robot, box (n, 4), range and bound (n,)

    Returns
    -------
    {"left": (n,) 1 where something is left and 0 where None, "box": (n, 4), zeros for None}

    Raises
    ------
    StudentError : "malformed" when a result is neither None nor four numbers
    """
    found = [functions["ring"](*row) for row in rows(inputs)]
    left = np.array([box is not None for box in found], dtype=float)
    boxes = [np.zeros(4) if box is None else _sized(box, "ring", 4) for box in found]
    return {"left": left, "box": np.array(boxes).reshape(-1, 4)}


def looks(functions, inputs):
    """Let every robot look round once.

    Parameters
    ----------
    functions : "narrow"
    inputs : robot (n, 4), heading (n, 2), objects (n, m, 2), z (n, m, 2), bounds (n, 2)

    Returns
    -------
    {"robot": (n, 4), "heading": (n, 2)}

    Raises
    ------
    StudentError : "malformed" when a call returns no box and heading
    """
    found = [_believed(functions["narrow"](*row)) for row in rows(inputs)]
    return {
        name: np.array([pair[k] for pair in found]) for k, name in enumerate(("robot", "heading"))
    }


def _believed(result):
    if not isinstance(result, tuple | list) or len(result) != 2:
        raise StudentError("malformed", "narrow must end with: return robot, heading")
    return _sized(result[0], "narrow's robot", 4), _sized(result[1], "narrow's heading", 2)


def _sized(value, what, size):
    array = numbers(value, what)
    if array.shape != (size,):
        raise StudentError("malformed", f"{what} has shape {array.shape}, expected ({size},)")
    return array


DRIVES = {
    "10-predict": Drive(("predict",)),
    "10-edges": Drive(("edges",)),
    "10-heading": Drive(("sharpen",)),
    "10-ring": Drive(("ring",), run=rings),
    "10-narrow": Drive(("narrow",), run=looks, seconds=20.0),
}
