"""The drive of a whole filter, such as slam_step, over many runs: exercise 06."""

from traceback import walk_tb

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, describe, numbers


def belief(value, function, size):
    """What a function returned as a belief.

    Parameters
    ----------
    value : anything
    function : str, its name, for the message
    size : int n, or None for any

    Returns
    -------
    x (n,), P (n, n)

    Raises
    ------
    StudentError : "malformed" when it is none
    """
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function} must end with: return x, P")
    x, P = (numbers(part, f"{function}'s {name}") for part, name in zip(value, "xP", strict=True))
    n = len(x) if x.ndim == 1 and size is None else size
    for array, name, shape in ((x, "x", (n,)), (P, "P", (n, n))):
        if array.shape != shape:
            want = "a vector" if n is None else f"expected {shape}"
            raise StudentError("malformed", f"{function}'s {name} has shape {array.shape}, {want}")
    return x, P


def _driven(functions, inputs):
    """Every run from its start to its end: the last state, its covariance, the ids in it."""
    name, step = next(iter(functions.items()))
    ends = [
        _one_run(step, name, inputs, x, u, z)
        for x, u, z in zip(inputs["x"], inputs["u"], inputs["z"], strict=True)
    ]
    if len({(len(x), len(ids)) for x, _, ids in ends}) > 1:
        raise StudentError("malformed", f"{name}'s map differs in size from run to run")
    x, P, ids = map(np.array, zip(*ends, strict=True))
    return {"x": x, "P": P, "ids": ids}


def _one_run(step, name, inputs, x, drives, sights):
    P, ids, C, R = inputs["P"], [], inputs["C"], inputs["R"]
    for u, seen, z in zip(drives, inputs["seen"], sights, strict=True):
        there = seen >= 0  # a scan of fewer landmarks is filled up with -1
        try:
            value = step(
                np.array(x), np.array(P), list(ids), u.copy(), seen[there].tolist(), z[there],
                C.copy(), R.copy(),
            )  # fmt: skip
        except (IndexError, ValueError) as error:
            _tell_id_from_index(error, seen)
            raise
        if not isinstance(value, tuple | list) or len(value) != 3:
            raise StudentError("malformed", f"{name} must end with: return x, P, ids")
        x, P = belief(value[:2], name, None)
        ids = _whole(value[2], name)
    return x, P, np.array(ids, dtype=float)


def _tell_id_from_index(error, seen):
    """Say so where a function was asked for landmark j and j is an id: ids begin at 30."""
    for frame, _ in walk_tb(error.__traceback__):
        j = frame.f_locals.get("j")
        if frame.f_code.co_name in ("update", "H_full") and isinstance(j, int) and j in seen:
            raise StudentError(
                "raised",
                f"{describe(error)}. There j = {j} is a landmark's id; what is wanted is its "
                f"place in the state, counted from 0, which is ids.index({j})",
            ) from None


def _whole(ids, name):
    ids = numbers(ids, f"{name}'s ids")
    if ids.ndim != 1:
        raise StudentError("malformed", f"{name}'s ids have shape {ids.shape}, expected a list")
    return [int(i) if np.isfinite(i) else i for i in ids]


def drive_of(function):
    """The drive of a filter's step by the name of the function that takes it."""
    return Drive((function,), _driven)


SLAM_STEP = drive_of("slam_step")
