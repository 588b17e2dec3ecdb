"""Runs that return to their dock, with odometry that scales every turn by one factor."""
# All runs of a set follow one route. The route is in no array: the errors have mean 0 over all
# runs, so the judge knows it.

from itertools import pairwise

import numpy as np

from course.exercises.ex01_why_slam.motions import chain

DRIVES, STEP = 16, 0.5  # runs of a set, approximate length of a step [m]
LEAST, MOST = 0.01, 0.18  # relative error of the reported turns: between these
TURN, LENGTH = 0.010, 0.015  # σ of each turn [rad], σ of each length, relative
CROOKED = 0.015  # how far a wall's points lie from its line [m]: no turn is quite 0


def drives(rng, drives=DRIVES, sides=(1, 1, -1), tail=True):
    """Runs of some laps, with steps after if ``tail``: start (d, 3), steps (d, n, 3), docked (d,
    laps). ``drives`` is even, ``sides`` are 1 (left) or -1 (right)."""
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
    """The true poses, (n + 1, 3)."""
    return chain(inputs["start"][0], inputs["steps"].mean(axis=0))


def closed(inputs):
    """Positions x + iy (d, n) after each step, with one factor for a run and both gaps of a lap
    distributed evenly over its steps."""
    steps, docked = inputs["steps"], inputs["docked"][0]
    laps = list(pairwise([0, *docked]))
    told = np.stack([steps[:, a:b, 2].sum(axis=1) for a, b in laps])
    turns = steps[..., 2] / (np.abs(told).mean(axis=0) / (2 * np.pi))[:, None]
    found = []
    for a, b in [*laps, (docked[-1], steps.shape[1])]:
        turn, shares = turns[:, a:b], np.arange(1, b - a + 1) / (b - a)
        total = turn.sum(axis=1, keepdims=True)
        if b <= docked[-1]:
            turn = turn + (2 * np.pi * np.sign(total) - total) / (b - a)
        headings = inputs["start"][:, 2:] + np.cumsum(turn, axis=1) - turn
        z = np.cumsum(steps[:, a:b, 0] * np.exp(1j * headings), axis=1)
        found.append(z - shares * z[:, -1:] if b <= docked[-1] else z)
    return np.concatenate(found, axis=1) + inputs["start"][:, :1] + 1j * inputs["start"][:, 1:2]


def _house(rng, side):
    """Corners x + iy of a lap that begins and ends in a wall."""
    a, b = rng.uniform(4, 6, 2)
    first = rng.uniform(1.5, a - 1.5)
    corners = np.array([0, first, first + 1j * b, first - a + 1j * b, first - a, 0])
    corners[1:-1] += rng.uniform(-0.6, 0.6, 4) + 1j * rng.uniform(-0.6, 0.6, 4)
    return corners if side > 0 else corners.conj()


def _beyond(rng):
    turns = rng.choice([-1, 1]) * rng.uniform(1.1, 1.7, 4)
    legs = rng.uniform(3.0, 4.5, 4) * np.exp(1j * np.cumsum(turns))
    return np.append(0, np.cumsum(legs))


def _points(rng, corners):
    points = []
    for a, b in pairwise(corners):
        count = round(abs(b - a) / STEP)
        points += [a + (b - a) * k / count for k in range(count)]
    points = np.array([*points, corners[-1]])
    points[1:-1] += CROOKED * rng.uniform(-1, 1, len(points) - 2)
    points[1:-1] += 1j * CROOKED * rng.uniform(-1, 1, len(points) - 2)
    return points


def _steps(points):
    # the last turn is into the first direction
    ways = np.diff(points)
    turns = np.angle(np.roll(ways, -1) / ways)
    return np.column_stack([np.abs(ways), 0 * turns, turns])


def _errors(rng, *shape):
    # their mean over the runs is 0
    errors = rng.standard_normal(shape)
    return (errors - errors.mean(axis=0)) * np.sqrt(shape[0] / (shape[0] - 1))
