"""The worker's side of the fake exercise."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall, argument_rows, call_each, to_array


def _sums(functions, inputs):
    total = functions["total"]
    return {"sums": np.array([to_array(total(*row), "total") for row in argument_rows(inputs)])}


def _doubled(functions, inputs):
    return call_each(functions, {"a": inputs["a"][:, 0]})


CALLS = {
    "99-double": FunctionCall(("double",), _doubled, seconds=3.0),
    "99-turn": FunctionCall(("turn",), seconds=3.0),
    "99-total": FunctionCall(("total", "double"), _sums, seconds=3.0),
}
