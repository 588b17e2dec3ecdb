"""Function calls of exercise 01: one call per input."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_array,
    to_shaped_array,
)


def call_with_int(functions, inputs):
    """Call the function for each input with an int n; return {"result": (k,)}. Raise StudentError
    "malformed" if a call does not return one number."""
    ((name, function),) = functions.items()
    results = [
        to_array(function(int(n), float(d), float(sigma)), name)
        for n, d, sigma in zip(*inputs.values(), strict=True)
    ]
    wrong = next((r.shape for r in results if r.size != 1), None)
    if wrong is not None:
        raise StudentError("malformed", f"{name} returned shape {wrong}, expected one number")
    return {"result": np.array([r.item() for r in results])}


def call_with_docking(functions, inputs):
    ((name, function),) = functions.items()
    found = [
        to_shaped_array(
            function(start, steps, docked.astype(int).tolist()), name, (len(steps) + 1, 3)
        )
        for start, steps, docked in argument_rows(inputs)
    ]
    return {"result": np.array(found)}


CALLS = {
    "01-next-pose": FunctionCall(("next_pose",)),
    "01-seen-from": FunctionCall(("seen_from",)),
    "01-drift": FunctionCall(("drift",), run=call_with_int),
    "01-miss": FunctionCall(("miss",)),
    "01-home": FunctionCall(("home",), run=call_with_docking),
}
