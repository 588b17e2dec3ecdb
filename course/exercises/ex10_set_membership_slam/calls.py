"""Function calls of exercise 10, boxes (interval arithmetic)."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall, argument_rows, to_shaped_array
from classroom.exercises.function_calls.several_values import stack_values


def call_ring(functions, inputs):
    """Call "ring" with each row; return {"left": (n,) 0 for None, "box": (n, 4)}.
    Raise StudentError unless "ring" returns None or four numbers.
    """
    found = [functions["ring"](*row) for row in argument_rows(inputs)]
    left = np.array([box is not None for box in found], dtype=float)
    boxes = [np.zeros(4) if box is None else to_shaped_array(box, "ring", (4,)) for box in found]
    return {"left": left, "box": np.array(boxes).reshape(-1, 4)}


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
    "10-ring": FunctionCall(("ring",), run=call_ring),
    "10-narrow": FunctionCall(("narrow",), run=call_narrow, seconds=20.0),
}
