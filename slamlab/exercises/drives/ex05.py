"""Drives of exercise 05: beliefs are pairs, runs are driven one by one, maps are dicts."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows


def beliefs(functions, inputs, names=("x", "P"), shapes=((3,), (3, 3))):
    """Call the function on every input and keep the two parts of each belief apart.

    Parameters
    ----------
    functions : the one function
    inputs : in the order of its arguments
    names, shapes : of the two results

    Returns
    -------
    name to (n, ...)

    Raises
    ------
    StudentError : "malformed" when a call does not return two arrays of these shapes
    """
    ((function, call),) = functions.items()
    pairs = [_pair(call(*row), function, names, shapes) for row in rows(inputs)]
    return {name: np.array([pair[k] for pair in pairs]) for k, name in enumerate(names)}


def landmark_beliefs(functions, inputs):
    """The same for a landmark's belief p, P."""
    return beliefs(functions, inputs, ("p", "P"), ((2,), (2, 2)))


def localised(functions, inputs):
    """Call localise on every run.

    Parameters
    ----------
    functions : "localise"
    inputs : x, P, drives (m, n, 2), ids (m, n), zs (m, n, 2), landmarks, C, R

    Returns
    -------
    {"xs": (m, n, 3), "Ps": (m, n, 3, 3)}

    Raises
    ------
    StudentError : "malformed"
    """
    n = inputs["ids"].shape[1]
    whole = inputs | {"ids": inputs["ids"].astype(int)}
    return beliefs(functions, whole, ("xs", "Ps"), ((n, 3), (n, 3, 3)))


def mapped(functions, inputs):
    """Call build_map on every run, and once more on what was seen of one landmark alone.

    Parameters
    ----------
    functions : "build_map"
    inputs : xs (m, n, 3), ids (m, n), zs (m, n, 2), R (m, 2, 2), alone (m,), an id of each run

    Returns
    -------
    {"p": (m, N, 2), "P": (m, N, 2, 2), "alone_p": (m, 2), "alone_P": (m, 2, 2)}, ids ascending

    Raises
    ------
    StudentError : "malformed" when a landmark is missing or is no pair p, P
    """
    build_map, found = functions["build_map"], {"p": [], "P": [], "alone_p": [], "alone_P": []}
    for xs, ids, zs, R, alone in rows(inputs):
        ids = ids.astype(int)
        for prefix, keep in (("", ids == ids), ("alone_", ids == int(alone))):
            seen = ids[keep]
            p, P = _landmarks(build_map(xs[keep], seen.copy(), zs[keep], R.copy()), seen)
            found[prefix + "p"].append(p[0] if prefix else p)
            found[prefix + "P"].append(P[0] if prefix else P)
    return {name: np.array(parts) for name, parts in found.items()}


def _landmarks(beliefs, ids):
    """The beliefs of a dict as arrays p (N, 2) and P (N, 2, 2), ids ascending."""
    if not isinstance(beliefs, dict):
        what = "nothing" if beliefs is None else type(beliefs).__name__
        raise StudentError("malformed", f"build_map returned {what}, expected a dict: id to p, P")
    pairs = []
    for id in sorted(set(ids.tolist())):
        if id not in beliefs:
            raise StudentError("malformed", f"build_map: landmark {id} was seen, but has no entry")
        pairs.append(_pair(beliefs[id], "build_map's entry", ("p", "P"), ((2,), (2, 2))))
    p, P = zip(*pairs, strict=True)
    return np.array(p), np.array(P)


def _pair(value, function, names, shapes):
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function}: expected a pair, {' and '.join(names)}")
    parts = []
    for part, name, shape in zip(value, names, shapes, strict=True):
        array = numbers(part, f"{function}'s {name}")
        if array.shape != shape:
            raise StudentError(
                "malformed", f"{function}'s {name} has shape {array.shape}, expected {shape}"
            )
        parts.append(array)
    return parts


DRIVES = {
    "05-predict": Drive(("predict",), run=beliefs),
    "05-locate": Drive(("locate",), run=beliefs),
    "05-localise": Drive(("localise",), run=localised),
    "05-landmark": Drive(("update_landmark",), run=landmark_beliefs),
    "05-map": Drive(("build_map",), run=mapped),
}
