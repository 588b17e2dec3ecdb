"""Function calls of exercise 13, scan matching."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    call_each,
    to_shaped_array,
)


def _call_matcher(functions, inputs):
    name, match = next(iter(functions.items()))

    def call(source, target, T, iterations, *c):
        return match(source, target, T, int(iterations), *c)

    return call_each({name: call}, inputs)


def _call_line_step(functions, inputs):
    found = []
    for row in argument_rows(inputs):
        value = functions["line_step"](*row)
        if not isinstance(value, tuple | list) or len(value) != 2:
            raise StudentError("malformed", "line_step must end with: return delta, P")
        delta, P = value
        found.append(
            (
                to_shaped_array(delta, "line_step's delta", (3,)),
                to_shaped_array(P, "line_step's P", (3, 3)),
            )
        )
    delta, P = zip(*found, strict=True)
    return {"delta": np.array(delta), "P": np.array(P)}


CALLS = {
    "13-best-motion": FunctionCall(("best_motion",)),
    "13-icp": FunctionCall(("icp",), _call_matcher),
    "13-kernel": FunctionCall(("robust_icp",), _call_matcher),
    "13-line-step": FunctionCall(("line_step",), _call_line_step),
    "13-overlap": FunctionCall(("match",)),
}
