"""Drives of exercise 10: boxes clipped, headings sharpened, rows of sightings taken in."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows


def clips(functions, inputs):
    """Call clip on every box and edge; None is an answer, too.

    Parameters
    ----------
    functions : "clip"
    inputs : boxes box (n, 4), half-planes edge (n, 3)

    Returns
    -------
    {"left": (n,) 1 where something is left and 0 where None, "box": (n, 4), zeros for None}

    Raises
    ------
    StudentError : "malformed" when a result is neither None nor four numbers
    """
    found = [functions["clip"](*row) for row in rows(inputs)]
    left = np.array([box is not None for box in found], dtype=float)
    boxes = [np.zeros(4) if box is None else _sized(box, "clip", 4) for box in found]
    return {"left": left, "box": np.array(boxes)}


def looks(functions, inputs):
    """Let each robot look at its objects in turn, what it believes handed on from sight to sight.

    Parameters
    ----------
    functions : "see"
    inputs : robot (n, 4), heading (n, 2), objects (n, m, 4), and of s sightings which (n, s),
        z (n, s, 2); bounds (n, 2)

    Returns
    -------
    {"robot": (n, s, 4), "heading": (n, s, 2), "object": (n, s, 4)} after each sighting; "left":
    (n, s) 1 until see returned None, after which a run is over and all is zero

    Raises
    ------
    StudentError : "malformed" when a call returns neither None nor a box, a heading and a box
    """
    n, s = inputs["which"].shape
    found = {"robot": np.zeros((n, s, 4)), "heading": np.zeros((n, s, 2))}
    found |= {"object": np.zeros((n, s, 4)), "left": np.zeros((n, s))}
    for run, (robot, heading, objects, which, z, bounds) in enumerate(rows(inputs)):
        for k, (i, sight) in enumerate(zip(which.astype(int), z, strict=True)):
            before = robot.copy(), heading.copy(), objects[i].copy()
            after = functions["see"](*before, sight.copy(), bounds.copy())
            if after is None:
                break
            robot, heading, objects[i] = _believed(after)
            for name, value in (("robot", robot), ("heading", heading), ("object", objects[i])):
                found[name][run, k] = value
            found["left"][run, k] = 1
    return found


def _believed(result):
    if not isinstance(result, tuple | list) or len(result) != 3:
        raise StudentError("malformed", "see must end with: return robot, heading, box")
    sizes = zip(result, ("robot", "heading", "box"), (4, 2, 4), strict=True)
    return [_sized(value, f"see's {name}", size) for value, name, size in sizes]


def _sized(value, what, size):
    array = numbers(value, what)
    if array.shape != (size,):
        raise StudentError("malformed", f"{what} has shape {array.shape}, expected ({size},)")
    return array


DRIVES = {
    "10-predict": Drive(("predict",)),
    "10-edges": Drive(("edges",)),
    "10-clip": Drive(("clip",), run=clips),
    "10-heading": Drive(("sharpen",)),
    "10-see": Drive(("see",), run=looks),
}
