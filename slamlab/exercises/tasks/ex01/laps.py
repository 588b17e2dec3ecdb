"""Drives that come back to their dock, on wheels that misjudge every turn by one factor.

All drives of a set follow one route; what the wheels tell of it is their own. The route is in no
array: the errors have the mean 0 over all drives, so the judge knows it.
"""

from itertools import pairwise

import numpy as np

from slamlab.exercises.tasks.ex01.motions import chain

DRIVES, STEP = 16, 0.5  # drives of a set, length of a step [m], nearly
LEAST, MOST = 0.01, 0.18  # a turn is told too large or too small by a share between these
TURN, LENGTH = 0.010, 0.015  # σ of each turn beside that [rad], σ of each length, as a share
CROOKED = 0.015  # how far a wall's points lie from its line [m]: no turn is quite 0


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
    laps = [_steps(_points(rng, _house(rng, side))) for side in rng.permutation(sides)]
    beyond = [_steps(_points(rng, _beyond(rng)))] if tail else []
    route = np.concatenate([*laps, *beyond])
    docked = np.cumsum([len(lap) for lap in laps])
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


def _house(rng, side):
    """The corners of a lap, as x + iy, from its start in a wall back to it; none is quite right."""
    a, b = rng.uniform(4, 6, 2)
    first = rng.uniform(1.5, a - 1.5)
    corners = np.array([0, first, first + 1j * b, first - a + 1j * b, first - a, 0])
    corners[1:-1] += rng.uniform(-0.6, 0.6, 4) + 1j * rng.uniform(-0.6, 0.6, 4)
    return corners if side > 0 else corners.conj()


def _beyond(rng):
    """The corners of the way after the last lap, which winds to one side."""
    turns = rng.choice([-1, 1]) * rng.uniform(1.1, 1.7, 4)
    legs = rng.uniform(3.0, 4.5, 4) * np.exp(1j * np.cumsum(turns))
    return np.append(0, np.cumsum(legs))


def _points(rng, corners):
    """Points half a metre apart from corner to corner, a little beside the straight lines."""
    points = []
    for a, b in pairwise(corners):
        count = round(abs(b - a) / STEP)
        points += [a + (b - a) * k / count for k in range(count)]
    points = np.array([*points, corners[-1]])
    points[1:-1] += CROOKED * rng.uniform(-1, 1, len(points) - 2)
    points[1:-1] += 1j * CROOKED * rng.uniform(-1, 1, len(points) - 2)
    return points


def _steps(points):
    """The steps from point to point; the last turn is into the first direction, as in a lap."""
    ways = np.diff(points)
    turns = np.angle(np.roll(ways, -1) / ways)
    return np.column_stack([np.abs(ways), 0 * turns, turns])


def _errors(rng, *shape):
    """Errors with variance 1 whose mean over the drives is 0."""
    errors = rng.standard_normal(shape)
    return (errors - errors.mean(axis=0)) * np.sqrt(shape[0] / (shape[0] - 1))
