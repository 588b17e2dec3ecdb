"""Function calls of exercise 05: estimates are pairs, maps are dicts, one call per run."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_shaped_array,
)


def _call_for_estimates(functions, inputs, names=("x", "P"), shapes=((3,), (3, 3))):
    name, function = next(iter(functions.items()))
    pairs = [_pair(function(*row), name, names, shapes) for row in argument_rows(inputs)]
    return {part: np.array([pair[k] for pair in pairs]) for k, part in enumerate(names)}


def _call_for_runs(functions, inputs):
    n = inputs["ids"].shape[1]
    whole = inputs | {"ids": inputs["ids"].astype(int)}
    return _call_for_estimates(functions, whole, ("xs", "Ps"), ((n, 3), (n, 3, 3)))


def _call_build_map(functions, inputs):
    """Call build_map for each run; return {"p": (m, N, 2), "P": (m, N, 2, 2)} with ids in ascending
    order."""
    maps = [
        _landmark_estimates(functions["build_map"](xs, ids.astype(int), zs, R), ids.astype(int))
        for xs, ids, zs, R in argument_rows(inputs)
    ]
    p, P = ([one[k] for one in maps] for k in (0, 1))
    return {"p": np.reshape(p, (len(maps), -1, 2)), "P": np.reshape(P, (len(maps), -1, 2, 2))}


def _landmark_estimates(estimates, ids):
    if not isinstance(estimates, dict):
        what = "None" if estimates is None else type(estimates).__name__
        raise StudentError("malformed", f"build_map returned {what}, expected a dict: id to (p, P)")
    seen = sorted(set(ids.tolist()))
    for id in seen:
        if id not in estimates:
            raise StudentError("malformed", f"build_map: the observed landmark {id} has no entry")
    if len(estimates) != len(seen):
        what = f"{len(estimates)} entries, but {len(seen)} landmarks were observed"
        raise StudentError("malformed", f"build_map returned {what}")
    pairs = [_pair(estimates[id], "build_map's entry", ("p", "P"), ((2,), (2, 2))) for id in seen]
    return [p for p, _ in pairs], [P for _, P in pairs]


def _pair(value, function, names, shapes):
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function}: expected a pair, {', '.join(names)}")
    parts = zip(value, names, shapes, strict=True)
    return [to_shaped_array(part, f"{function}'s {name}", shape) for part, name, shape in parts]


CALLS = {
    "05-locate": FunctionCall(("locate",), _call_for_estimates),
    "05-localise": FunctionCall(("localise",), _call_for_runs),
    "05-map": FunctionCall(("build_map",), _call_build_map),
    "05-ranges": FunctionCall(("locate_by_ranges",), _call_for_estimates),
    "05-lost": FunctionCall(("find_yourself",), _call_for_runs),
}
