"""Drives that come back to their dock, on wheels that misjudge every turn by one factor.

All drives of a set follow one route; what the wheels tell of it is their own. The route is in no
array: the errors have the mean 0 over all drives, so the judge knows it.
"""

import numpy as np

from slamlab.exercises.tasks.ex01.motions import chain

DRIVES, STEP = 16, 0.5  # drives of a set, length of a step [m]
LEAST, MOST = 0.05, 0.10  # a turn is told too large or too small by a share between these
TURN, LENGTH = 0.012, 0.015  # σ of each turn beside that [rad], σ of each length, as a share


def drives(rng, drives=DRIVES, sides=(1, 1, -1), tail=True):
    """Drives of some laps, each of which ends in the dock, and perhaps of a way beyond.

    Parameters
    ----------
    rng : numpy.random.Generator
    drives : int, an even number
    sides : of each lap, 1 to the left or -1 to the right; in a random order
    tail : bool, whether the robot drives on after its last lap

    Returns
    -------
    dict of start (d, 3), steps (d, n, 3), docked (d, laps): rows of the track
    """
    legs, docked = [], []
    for side in rng.permutation(sides):
        a, b = rng.integers(8, 13, 2)
        first = rng.integers(3, a - 2)
        legs += [(first, side), (b, side), (a, side), (b, side), (a - first, 0)]
        docked.append(sum(length for length, _ in legs))
    if tail:
        legs += [(6, 1), (8, -1), (6, -1), (8, 0)]
    route = np.concatenate([_leg(*leg) for leg in legs])
    factors = rng.permutation(np.outer([1, -1], np.linspace(LEAST, MOST, drives // 2)).ravel())
    steps = np.tile(route, (drives, 1, 1))
    steps[..., 0] *= 1 + LENGTH * _errors(rng, drives, len(route))
    steps[..., 2] *= 1 + factors[:, None]
    steps[..., 2] += TURN * _errors(rng, drives, len(route))
    start = np.append(rng.uniform(-5, 5, 2), rng.uniform(-3, 3))
    return {
        "start": np.tile(start, (drives, 1)),
        "steps": steps,
        "docked": np.tile(docked, (drives, 1)),
    }


def route(inputs):
    """(n + 1, 3) the poses as they were in truth."""
    return chain(inputs["start"][0], inputs["steps"].mean(axis=0))


def _leg(length, side):
    """Steps straight ahead, with a quarter turn to a side, or none, after the last."""
    steps = np.tile([STEP, 0.0, 0.0], (length, 1))
    steps[-1, 2] = side * np.pi / 2
    return steps


def _errors(rng, *shape):
    """Errors with variance 1 whose mean over the drives is 0."""
    errors = rng.standard_normal(shape)
    return (errors - errors.mean(axis=0)) * np.sqrt(shape[0] / (shape[0] - 1))
