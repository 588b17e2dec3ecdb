"""Drives of exercise 05: beliefs are pairs, runs are driven one by one, maps are dicts."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, rows, shaped


def _beliefs(functions, inputs, names=("x", "P"), shapes=((3,), (3, 3))):
    """Call the first function on every input and keep the two parts of each belief apart.

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
    name, function = next(iter(functions.items()))
    pairs = [_pair(function(*row), name, names, shapes) for row in rows(inputs)]
    return {part: np.array([pair[k] for pair in pairs]) for k, part in enumerate(names)}


def _runs(functions, inputs):
    """Call the first function on every run; ids (m, n) are whole numbers.

    Returns
    -------
    {"xs": (m, n, 3), "Ps": (m, n, 3, 3)}
    """
    n = inputs["ids"].shape[1]
    whole = inputs | {"ids": inputs["ids"].astype(int)}
    return _beliefs(functions, whole, ("xs", "Ps"), ((n, 3), (n, 3, 3)))


def _mapped(functions, inputs):
    """Call build_map on every run.

    Parameters
    ----------
    functions : "build_map"
    inputs : xs (m, n, 3), ids (m, n), zs (m, n, 2), R (m, 2, 2)

    Returns
    -------
    {"p": (m, N, 2), "P": (m, N, 2, 2)}, ids ascending; N is the same in all runs

    Raises
    ------
    StudentError : "malformed" when a landmark is missing, is too many or is no pair p, P
    """
    maps = [
        _landmarks(functions["build_map"](xs, ids.astype(int), zs, R), ids.astype(int))
        for xs, ids, zs, R in rows(inputs)
    ]
    p, P = ([one[k] for one in maps] for k in (0, 1))
    return {"p": np.reshape(p, (len(maps), -1, 2)), "P": np.reshape(P, (len(maps), -1, 2, 2))}


def _landmarks(beliefs, ids):
    """The beliefs of a dict as lists of p (2,) and P (2, 2), ids ascending."""
    if not isinstance(beliefs, dict):
        what = "None" if beliefs is None else type(beliefs).__name__
        raise StudentError("malformed", f"build_map returned {what}, expected a dict: id to p, P")
    seen = sorted(set(ids.tolist()))
    for id in seen:
        if id not in beliefs:
            raise StudentError("malformed", f"build_map: landmark {id} was seen, but has no entry")
    if len(beliefs) != len(seen):
        what = f"{len(beliefs)} entries, but {len(seen)} landmarks were seen"
        raise StudentError("malformed", f"build_map returned {what}")
    pairs = [_pair(beliefs[id], "build_map's entry", ("p", "P"), ((2,), (2, 2))) for id in seen]
    return [p for p, _ in pairs], [P for _, P in pairs]


def _pair(value, function, names, shapes):
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function}: expected a pair, {' and '.join(names)}")
    parts = zip(value, names, shapes, strict=True)
    return [shaped(part, f"{function}'s {name}", shape) for part, name, shape in parts]


DRIVES = {
    "05-locate": Drive(("locate",), _beliefs),
    "05-localise": Drive(("localise",), _runs),
    "05-map": Drive(("build_map",), _mapped),
    "05-ranges": Drive(("locate_by_ranges",), _beliefs),
    "05-lost": Drive(("find_yourself",), _runs),
}
