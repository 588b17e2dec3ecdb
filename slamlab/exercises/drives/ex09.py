"""Drives of exercise 09, SLAM with walls: one call per belief, scan after scan, drive after
drive."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, shaped

EMPTY = 99.0
"""Distance [m] that stands where a scan holds fewer walls than its array has rows."""


def _parts(value, function, names, shapes):
    """What a function returned, part by part."""
    if not isinstance(value, tuple | list) or len(value) != len(names):
        raise StudentError("malformed", f"{function} must end with: return {', '.join(names)}")
    parts = zip(value, names, shapes, strict=True)
    return [shaped(part, f"{function}'s {name}", shape) for part, name, shape in parts]


def _arguments(inputs):
    """The calls that inputs stand for; what counts is a whole number."""
    for row in zip(*inputs.values(), strict=True):
        yield [np.array(a) if a.ndim else a.item() for a in row]


def _stacked(names, shapes_of):
    """A drive's run that calls the first function on every row and stacks its parts by name."""

    def run(functions, inputs):
        function, call = next(iter(functions.items()))
        shapes = shapes_of(inputs["x"].shape[1])
        found = [_parts(call(*row), function, names, shapes) for row in _arguments(inputs)]
        return {
            name: np.array(part) for name, part in zip(names, zip(*found, strict=True), strict=True)
        }

    return run


def ids_of(scans):
    """(rows, k) the ids that stand in each row's scans, in order, filled up with −1."""
    found = [np.unique(row[row >= 0]) for row in scans]
    longest = max(map(len, found), default=0)
    return np.array([np.pad(ids, (0, longest - len(ids)), constant_values=-1) for ids in found])


def _lived(functions, inputs):
    """Scan after scan, the book handed from one to the next; what it held after each."""
    ids = ids_of(inputs["scans"])
    shape = *inputs["scans"].shape[:2], ids.shape[1]
    found = {name: np.zeros(shape) for name in ("inside", "left", "sightings", "used")}
    for row, scans in enumerate(inputs["scans"]):
        column = {int(i): k for k, i in enumerate(ids[row]) if i >= 0}
        N, lives, book = int(inputs["N"][row]), int(inputs["lives"][row]), {}
        for k, scan in enumerate(scans):
            seen = [int(i) for i in scan if i >= 0]  # a scan of fewer is filled up with -1
            book, used = _book(functions["keep_book"](dict(book), seen, N, lives), column)
            for i, pair in book.items():
                at = row, k, column[i]
                found["inside"][at], found["sightings"][at], found["left"][at] = 1, *pair
            for i in used:
                found["used"][row, k, column[i]] += 1
    return found


def _book(value, column):
    """A book and the ids used, from what keep_book returned."""
    if not isinstance(value, tuple | list) or len(value) != 2 or not isinstance(value[0], dict):
        raise StudentError("malformed", "keep_book must end with: return book, used")
    book = {}
    for i, entry in value[0].items():
        if i not in column:
            raise StudentError("malformed", f"keep_book's book holds {i!r}, which was not seen")
        pair = numbers(entry, "keep_book's entry")
        if pair.shape != (2,):
            raise StudentError("malformed", "an entry of the book is (sightings, lives left)")
        book[int(i)] = tuple(pair.tolist())
    used = value[1]
    used = numbers(list(used) if isinstance(used, set | tuple) else used, "keep_book's used")
    if used.ndim != 1 or not np.isin(used, list(column)).all():
        raise StudentError("malformed", "keep_book's used is a list of ids that were seen")
    return book, used.astype(int).tolist()


def _mapped(functions, inputs):
    """A map of each drive; how many walls each has, and all of them in one table."""
    maps = []
    for x, drives, scans in zip(inputs["x"], inputs["drives"], inputs["scans"], strict=True):
        lists = [scan[scan[:, 0] < EMPTY] for scan in scans]
        P, C, R = (inputs[name][0].copy() for name in "PCR")
        value = functions["clean_map"](x.copy(), P, drives.copy(), C, lists, R, inputs["far"][0])
        walls = numbers(value, "clean_map")
        if walls.size == 0:
            walls = np.zeros((0, 2))
        if walls.ndim != 2 or walls.shape[1] != 2:
            raise StudentError(
                "malformed", f"clean_map returned shape {walls.shape}, expected (k, 2)"
            )
        maps.append(walls)
    return {"walls": np.concatenate(maps), "counts": np.array([len(walls) for walls in maps])}


DRIVES = {
    "09-place": Drive(("place",), _stacked(("line", "C", "X"), lambda n: ((2,), (2, 2), (2, 3)))),
    "09-update": Drive(("update",), _stacked(("x", "P"), lambda n: ((n,), (n, n)))),
    "09-life": Drive(("keep_book",), _lived),
    "09-end": Drive(("end_point",), _stacked(("p", "C", "X"), lambda n: ((2,), (2, 2), (2, n)))),
    "09-ghosts": Drive(("clean_map",), _mapped),
}
