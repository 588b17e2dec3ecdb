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


def _call_alternate(functions, inputs):
    """Call alternate for each run; return xs, Ps of every step, and p (runs, N, 2), L (runs, N, 2,
    2) of the map with ids in ascending order."""
    found = {name: [] for name in ("xs", "Ps", "p", "L")}
    for row in argument_rows(inputs | {"ids": inputs["ids"].astype(int)}):
        ids = row[3].astype(int)
        result = functions["alternate"](*row[:3], ids, *row[4:])
        if not isinstance(result, tuple | list) or len(result) != 3:
            raise StudentError("malformed", "alternate: expected three results, xs, Ps, map")
        for name, part, shape in zip(("xs", "Ps"), result[:2], ((3,), (3, 3)), strict=True):
            part = to_shaped_array(part, f"alternate's {name}", (len(ids), *shape))
            found[name].append(part)
        p, L = _landmark_estimates(result[2], ids[ids >= 0])
        found["p"].append(np.reshape(p, (-1, 2)))
        found["L"].append(np.reshape(L, (-1, 2, 2)))
    return {name: np.array(parts) for name, parts in found.items()}


def _landmark_estimates(estimates, ids):
    if not isinstance(estimates, dict):
        what = "None" if estimates is None else type(estimates).__name__
        raise StudentError(
            "malformed", f"alternate returned {what}, expected a dict as map: id to (p, P)"
        )
    seen = sorted(set(ids.tolist()))
    for id in seen:
        if id not in estimates:
            raise StudentError("malformed", f"alternate: the observed landmark {id} has no entry")
    if len(estimates) != len(seen):
        what = f"{len(estimates)} entries, but {len(seen)} landmarks were observed"
        raise StudentError("malformed", f"alternate returned {what}")
    pairs = [_pair(estimates[id], "alternate's entry", ("p", "P"), ((2,), (2, 2))) for id in seen]
    return [p for p, _ in pairs], [P for _, P in pairs]


def _pair(value, function, names, shapes):
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function}: expected a pair, {', '.join(names)}")
    parts = zip(value, names, shapes, strict=True)
    return [to_shaped_array(part, f"{function}'s {name}", shape) for part, name, shape in parts]


CALLS = {
    "05-locate": FunctionCall(("locate",), _call_for_estimates),
    "05-localise": FunctionCall(("localise",), _call_for_runs),
    "05-alternate": FunctionCall(("alternate",), _call_alternate),
    "05-ranges": FunctionCall(("locate_by_ranges",), _call_for_estimates),
    "05-lost": FunctionCall(("find_yourself",), _call_for_runs),
}
