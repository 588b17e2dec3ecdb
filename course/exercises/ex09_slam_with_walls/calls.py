"""Function calls of exercise 09, SLAM with walls."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall, StudentError, to_array, to_shaped_array

EMPTY = 99.0
"""Distance [m] that pads a scan with fewer walls than its array has rows."""


def _split_values(value, function, names, shapes):
    if not isinstance(value, tuple | list) or len(value) != len(names):
        raise StudentError("malformed", f"{function} must end with: return {', '.join(names)}")
    parts = zip(value, names, shapes, strict=True)
    return [to_shaped_array(part, f"{function}'s {name}", shape) for part, name, shape in parts]


def _arguments(inputs):
    for row in zip(*inputs.values(), strict=True):
        yield [np.array(a) if a.ndim else a.item() for a in row]


def _named_results(names, shapes_of):
    """Make a call that runs the first function on each row and stacks its results by name."""

    def run(functions, inputs):
        function, call = next(iter(functions.items()))
        shapes = shapes_of(inputs["x"].shape[1])
        found = [_split_values(call(*row), function, names, shapes) for row in _arguments(inputs)]
        return {
            name: np.array(part) for name, part in zip(names, zip(*found, strict=True), strict=True)
        }

    return run


def ids_of(scans):
    """Return the sorted ids in the scans of each row, padded with −1: (rows, k)."""
    found = [np.unique(row[row >= 0]) for row in scans]
    longest = max(map(len, found), default=0)
    return np.array([np.pad(ids, (0, longest - len(ids)), constant_values=-1) for ids in found])


def _call_keep_book(functions, inputs):
    ids = ids_of(inputs["scans"])
    shape = *inputs["scans"].shape[:2], ids.shape[1]
    found = {name: np.zeros(shape) for name in ("inside", "left", "observations", "used")}
    for row, scans in enumerate(inputs["scans"]):
        column = {int(i): k for k, i in enumerate(ids[row]) if i >= 0}
        N, lives, book = int(inputs["N"][row]), int(inputs["lives"][row]), {}
        for k, scan in enumerate(scans):
            seen = [int(i) for i in scan if i >= 0]  # a scan of fewer ids is padded with -1
            book, used = _book(functions["keep_book"](dict(book), seen, N, lives), column)
            for i, pair in book.items():
                at = row, k, column[i]
                found["inside"][at], found["observations"][at], found["left"][at] = 1, *pair
            for i in used:
                found["used"][row, k, column[i]] += 1
    return found


def _book(value, column):
    if not isinstance(value, tuple | list) or len(value) != 2 or not isinstance(value[0], dict):
        raise StudentError("malformed", "keep_book must end with: return book, used")
    book = {}
    for i, entry in value[0].items():
        if i not in column:
            raise StudentError("malformed", f"keep_book's book has an id that was not seen: {i!r}")
        pair = to_array(entry, "keep_book's entry")
        if pair.shape != (2,):
            raise StudentError(
                "malformed", "an entry of the book must be two numbers (`observations`, lives left)"
            )
        book[int(i)] = tuple(pair.tolist())
    used = value[1]
    used = to_array(list(used) if isinstance(used, set | tuple) else used, "keep_book's used")
    if used.ndim != 1 or not np.isin(used, list(column)).all():
        raise StudentError("malformed", "keep_book's used must be a list of ids that were seen")
    return book, used.astype(int).tolist()


def _call_clean_map(functions, inputs):
    maps = []
    for x, controls, scans in zip(inputs["x"], inputs["us"], inputs["scans"], strict=True):
        lists = [scan[scan[:, 0] < EMPTY] for scan in scans]
        P, C, R = (inputs[name][0].copy() for name in "PCR")
        value = functions["clean_map"](x.copy(), P, controls.copy(), C, lists, R, inputs["far"][0])
        walls = to_array(value, "clean_map")
        if walls.size == 0:
            walls = np.zeros((0, 2))
        if walls.ndim != 2 or walls.shape[1] != 2:
            raise StudentError(
                "malformed", f"clean_map returned shape {walls.shape}, expected (k, 2)"
            )
        maps.append(walls)
    return {"walls": np.concatenate(maps), "counts": np.array([len(walls) for walls in maps])}


CALLS = {
    "09-place": FunctionCall(
        ("place",), _named_results(("line", "C", "X"), lambda n: ((2,), (2, 2), (2, 3)))
    ),
    "09-life": FunctionCall(("keep_book",), _call_keep_book),
    "09-merge": FunctionCall(
        ("merge",),
        _named_results(("d2", "x", "P"), lambda n: ((), (n - 2,), (n - 2, n - 2))),
    ),
    "09-end": FunctionCall(
        ("end_point",), _named_results(("p", "C", "X"), lambda n: ((2,), (2, 2), (2, n)))
    ),
    "09-clean-map": FunctionCall(("clean_map",), _call_clean_map),
}
