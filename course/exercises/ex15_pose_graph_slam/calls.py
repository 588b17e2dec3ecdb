"""Function calls of exercise 15, pose graphs."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_shaped_array,
)


def _call_jacobians(functions, inputs):
    rows = argument_rows(inputs)
    return _named_results(functions, "jacobians", rows, {"A": (3, 3), "B": (3, 3)})


def _call_range_edge(functions, inputs):
    rows = argument_rows(inputs)
    return _named_results(functions, "range_edge", rows, {"e": (), "A": (3,), "B": (3,)})


def _call_gate_loop(functions, inputs):
    rows = [
        (poses, H, _edge_list([pair], [z], [information])[0], gates)
        for poses, H, pair, z, information, gates in argument_rows(inputs)
    ]
    return _named_results(functions, "gate_loop", rows, {"d2": (), "accepted": ()})


def _named_results(functions, name, rows, shapes):
    found = [functions[name](*row) for row in rows]
    if any(not isinstance(values, tuple | list) or len(values) != len(shapes) for values in found):
        raise StudentError("malformed", f"{name} must end with: return {', '.join(shapes)}")
    return {
        output: np.array(
            [to_shaped_array(values[k], f"{name}'s {output}", shape) for values in found]
        )
        for k, (output, shape) in enumerate(shapes.items())
    }


def _call_step(functions, inputs):
    found = []
    for poses, *edges in argument_rows(inputs):
        found.append(
            to_shaped_array(functions["step"](poses, _edge_list(*edges)), "step", poses.shape)
        )
    return {"result": np.array(found)}


def _call_close_loops(functions, inputs):
    found = []
    for poses, measured, information, *loops in argument_rows(inputs):
        chain = np.column_stack([np.arange(len(poses) - 1), np.arange(1, len(poses))])
        wheels = _edge_list(chain, measured, information)
        value = functions["close_loops"](poses, wheels, _edge_list(*loops))
        found.append(to_shaped_array(value, "close_loops", poses.shape))
    return {"result": np.array(found)}


def _edge_list(pairs, measured, information):
    edges = zip(pairs, measured, information, strict=True)
    return [(int(i), int(j), z, L) for (i, j), z, L in edges]


CALLS = {
    "15-jacobians": FunctionCall(("jacobians",), _call_jacobians),
    "15-step": FunctionCall(("step",), _call_step),
    "15-range": FunctionCall(("range_edge",), _call_range_edge),
    "15-gate": FunctionCall(("gate_loop",), _call_gate_loop),
    "15-false-loops": FunctionCall(("close_loops",), _call_close_loops),
}
