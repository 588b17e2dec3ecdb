"""Call a student's EKF-SLAM step in a loop over many runs (exercise 06)."""

from traceback import walk_tb

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    describe_exception,
    to_array,
)


def check_estimate(value, function, size):
    """Check a returned estimate, x (n,) and P (n, n). Raises StudentError."""
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function} must end with: return x, P")
    x, P = (to_array(part, f"{function}'s {name}") for part, name in zip(value, "xP", strict=True))
    n = len(x) if x.ndim == 1 and size is None else size
    for array, name, shape in ((x, "x", (n,)), (P, "P", (n, n))):
        if array.shape != shape:
            want = "a vector" if n is None else f"expected {shape}"
            raise StudentError("malformed", f"{function}'s {name} has shape {array.shape}, {want}")
    return x, P


def _run_filter(functions, inputs):
    """Run the filter on every run; return the last state, its covariance, and its ids."""
    name, step = next(iter(functions.items()))
    ends = [
        _one_run(step, name, inputs, x, u, z)
        for x, u, z in zip(inputs["x"], inputs["u"], inputs["z"], strict=True)
    ]
    if len({(len(x), len(ids)) for x, _, ids in ends}) > 1:
        raise StudentError("malformed", _explain_sizes(name, [ids.tolist() for *_, ids in ends]))
    x, P, ids = map(np.array, zip(*ends, strict=True))
    return {"x": x, "P": P, "ids": ids}


def _explain_sizes(name, maps):
    """Explain why the maps of different runs have different sizes: an id may stand in one twice."""
    for ids in maps:
        if twice := [i for k, i in enumerate(ids) if i in ids[:k]]:
            return (
                f"{name}'s ids contain {twice[0]:g} twice. Is a landmark new if its measurement is "
                "rejected?"
            )
    return f"{name}'s map has different sizes in different runs"


def _one_run(step, name, inputs, x, controls, observations):
    P, ids, C, R = inputs["P"], [], inputs["C"], inputs["R"]
    for u, seen, z in zip(controls, inputs["seen"], observations, strict=True):
        there = seen >= 0  # a scan of fewer landmarks is padded with -1
        try:
            value = step(
                np.array(x), np.array(P), list(ids), u.copy(), seen[there].tolist(), z[there],
                C.copy(), R.copy(),
            )  # fmt: skip
        except (IndexError, ValueError) as error:
            _explain_id_as_index(error, seen)
            raise
        if not isinstance(value, tuple | list) or len(value) != 3:
            raise StudentError("malformed", f"{name} must end with: return x, P, ids")
        x, P = check_estimate(value[:2], name, None)
        ids = _whole(value[2], name)
    return x, P, np.array(ids, dtype=float)


def _explain_id_as_index(error, seen):
    """Explain an error in which j is an id instead of an index: ids begin at 30."""
    for frame, _ in walk_tb(error.__traceback__):
        j = frame.f_locals.get("j")
        if frame.f_code.co_name in ("update", "H_full") and isinstance(j, int) and j in seen:
            raise StudentError(
                "raised",
                f"{describe_exception(error)}. Here j = {j} is the id of a landmark, but its index "
                f"in the state is needed, counted from 0: ids.index({j})",
            ) from None


def _whole(ids, name):
    ids = to_array(ids, f"{name}'s ids")
    if ids.ndim != 1:
        raise StudentError("malformed", f"{name}'s ids have shape {ids.shape}, expected a list")
    return [int(i) if np.isfinite(i) else i for i in ids]


def filter_call(function):
    """Create the call of a filter step from the name of its function."""
    return FunctionCall((function,), _run_filter)


SLAM_STEP = filter_call("slam_step")
