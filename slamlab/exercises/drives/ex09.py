"""Drives of exercise 09, SLAM with walls: one call per belief, scan after scan, run after run."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, shaped
from slamlab.exercises.drives.slam_step import SLAM_STEP


def _parts(value, function, names, shapes):
    """What a function returned, part by part."""
    if not isinstance(value, tuple | list) or len(value) != len(names):
        raise StudentError("malformed", f"{function} must end with: return {', '.join(names)}")
    parts = zip(value, names, shapes, strict=True)
    return [shaped(part, f"{function}'s {name}", shape) for part, name, shape in parts]


def _rows(inputs):
    for row in zip(*inputs.values(), strict=True):
        yield [np.array(a) if a.ndim else int(a) for a in row]


def _stacked(function, call, inputs, names, shapes):
    found = [_parts(call(*row), function, names, shapes) for row in _rows(inputs)]
    return {
        name: np.array(part) for name, part in zip(names, zip(*found, strict=True), strict=True)
    }


def _placed(functions, inputs):
    shapes = ((2,), (2, 2), (2, 3))
    return _stacked("place", functions["place"], inputs, ("line", "C", "X"), shapes)


def _updated(functions, inputs):
    n = inputs["x"].shape[1]
    return _stacked("update", functions["update"], inputs, ("x", "P"), ((n,), (n, n)))


def _lived(functions, inputs):
    """Scan after scan, the book handed from one to the next; what it held after each."""
    call, N, lives = functions["keep_book"], int(inputs["N"][0]), int(inputs["lives"][0])
    count = int(inputs["scans"].max()) + 1
    found = {
        name: np.zeros((len(inputs["scans"]), count)) for name in ("sightings", "left", "used")
    }
    book = {}
    for k, scan in enumerate(inputs["scans"]):
        seen = [int(i) for i in scan if i >= 0]  # a scan of fewer is filled up with -1
        value = call(dict(book), seen, N, lives)
        if not isinstance(value, tuple | list) or len(value) != 2 or not isinstance(value[0], dict):
            raise StudentError("malformed", "keep_book must end with: return book, used")
        book = {}
        for i, entry in value[0].items():
            if i not in range(count):
                raise StudentError("malformed", f"keep_book's book holds {i!r}, which was not seen")
            pair = numbers(entry, "keep_book's entry")
            if pair.shape != (2,):
                raise StudentError(
                    "malformed", "an entry of keep_book's book is (sightings, lives left)"
                )
            book[int(i)] = tuple(pair.tolist())
            found["sightings"][k, int(i)], found["left"][k, int(i)] = pair
        used = value[1]
        used = numbers(list(used) if isinstance(used, set | tuple) else used, "keep_book's used")
        if used.ndim != 1 or not np.isin(used, np.arange(count)).all():
            raise StudentError("malformed", "keep_book's used is a list of ids that were seen")
        for i in used.astype(int):
            found["used"][k, i] += 1
    return found


def _thinned(functions, inputs):
    """Scan after scan, what was kept handed on; lengths differ, so all stands in one table."""
    thin, spacing = functions["thin"], float(inputs["spacing"][0])
    kept, counts = np.empty((0, 2)), []
    for scan in inputs["scans"]:
        value = numbers(thin(kept.copy(), scan.copy(), spacing), "thin")
        if value.ndim != 2 or value.shape[1] != 2:
            raise StudentError("malformed", f"thin returned shape {value.shape}, expected (n, 2)")
        kept = value
        counts.append(len(kept))
    return {"kept": kept, "counts": np.array(counts)}


DRIVES = {
    "09-place": Drive(("place",), _placed),
    "09-update": Drive(("update",), _updated),
    "09-life": Drive(("keep_book",), _lived),
    "09-walls": SLAM_STEP,
    "09-thin": Drive(("thin",), _thinned),
}
