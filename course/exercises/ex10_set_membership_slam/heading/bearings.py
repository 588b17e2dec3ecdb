"""Robots that measure a landmark, and contraction of the heading by a bearing."""

import numpy as np

from course.exercises.ex10_set_membership_slam.boxes import boxes_around, off, wrapped

ROWS = 24


def inputs(rng):
    """Four rows have overlapping boxes; in many rows an angle crosses π."""
    k = np.arange(ROWS)
    toward = np.where(k % 2, np.pi, 0) + rng.uniform(-0.15, 0.15, ROWS)
    toward[12::2] = rng.uniform(-2.5, 2.5, 6)
    theta = rng.uniform(-3, 3, ROWS)
    theta[6::6], theta[9::6] = np.pi + rng.uniform(-0.02, 0.02, 3), np.pi + rng.uniform(0.4, 0.5, 3)
    # at one end the prior is the narrower, at the other the measurement
    wide, narrow = rng.uniform(0.6, 1.0, ROWS), rng.uniform(0.01, 0.05, ROWS)
    right_wide = (k % 4 < 2) | (k % 6 == 3)
    before = np.where(right_wide, wide, narrow)
    given = observations(rng, toward, theta, before, wide + narrow - before)
    meet = _strips(rng, toward[:4])
    return {name: np.concatenate([meet.get(name, a[:4]), a[4:]]) for name, a in given.items()}


def observations(rng, toward, theta, before, behind, size=(0.15, 0.35), bound=(0.03, 0.1)):
    """Measurements in directions (n,), headings that reach before and behind the true one."""
    n = len(toward)
    at = rng.uniform(-3, 3, (n, 2))
    target = at + rng.uniform(2, 4, (n, 1)) * np.column_stack([np.cos(toward), np.sin(toward)])
    half = rng.uniform(*size, (2, n, 2))
    bounds = rng.uniform(*bound, n)
    return {
        "heading": wrapped(theta - before, before + behind),
        "robot": boxes_around(at + rng.uniform(-0.7, 0.7, (n, 2)) * half[0], half[0]),
        "box": boxes_around(target + rng.uniform(-0.7, 0.7, (n, 2)) * half[1], half[1]),
        "bearing": off(toward - theta + rng.uniform(-1, 1, n) * bounds),
        "bound": bounds,
    }


def _strips(rng, toward):
    # on most of the strip robot and object see each other the other way: corners mislead
    n, ahead = len(toward), np.sign(np.cos(toward))[:, None] * [1, 0]
    half, at = rng.uniform(0.3, 0.5, (2, n, 2)), rng.uniform(-3, 3, (n, 2))
    aside = rng.uniform(-0.05, 0.05, (n, 2)) * [0, 1]
    rim = rng.uniform(0.01, 0.02, (n, 1))
    return {
        "robot": boxes_around(at + ahead * (half[0] - rim), half[0]),
        "box": boxes_around(at - ahead * (half[1] - rim) + aside, half[1]),
    }


def _any(rng, n, before, behind, **more):
    toward, theta = rng.uniform(-np.pi, np.pi, (2, n))
    return observations(rng, toward, theta, np.full(n, before), np.full(n, behind), **more)


def exact(rng):
    """Positions and bearings of zero width; then headings of zero width."""
    points = _any(rng, 6, 0.4, 0.6, size=(0, 0), bound=(0, 0))
    heading = _any(rng, 6, 0, 0)
    return {name: np.concatenate([points[name], heading[name]]) for name in points}


def across_pi(rng):
    """Landmarks in the west, robots that face west, or both."""
    k = np.arange(16)
    toward = np.where(k % 4 < 2, np.pi, -1) + rng.uniform(-0.1, 0.1, 16)
    theta = np.where(k % 2, np.pi, 0.5) + rng.uniform(-0.1, 0.1, 16)
    before = np.where(k < 8, 0.7, 0.03)
    return observations(rng, toward, theta, before, 0.73 - before)


def side_by_side(rng):
    """Boxes that do not overlap along one axis only."""
    k = np.arange(16)
    given = observations(
        rng, k % 4 * np.pi / 2, rng.uniform(-3, 3, 16), *rng.uniform(0.1, 0.9, (2, 16))
    )
    return given | {"robot": given["robot"] + 0.5 * np.array([-1, 1, -1, 1]) * _across(k % 4)}


def _across(k):
    """(n, 4) 1 for the sides across a direction of the compass."""
    return np.where((k % 2)[:, None], [1, 1, 0, 0], [0, 0, 1, 1])


def far_round(rng):
    """Headings of more than half a turn, the true one right, in the middle and left."""
    before = np.array([0.1, 1.8, 3.6] * 6)
    toward, theta = rng.uniform(-np.pi, np.pi, (2, 18))
    return observations(rng, toward, theta, before, 3.7 - before)


def narrowed(rng):
    """Headings to be narrowed on both sides, far from the origin."""
    given, away = _any(rng, 40, 1.2, 1.3), rng.uniform(-40, 40, (40, 2)).repeat(2, axis=1)
    return given | {name: given[name] + away for name in ("robot", "box")}


def inside(rng):
    """Headings narrower than those by the measurement."""
    given = _any(rng, 12, 0.01, 0.01, bound=(0.05, 0.1))
    middle = given["heading"].mean(axis=1)
    toward = np.arctan2(*_middles(given).T[::-1])
    return given | {"bearing": off(toward - middle)}


def meeting(rng):
    """One box inside the other, crossing it, or over its corner."""
    n, at = 36, rng.uniform(-3, 3, (36, 2))
    size = np.array(
        [[1, 1, 0.2, 0.2], [0.2, 0.2, 1, 1], [1, 0.2, 0.2, 1], [0.5, 0.5, 0.5, 0.5]] * 9
    )
    size = size * rng.uniform(0.8, 1.2, (n, 4))
    aside = np.where(np.arange(n) % 4 == 3, 0.5, 0.1)[:, None] * rng.choice([-1, 1], (n, 2))
    given = _any(rng, n, 0.5, 0.8)
    return given | {
        "robot": boxes_around(at, size[:, :2]),
        "box": boxes_around(at + aside, size[:, 2:]),
    }


def close_together(rng):
    """Boxes that almost touch: the measured interval is wider than π, the heading at one end."""
    k, at, half = np.arange(16), rng.uniform(-3, 3, (16, 2)), rng.uniform(0.3, 0.5, (2, 16, 2))
    toward = np.column_stack([np.cos(k * np.pi / 2), np.sin(k * np.pi / 2)])
    apart = half.sum(axis=0) + rng.uniform(0.01, 0.03, (16, 1))
    given = {
        "robot": boxes_around(at, half[0]),
        "box": boxes_around(at + toward * apart, half[1]),
        "bearing": rng.uniform(-np.pi, np.pi, 16),
        "bound": rng.uniform(0.2, 0.4, 16),
    }
    before, behind = rng.uniform(0.05, 0.2, (2, 16))
    return {"heading": wrapped(told(given)[k, k // 4 % 2] - before, before + behind)} | given


def overlap(given):
    """(n,) bool: the boxes of robot and object meet."""
    r, o = given["robot"], given["box"]
    x = (r[:, 0] <= o[:, 1]) & (o[:, 0] <= r[:, 1])
    return x & (r[:, 2] <= o[:, 3]) & (o[:, 2] <= r[:, 3])


def _middles(given):
    between = given["box"] - given["robot"]
    return np.column_stack([between[:, :2].mean(axis=1), between[:, 2:].mean(axis=1)])


def told(given):
    """(n, 2) the heading by the measurement alone, [right, left]; its extremes are at corners."""
    r, o = given["robot"], given["box"]
    middle = np.arctan2(*_middles(given).T[::-1])
    corners = [
        np.arctan2(o[:, v] - r[:, 5 - v], o[:, u] - r[:, 1 - u]) for u in (0, 1) for v in (2, 3)
    ]
    span = off(np.stack(corners, axis=1) - middle[:, None])
    ends = np.column_stack([span.min(axis=1), span.max(axis=1)])
    beyond = np.column_stack([-given["bound"], given["bound"]])
    return ends + (middle - given["bearing"])[:, None] + beyond


def sharpened(given):
    """The heading after the measurement; unchanged where boxes overlap."""
    heading, seen = given["heading"], told(given)
    between = seen.mean(axis=1) - heading.mean(axis=1)
    seen = seen + (off(between) - between)[:, None]  # on the same turn
    right, left = np.maximum(heading[:, 0], seen[:, 0]), np.minimum(heading[:, 1], seen[:, 1])
    found = np.column_stack([right, left]) + (off(right) - right)[:, None]  # right up to π
    return {"result": np.where(overlap(given)[:, None], heading, found)}
