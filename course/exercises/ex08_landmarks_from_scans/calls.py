"""Function calls of exercise 08: results are tuples or None."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_array,
    to_shaped_array,
)


def call_associate(functions, inputs):
    """Call associate for each scene; return {"pairs": (n, m)}, −1 for None. Raise StudentError
    "malformed" unless it returns m entries, each an integer below N or None."""
    walls = inputs["expected"].shape[1]
    rows = [
        _numbers(functions["associate"](*row), "associate", len(row[0]), walls)
        for row in argument_rows(inputs)
    ]
    return {"pairs": np.array(rows, dtype=float).reshape(inputs["z"].shape[:2])}


def call_joint(functions, inputs):
    """Call associate_jointly for each scene; return {"pairs": (n, m), "d2": (n,)}. Raise
    StudentError "malformed" unless it returns m entries as associate does, and a number."""
    name, walls, rows, d2 = "associate_jointly", inputs["expected"].shape[1], [], []
    for row in argument_rows(inputs):
        pairs, distance = _two_values(functions[name](*row), name, "pairs, d2")
        rows.append(_numbers(pairs, name, len(row[0]), walls))
        d2.append(to_shaped_array(distance, f"{name}'s d2", ()))
    pairs = np.array(rows, dtype=float).reshape(inputs["z"].shape[:2])
    return {"pairs": pairs, "d2": np.array(d2)}


def _numbers(pairs, function, count, walls):
    """The wall of each of ``count`` measurements, −1 for None."""
    if pairs is None or isinstance(pairs, str | dict) or not hasattr(pairs, "__len__"):
        raise StudentError(
            "malformed", f"{function} must return a list with one entry per observation"
        )
    if len(pairs) != count:
        raise StudentError(
            "malformed", f"{function} returned {len(pairs)} entries for {count} observations"
        )
    return [-1 if entry is None else _wall_number(entry, function, walls) for entry in pairs]


def _wall_number(entry, function, walls):
    number = to_array(entry, f"{function}'s entry")
    if number.shape != () or number != np.floor(number) or not 0 <= number < walls:
        which = f"a wall's number, 0 to {walls - 1}, or None" if walls else "None: no wall is known"
        raise StudentError("malformed", f"{function}: each entry must be {which}")
    return float(number)


def call_pillar_functions(functions, inputs):
    """Call fit_circle for each arc and find_pillar for each point cloud, with separate generators.
    Return {"circle": (n, 3), "found": (n,) 0 or 1, "pillar": (n, 3), "inside": (n, k)}, zeros for
    None. Raise StudentError "malformed" for other results."""
    n, k = inputs["points"].shape[:2]
    circle = [_circle(functions["fit_circle"](arc.copy()), "fit_circle") for arc in inputs["arc"]]
    out = {"found": np.zeros(n), "pillar": np.zeros((n, 3)), "inside": np.zeros((n, k))}
    clouds = {name: array for name, array in inputs.items() if name != "arc"}
    for row, (points, band, largest, needed, tries, seed) in enumerate(argument_rows(clouds)):
        rng = np.random.default_rng(int(seed))
        found = functions["find_pillar"](points, band, largest, int(needed), int(tries), rng)
        if found is None:
            continue
        if not isinstance(found, tuple | list) or len(found) != 3:
            raise StudentError(
                "malformed", "find_pillar must return centre, radius, inside, or None"
            )
        out["found"][row] = 1
        out["pillar"][row] = _circle(found[:2], "find_pillar")
        out["inside"][row] = _mask(found[2], k)
    return {"circle": np.array(circle)} | out


def _circle(value, function):
    centre, radius = _two_values(value, function, "centre, radius")
    centre = to_shaped_array(centre, f"{function}'s centre", (2,))
    return np.append(centre, to_shaped_array(radius, f"{function}'s radius", ()))


def _mask(inside, k):
    array = to_array(inside, "find_pillar's inside")
    if array.shape != (k,) or not np.isin(array, [0, 1]).all():
        raise StudentError(
            "malformed",
            f"find_pillar's inside must have a bool for each point: shape ({k},), True or False",
        )
    return array


def call_segment(functions, inputs):
    """Call segment for each scan; return {"labels": (n, k)}. Raise StudentError "malformed" unless
    it returns k integers that are at least −1."""
    k = inputs["points"].shape[1]
    labels = [
        to_shaped_array(functions["segment"](*row), "segment", (k,))
        for row in argument_rows(inputs)
    ]
    if any((one != np.floor(one)).any() or (one < -1).any() for one in labels):
        raise StudentError("malformed", "segment: labels must be integers of at least −1")
    return {"labels": np.array(labels)}


def _two_values(value, function, names):
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function} must end with: return {names}")
    return value


CALLS = {
    "08-fit-line": FunctionCall(("fit_line",)),
    "08-associate": FunctionCall(("associate",), run=call_associate),
    "08-joint": FunctionCall(("associate_jointly",), run=call_joint),
    "08-pillar": FunctionCall(("fit_circle", "find_pillar"), run=call_pillar_functions),
    "08-segments": FunctionCall(("segment",), run=call_segment),
}
