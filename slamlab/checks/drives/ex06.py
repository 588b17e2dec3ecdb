"""Drives of exercise 06, EKF-SLAM: one call per belief, and whole runs step by step."""

from traceback import walk_tb

import numpy as np

from slamlab.checks.drives import Drive, StudentError, describe, numbers


def _belief(value, function, size):
    """x (n,) and P (n, n) as a function returned them; ``size`` n, or None for any."""
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function} must end with: return x, P")
    x, P = (numbers(part, f"{function}'s {name}") for part, name in zip(value, "xP", strict=True))
    n = len(x) if x.ndim == 1 and size is None else size
    for array, name, shape in ((x, "x", (n,)), (P, "P", (n, n))):
        if array.shape != shape:
            want = "a vector" if n is None else f"expected {shape}"
            raise StudentError(
                "malformed", f"{function} returned an {name} of shape {array.shape}, {want}"
            )
    return x, P


def _beliefs(functions, inputs, grows=0):
    """Call the first function on every belief and keep the two results apart."""
    name, function = next(iter(functions.items()))
    n = inputs["x"].shape[1] + grows
    found = [_belief(function(*row), name, n) for row in _rows(inputs)]
    return {"x": np.array([x for x, _ in found]), "P": np.array([P for _, P in found])}


def _rows(inputs):
    """The calls that inputs stand for; what counts landmarks is a whole number."""
    for row in zip(*inputs.values(), strict=True):
        yield [np.array(a) if a.ndim else int(a) for a in row]


def _predicted(functions, inputs):
    return _beliefs(functions, inputs)


def _augmented(functions, inputs):
    return _beliefs(functions, inputs, grows=2)


def _updated(functions, inputs):
    return _beliefs(functions, inputs)


def _observed(functions, inputs):
    H_full = functions["H_full"]
    found = [numbers(H_full(*row), "H_full") for row in _rows(inputs)]
    want = (2, inputs["x"].shape[1])
    for H in found:
        if H.shape != want:
            turned = " (transposed?)" if H.shape == want[::-1] else ""
            raise StudentError("malformed", f"H_full has shape {H.shape}, expected {want}{turned}")
    return {"H": np.array(found)}


def _driven(functions, inputs):
    """Every run from its start to its end: the last state, its covariance, the ids in it."""
    ends = [
        _one_run(functions["slam_step"], inputs, x, u, z)
        for x, u, z in zip(inputs["x"], inputs["u"], inputs["z"], strict=True)
    ]
    if len({(len(x), len(ids)) for x, _, ids in ends}) > 1:
        raise StudentError("malformed", "slam_step's map differs in size from run to run")
    x, P, ids = map(np.array, zip(*ends, strict=True))
    return {"x": x, "P": P, "ids": ids}


def _one_run(slam_step, inputs, x, drives, sights):
    P, ids, C, R = inputs["P"], [], inputs["C"], inputs["R"]
    for u, seen, z in zip(drives, inputs["seen"], sights, strict=True):
        there = seen >= 0  # a scan of fewer landmarks is filled up with -1
        try:
            value = slam_step(
                np.array(x), np.array(P), list(ids), u.copy(), seen[there].tolist(), z[there],
                C.copy(), R.copy(),
            )  # fmt: skip
        except (IndexError, ValueError) as error:
            _tell_id_from_index(error, seen)
            raise
        if not isinstance(value, tuple | list) or len(value) != 3:
            raise StudentError("malformed", "slam_step must end with: return x, P, ids")
        x, P = _belief(value[:2], "slam_step", None)
        ids = _whole(value[2])
    return x, P, np.array(ids, dtype=float)


def _tell_id_from_index(error, seen):
    """Say so where a function was asked for landmark j and j is an id: ids begin at 30."""
    for frame, _ in walk_tb(error.__traceback__):
        j = frame.f_locals.get("j")
        if frame.f_code.co_name in ("update", "H_full") and isinstance(j, int) and j in seen:
            raise StudentError(
                "raised",
                f"{describe(error)}. There j = {j} is an id; the index of landmark i in the state "
                "is ids.index(i)",
            ) from None


def _whole(ids):
    ids = numbers(ids, "slam_step's ids")
    if ids.ndim != 1:
        raise StudentError("malformed", f"slam_step's ids have shape {ids.shape}, expected a list")
    return [int(i) if np.isfinite(i) else i for i in ids]


DRIVES = {
    "06-predict": Drive(("predict",), _predicted),
    "06-augment": Drive(("augment",), _augmented),
    "06-h": Drive(("H_full",), _observed),
    "06-update": Drive(("update",), _updated),
    "06-slam": Drive(("slam_step",), _driven),
}
