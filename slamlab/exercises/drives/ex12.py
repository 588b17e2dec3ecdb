"""Drives of exercise 12, three filters and one robot: motions, decisions, dates, intervals."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers

DOINGS = ("scan", "left", "right", "drive")


def _decided(functions, inputs):
    """One decision a row; what is done is told and asked for by its name."""
    decide, found = functions["decide"], []
    for doing, reading, driven in zip(*inputs.values(), strict=True):
        value = decide(DOINGS[int(doing)], float(reading), float(driven))
        if value is None:
            numbers(value, "decide")  # says that nothing was returned
        if not isinstance(value, str) or value not in DOINGS:
            raise StudentError(
                "malformed", f"decide returned {str(value)[:40]!r}, which is none of {DOINGS}"
            )
        found.append(DOINGS.index(value))
    return {"result": np.array(found, dtype=float)}


def _counted(functions, inputs):
    """One interval a row; counts are whole numbers."""
    interval = functions["interval"]
    pairs = zip(*inputs.values(), strict=True)
    found = [numbers(interval(int(k), int(n)), "interval") for k, n in pairs]
    if any(each.shape != (2,) for each in found):
        raise StudentError("malformed", "interval returns two numbers: return low, high")
    return {"result": np.array(found)}


DRIVES = {
    "12-odometry": Drive(("odometry",)),
    "12-decide": Drive(("decide",), _decided),
    "12-lost": Drive(("lost_since",)),
    "12-interval": Drive(("interval",), _counted),
}
