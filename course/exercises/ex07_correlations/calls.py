"""Function calls of exercise 07: one call per input."""

from classroom.exercises.function_calls import FunctionCall, argument_rows
from classroom.exercises.function_calls.several_values import stack_values


def _call_two_updates(functions, inputs):
    calls = [functions["two_updates"](*row) for row in argument_rows(inputs)]
    return stack_values(calls, "two_updates", {"P_first": (7, 7), "P_both": (7, 7)})


def _call_correlated_update(functions, inputs):
    size = inputs["x"].shape[1]
    calls = [
        functions["update_rest"](x, P, seen.astype(int), x_seen, P_seen)
        for x, P, seen, x_seen, P_seen in argument_rows(inputs)
    ]
    return stack_values(calls, "update_rest", {"x": (size,), "P": (size, size)})


def _call_fuse(functions, inputs):
    calls = [functions["fuse"](*row) for row in argument_rows(inputs)]
    return stack_values(calls, "fuse", {"x": (2,), "P": (2, 2)})


def _call_lower_bound(functions, inputs):
    m = inputs["p"].shape[1]
    calls = [
        functions["lower_bound"](x, P, p, sigma, float(share))
        for x, P, p, sigma, share in argument_rows(inputs)
    ]
    return stack_values(calls, "lower_bound", {"L": (2 * m, 2 * m), "n": (m,)})


def _call_survey(functions, inputs):
    doors = int(inputs["door"].max()) + 1
    calls = [
        functions["survey"](morning.astype(int), door.astype(int), z, sigma)
        for morning, door, z, sigma in argument_rows(inputs)
    ]
    return stack_values(calls, "survey", {"p": (doors,), "P": (doors, doors)})


CALLS = {
    "07-two-updates": FunctionCall(("two_updates",), _call_two_updates),
    "07-update-rest": FunctionCall(("update_rest",), _call_correlated_update),
    "07-fuse": FunctionCall(("fuse",), _call_fuse),
    "07-bound": FunctionCall(("lower_bound",), _call_lower_bound),
    "07-mornings": FunctionCall(("survey",), _call_survey),
}
