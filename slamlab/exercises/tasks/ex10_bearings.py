"""Exercise 10, bearings: robots that see an object, and what a sighting leaves of the heading."""

import numpy as np

from slamlab.exercises.tasks.ex10_motions import around
from slamlab.geometry import wrap

ROWS = 24
MEET = slice(0, 4)  # rows whose boxes overlap
SEAM, ON_SEAM = slice(9, None, 6), slice(6, None, 6)  # rows whose headings lie beyond it, and on it


def inputs(rng):
    """Robots that see an object; in every second row a seam lies among the bearings."""
    n = ROWS
    toward = np.where(np.arange(n) % 2, np.pi, 0) + rng.uniform(-0.15, 0.15, n)
    toward[n // 2 :: 2] = rng.uniform(-2.5, 2.5, n // 2 // 2)
    at = rng.uniform(-3, 3, (n, 2))
    far = rng.uniform(2, 4, n)
    far[MEET] = rng.uniform(0.02, 0.08, 4)
    far[SEAM] = 4.0  # bearings hardly differ there
    target = at + far[:, None] * np.column_stack([np.cos(toward), np.sin(toward)])
    robot, box = (_box_round(place, rng) for place in (at, target))
    robot[MEET], box[MEET] = _overlapping(at[MEET], target[MEET], rng)
    theta = rng.uniform(-3, 3, n)
    theta[SEAM] = np.pi + rng.uniform(0.45, 0.55, len(theta[SEAM]))
    theta[ON_SEAM] = np.pi + rng.uniform(-0.005, 0.005, len(theta[ON_SEAM]))
    bound = rng.uniform(0.03, 0.1, n)
    bearing = wrap(toward - theta + rng.uniform(-1, 1, n) * bound)
    # on one side the prior is the narrower, on the other what the sighting tells
    wide, narrow = rng.uniform(0.6, 1.0, n), rng.uniform(0.01, 0.05, n)
    right_wide = np.arange(n) % 4 < 2
    right_wide[SEAM] = (
        True  # so that right lies before the seam, and what the sighting tells behind
    )
    right = wrap(theta - np.where(right_wide, wide, narrow))
    return {
        "heading": np.column_stack([right, right + wide + narrow]),
        "robot": robot,
        "box": box,
        "bearing": bearing,
        "bound": bound,
    }


def _box_round(place, rng):
    """(n, 4) boxes that hold a place, off their middle."""
    half = rng.uniform(0.15, 0.35, (2, len(place)))
    middle = place.T + rng.uniform(-0.7, 0.7, (2, len(place))) * half
    return np.hstack([around(middle[0], half[0]), around(middle[1], half[1])])


def _overlapping(at, target, rng):
    """Boxes that meet on a narrow strip: the robot's lies on the object's side and vice versa.

    All but a few of their points see each other the other way, so their corners mislead.
    """
    ahead = np.sign(target[:, 0] - at[:, 0])
    half = rng.uniform(0.3, 0.5, (2, 2, len(at)))
    rim = rng.uniform(0.01, 0.02, (2, len(at)))
    found = []
    for place, side, (half_x, half_y), by in zip((at, target), (1, -1), half, rim, strict=True):
        middle = place[:, 0] + side * ahead * (half_x - by)
        found.append(np.hstack([around(middle, half_x), around(place[:, 1], half_y)]))
    return found


def overlap(given):
    """(n,) bool: the boxes of robot and object meet."""
    r, o = given["robot"], given["box"]
    x = (r[:, 0] <= o[:, 1]) & (o[:, 0] <= r[:, 1])
    return x & (r[:, 2] <= o[:, 3]) & (o[:, 2] <= r[:, 3])


def pairs(given):
    """(n, 16) bearings from every corner of the robot's box to every corner of the object's."""
    r, o = (
        np.stack([b[:, [0, 1, 1, 0]], b[:, [2, 2, 3, 3]]], axis=-1)
        for b in (given["robot"], given["box"])
    )
    d = (o[:, None] - r[:, :, None]).reshape(len(r), 16, 2)
    return np.arctan2(d[..., 1], d[..., 0])


def told(given, widened=1.0, sign=-1.0, offset=0.0, bearings=pairs):
    """(n, 2) what the sighting alone says of the heading, right ≤ left as numbers."""
    seen = bearings(given)
    first = seen[:, :1]
    span = first + wrap(seen - first)
    back = sign * given["bearing"] + offset
    ends = np.column_stack([span.min(axis=1), span.max(axis=1)]) + back[:, None]
    return ends + np.column_stack([-given["bound"], given["bound"]]) * widened


def both(a, b):
    """(n, 2) what two intervals (n, 2) have in common, whole turns taken off b."""
    shift = wrap(b.mean(axis=1) - a.mean(axis=1)) + a.mean(axis=1) - b.mean(axis=1)
    b = b + shift[:, None]
    return np.column_stack([np.maximum(a[:, 0], b[:, 0]), np.minimum(a[:, 1], b[:, 1])])


def sharpened(given, **changes):
    """(n, 2) the heading after the sighting; unchanged where boxes overlap."""
    found = both(given["heading"], told(given, **changes))
    return np.where(overlap(given)[:, None], given["heading"], found)
