"""Function calls of exercise 06: one call per estimate; whole runs step by step."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall
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


def _call_merge(functions, inputs):
    return _call_for_estimates(functions, inputs, added=-2)


CALLS = {
    "06-augment": FunctionCall(("augment",), _call_augment),
    "06-update": FunctionCall(("update",), _call_update),
    "06-slam": SLAM_STEP,
    "06-same": FunctionCall(("merge",), _call_merge),
    "06-false-sights": filter_call("careful_step"),
}
