"""Drives of exercise 10: drives and sightings one by one, and None where nothing is left."""

import numpy as np

from slamlab.exercises.drives import Drive, rows, shaped
from slamlab.exercises.drives.several_values import stacked


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
    boxes = [np.zeros(4) if box is None else shaped(box, "ring", (4,)) for box in found]
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
    looked = (functions["narrow"](*row) for row in rows(inputs))
    return stacked(looked, "narrow", {"robot": (4,), "heading": (2,)})


DRIVES = {
    "10-predict": Drive(("predict",)),
    "10-edges": Drive(("edges",)),
    "10-heading": Drive(("sharpen",)),
    "10-ring": Drive(("ring",), run=rings),
    "10-narrow": Drive(("narrow",), run=looks, seconds=20.0),
}
