"""Function calls of exercise 10, boxes (interval arithmetic)."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall, StudentError, argument_rows
from classroom.exercises.function_calls.several_values import stack_values


def call_relaxed(functions, inputs):
    """Call "relaxed" with each row; return {"left": (m,) 0 for None, "box": (m, 4),
    "outliers": (m, n)}. Raise StudentError unless "relaxed" returns None, or a box and n flags.
    """
    found = [functions["relaxed"](boxes, int(q)) for boxes, q in argument_rows(inputs)]
    if any(isinstance(each, tuple | list) and each and each[0] is None for each in found):
        raise StudentError("malformed", "relaxed returned None and another value, not None alone")
    n = inputs["boxes"].shape[1]
    values = [(np.zeros(4), np.zeros(n)) if each is None else each for each in found]
    left = np.array([float(each is not None) for each in found])
    return {"left": left} | stack_values(values, "relaxed", {"box": (4,), "outliers": (n,)})


def call_narrow(functions, inputs):
    """Call "narrow" once per robot; return {"robot": (n, 4), "heading": (n, 2)}.
    Raise StudentError for any other shape.
    """
    looked = (functions["narrow"](*row) for row in argument_rows(inputs))
    return stack_values(looked, "narrow", {"robot": (4,), "heading": (2,)})


CALLS = {
    "10-predict": FunctionCall(("predict",)),
    "10-edges": FunctionCall(("edges",)),
    "10-heading": FunctionCall(("sharpen",)),
    "10-relaxed": FunctionCall(("relaxed",), run=call_relaxed),
    "10-narrow": FunctionCall(("narrow",), run=call_narrow, seconds=20.0),
}
