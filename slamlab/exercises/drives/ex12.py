"""Drives of exercise 12, three filters and one robot: motions, dates, intervals, drives."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows, shaped


def _counted(functions, inputs):
    """One interval a row; counts are whole numbers."""
    interval = functions["interval"]
    pairs = zip(*inputs.values(), strict=True)
    return {"result": np.array([_pair(interval(int(k), int(n)), "interval") for k, n in pairs])}


def _compared(functions, inputs):
    """One interval a row."""
    compare = functions["compare"]
    return {"result": np.array([_pair(compare(*row), "compare") for row in rows(inputs)])}


def _pair(value, function):
    found = numbers(value, function)
    if found.shape != (2,):
        raise StudentError("malformed", f"{function} returns two numbers: return low, high")
    return found


def _driven(functions, inputs):
    """The poses of each drive, whose scans hold as many sights as were counted."""
    relocalise, found = functions["relocalise"], []
    for start, motions, sights, counts, posts in rows(inputs):
        scans = [scan[: int(count)].copy() for scan, count in zip(sights, counts, strict=True)]
        poses = relocalise(start, motions, scans, posts)
        found.append(shaped(poses, "what relocalise returned", motions.shape))
    return {"poses": np.array(found)}


DRIVES = {
    "12-odometry": Drive(("odometry",)),
    "12-lost": Drive(("lost_since",)),
    "12-interval": Drive(("interval",), _counted),
    "12-paired": Drive(("compare",), _compared),
    "12-relocalise": Drive(("relocalise",), _driven),
}
