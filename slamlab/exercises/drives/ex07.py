"""How exercise 07, correlations, is driven: one call per input, the corridor run step by step."""

import numpy as np

from slamlab.exercises.drives import Drive, rows
from slamlab.exercises.drives.several_values import parts, stacked


def _updates(functions, inputs):
    """Both covariances of every pair of observations."""
    calls = [functions["two_updates"](*row) for row in rows(inputs)]
    return stacked(calls, "two_updates", {"P_first": (7, 7), "P_both": (7, 7)})


def _heard(functions, inputs):
    """Every state after what was heard; entries are counted by whole numbers."""
    size = inputs["x"].shape[1]
    calls = [
        functions["hearsay"](x, P, seen.astype(int), x_seen, P_seen)
        for x, P, seen, x_seen, P_seen in rows(inputs)
    ]
    return stacked(calls, "hearsay", {"x": (size,), "P": (size, size)})


def _fused(functions, inputs):
    """Every pair of estimates fused."""
    calls = [functions["fuse"](*row) for row in rows(inputs)]
    return stacked(calls, "fuse", {"x": (2,), "P": (2, 2)})


def _walked(functions, inputs):
    """The end of every walk along the corridor: each step starts from what the last returned."""
    step, ends = functions["step"], []
    names = "d", "q", "i", "z", "r"
    size = inputs["x"].shape[1]
    shapes = {"x": (size,), "P": (size, size)}
    for run in range(len(inputs["x"])):
        x, P = inputs["x"][run].copy(), inputs["P"][run].copy()
        for d, q, i, z, r in zip(*(inputs[name][run].tolist() for name in names), strict=True):
            x, P = parts(step(x, P, d, q, int(i), z, r), "step", shapes)
        ends.append((x, P))
    x, P = zip(*ends, strict=True)
    return {"x": np.array(x), "P": np.array(P)}


def _surveyed(functions, inputs):
    """The map of every corridor; mornings and doors are counted by whole numbers."""
    doors = int(inputs["door"].max()) + 1
    calls = [
        functions["survey"](morning.astype(int), door.astype(int), z, sigma)
        for morning, door, z, sigma in rows(inputs)
    ]
    return stacked(calls, "survey", {"p": (doors,), "P": (doors, doors)})


DRIVES = {
    "07-two-updates": Drive(("two_updates",), _updates),
    "07-hearsay": Drive(("hearsay",), _heard),
    "07-fuse": Drive(("fuse",), _fused),
    "07-corridor": Drive(("step",), _walked),
    "07-mornings": Drive(("survey",), _surveyed),
}
