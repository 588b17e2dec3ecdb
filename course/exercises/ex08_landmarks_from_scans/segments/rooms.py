"""Scans of rooms with clutter for exercise 08, and the true walls."""
# Scans come in pairs of opposite errors. The truth is in no array: means of a pair lie exactly on
# their wall, means of clutter on no line.

import numpy as np

from course.exercises.ex08_landmarks_from_scans.lines import across, direction
from slamlab.simulation.worlds import World

CLUTTER = 0.25  # share of the beams that meet something that is no wall
EXACT = 1e-9  # m, off a wall's line
SMALL = 8  # who has fewer readings is not asked for


def _room(rng):
    w, h = rng.uniform(5, 8), rng.uniform(4, 6)
    a, b = rng.uniform(0.25, 0.4, 2) * (w, h)
    outline = np.array([(0, 0), (w, 0), (w, h - b), (w - a, h - b), (w - a, h), (0, h)])
    middle = rng.uniform((0.25 * w, 0.55 * h), (0.4 * w, 0.7 * h))
    way = direction(rng.uniform(0.3, 1.2))
    corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * rng.uniform(0.3, 0.6, 2)
    cupboard = middle + corners @ np.array([way, across(way)])
    walls = [np.hstack([c, np.roll(c, -1, axis=0)]) for c in (outline, cupboard)]
    return World(np.vstack(walls)), rng.uniform((0.35 * w, 0.15 * h), (0.6 * w, 0.25 * h))


def scans(rng, rooms=8, beams=180, share=0.015):
    """Two scans of each room with opposite range errors: points (2 rooms, beams, 2), relative σ (2
    rooms,)."""
    found, angles = [], np.linspace(-np.pi, np.pi, beams, endpoint=False)
    for _ in range(rooms):
        world, place = _room(rng)
        reach = world.cast(place, angles + rng.uniform(-np.pi, np.pi))
        error, clutter = share * rng.standard_normal(beams), rng.random(beams) < CLUTTER
        for sign in (1, -1):
            before = reach * rng.uniform(0.2, 0.95, beams)
            r = np.where(clutter, before, reach * (1 + sign * error))
            found.append(r[:, None] * direction(angles))
    return {"points": np.array(found), "share": np.full(2 * rooms, share)}


def walls(points):
    """Number of each reading's wall, (n, k); −1 for clutter."""
    found = []
    for middle in points.reshape(len(points) // 2, 2, -1, 2).mean(axis=1):
        n = len(middle)
        first = np.tile(np.arange(n), 4)
        second = (first + np.repeat([1, 2, 3, 4], n)) % n
        way = middle[second] - middle[first]
        normal = across(way / np.linalg.norm(way, axis=1, keepdims=True))
        off = normal @ middle.T - np.sum(normal * middle[first], axis=1)[:, None]
        on, labels = np.abs(off) < EXACT, np.full(n, -1)
        while (best := on[on.sum(axis=1).argmax()].copy()).sum() > 3:
            labels[best] = labels.max() + 1
            on &= ~best
        found += [labels, labels]
    return np.array(found)


def counts(got, want):
    """Readings shared by true and found walls (N + 1, m + 1), the last row clutter, the last column
    unlabelled; true walls of less than ``SMALL`` readings are left out."""
    names, sizes = np.unique(want, return_counts=True)
    asked = ~np.isin(want, names[(sizes < SMALL) & (names >= 0)])
    (rows, n), (columns, m) = (_numbered(labels[asked]) for labels in (want, got))
    return np.bincount(rows * (m + 1) + columns, minlength=(n + 1) * (m + 1)).reshape(n + 1, m + 1)


def _numbered(labels):
    names = np.unique(labels[labels >= 0])
    return np.where(labels >= 0, np.searchsorted(names, labels), len(names)), len(names)
