"""Function calls of exercise 06: one call per estimate; whole runs step by step."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall, StudentError, to_shaped_array
from classroom.exercises.function_calls.slam_step import SLAM_STEP, check_estimate, filter_call


def _call_for_estimates(functions, inputs, added=0):
    name, function = next(iter(functions.items()))
    n = inputs["x"].shape[1] + added
    found = [check_estimate(function(*row), name, n) for row in _arguments(inputs)]
    return {"x": np.array([x for x, _ in found]), "P": np.array([P for _, P in found])}


def _arguments(inputs):
    # indices of landmarks are int
    for row in zip(*inputs.values(), strict=True):
        yield [np.array(a) if a.ndim else int(a) for a in row]


def _call_augment(functions, inputs):
    return _call_for_estimates(functions, inputs, added=2)


def _call_update(functions, inputs):
    return _call_for_estimates(functions, inputs)


def _call_consistency(functions, inputs):
    """Call consistency for each experiment; return {"nis": (n, 3), "nees": (n, 3), "known": (n,)},
    zeros for None, and for nan if the true pose is unknown."""
    found = {"nis": [], "nees": [], "known": []}
    for x, P, u, seen, z, C, R, end in zip(*inputs.values(), strict=True):
        ids = [row[row >= 0].tolist() for row in seen]  # a scan is padded with -1
        scans = [[scan[row >= 0] for scan, row in zip(run, seen, strict=True)] for run in z]
        end = None if np.isnan(end).any() else end.copy()
        copies = [array.copy() for array in (x, P, u)]
        value = functions["consistency"](*copies, ids, scans, C.copy(), R.copy(), end)
        if not isinstance(value, tuple | list) or len(value) != 2:
            raise StudentError("malformed", "consistency must end with: return nis, nees")
        nees = np.zeros(3) if value[1] is None else value[1]
        nees = to_shaped_array(nees, "consistency's nees", (3,))
        if end is None and np.isnan(nees).all():
            nees = np.zeros(3)  # in place of None: only the law about None is broken
        found["nis"].append(to_shaped_array(value[0], "consistency's nis", (3,)))
        found["nees"].append(nees)
        found["known"].append(float(value[1] is not None))
    return {name: np.array(values) for name, values in found.items()}


CALLS = {
    "06-augment": FunctionCall(("augment",), _call_augment),
    "06-update": FunctionCall(("update",), _call_update),
    "06-slam": SLAM_STEP,
    "06-consistent": FunctionCall(("consistency",), _call_consistency),
    "06-outliers": filter_call("careful_step"),
}
