"""Drives of exercise 01: one call per input; numbers of steps and of poses are whole numbers."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows, shaped


def whole_steps(functions, inputs):
    """Call the function once per input, its first argument an int.

    Parameters
    ----------
    functions : the one function
    inputs : steps n, length d [m], heading error sigma [rad], (k,) each

    Returns
    -------
    {"result": (k,) [m]}

    Raises
    ------
    StudentError : "malformed" when a call does not return one number
    """
    ((name, function),) = functions.items()
    results = [
        numbers(function(int(n), float(d), float(sigma)), name)
        for n, d, sigma in zip(*inputs.values(), strict=True)
    ]
    wrong = next((r.shape for r in results if r.size != 1), None)
    if wrong is not None:
        raise StudentError("malformed", f"{name} returned shape {wrong}, expected one number")
    return {"result": np.array([r.item() for r in results])}


def _tracks(functions, inputs):
    """The track of each drive; where it was docked is a list of whole numbers."""
    ((name, function),) = functions.items()
    found = [
        shaped(function(start, steps, docked.astype(int).tolist()), name, (len(steps) + 1, 3))
        for start, steps, docked in rows(inputs)
    ]
    return {"result": np.array(found)}


DRIVES = {
    "01-next-pose": Drive(("next_pose",)),
    "01-seen-from": Drive(("seen_from",)),
    "01-drift": Drive(("drift",), run=whole_steps),
    "01-miss": Drive(("miss",)),
    "01-home": Drive(("home",), run=_tracks),
}
