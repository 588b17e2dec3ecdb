"""Function calls of exercise 12, three filters."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_array,
    to_shaped_array,
)


def _call_errors(functions, inputs):
    errors, found = functions["trajectory_errors"], []
    for estimate, truth, steps in argument_rows(inputs):
        value = errors(estimate, truth, int(steps))
        found.append(_pair(value, "trajectory_errors", "ate, rpe"))
    ate, rpe = np.transpose(found)
    return {"ate": ate, "rpe": rpe}


def _call_interval(functions, inputs):
    interval = functions["interval"]
    pairs = zip(*inputs.values(), strict=True)
    return {"result": np.array([_pair(interval(int(k), int(n)), "interval") for k, n in pairs])}


def _call_compare(functions, inputs):
    compare = functions["compare"]
    return {"result": np.array([_pair(compare(*row), "compare") for row in argument_rows(inputs)])}


def _pair(value, function, names="low, high"):
    found = to_array(value, function)
    if found.shape != (2,):
        raise StudentError("malformed", f"{function} must return two numbers: return {names}")
    return found


def _call_relocalise(functions, inputs):
    relocalise, found = functions["relocalise"], []
    for start, motions, observations, counts, posts in argument_rows(inputs):
        scans = [
            scan[: int(count)].copy() for scan, count in zip(observations, counts, strict=True)
        ]
        poses = relocalise(start, motions, scans, posts)
        found.append(to_shaped_array(poses, "what relocalise returned", motions.shape))
    return {"poses": np.array(found)}


CALLS = {
    "12-odometry": FunctionCall(("odometry",)),
    "12-ate": FunctionCall(("trajectory_errors",), _call_errors),
    "12-interval": FunctionCall(("interval",), _call_interval),
    "12-paired": FunctionCall(("compare",), _call_compare),
    "12-relocalise": FunctionCall(("relocalise",), _call_relocalise),
}
