"""Exercise 08, ways to pair sightings with walls: the right one, and those seen in the wild."""

import numpy as np

from slamlab.geometry import wrap

GATE = 9.21  # χ² of 2 degrees: 99 %


def squared(inputs, by="inverse", wrapped=True):
    """(n, m, N) distances of sightings to walls, by default vᵀ S⁻¹ v.

    Parameters
    ----------
    inputs : z (n, m, 2), expected (n, N, 2), S (n, N, 2, 2)
    by : "inverse" for S⁻¹, "S" for S, "nothing" for the identity, "diagonal" for that of S alone
    wrapped : bool, whether the angle of v is
    """
    v = inputs["z"][:, :, None] - inputs["expected"][:, None]
    if wrapped:
        v[..., 1] = wrap(v[..., 1])
    S = inputs["S"]
    weights = {
        "inverse": lambda: np.linalg.inv(S),
        "S": lambda: S,
        "nothing": lambda: np.broadcast_to(np.eye(2), S.shape),
        "diagonal": lambda: np.linalg.inv(S * np.eye(2)),
        "entries": lambda: 1 / S,
    }
    return np.einsum("nmki,nkij,nmkj->nmk", v, weights[by](), v)


def nearest_first(distances, gate):
    """(n, m) pairs made from the nearest on; −1 for a new wall."""
    pairs = np.full(distances.shape[:2], -1)
    for scene, row in zip(distances, pairs, strict=True):
        left = np.where(scene <= gate, scene, np.inf)
        while np.isfinite(left).any():
            i, j = np.unravel_index(left.argmin(), left.shape)
            row[i] = j
            left[i], left[:, j] = np.inf, np.inf
    return pairs


def in_turn(distances, gate, first=False):
    """(n, m) each sighting in its turn takes the nearest wall left, or the first in the gate."""
    pairs = np.full(distances.shape[:2], -1)
    for scene, row in zip(distances, pairs, strict=True):
        left = np.where(scene <= gate, scene, np.inf)
        for i, options in enumerate(left):
            if np.isfinite(options).any():
                j = np.isfinite(options).argmax() if first else options.argmin()
                row[i] = j
                left[:, j] = np.inf
    return pairs


def each_alone(distances, gate, first=False):
    """(n, m) each sighting takes its wall, whoever else has it."""
    inside = distances <= gate
    best = inside.argmax(axis=2) if first else np.where(inside, distances, np.inf).argmin(axis=2)
    return np.where(inside.any(axis=2), best, -1)


MISTAKES = {
    "euclid": lambda i: nearest_first(squared(i, "nothing"), GATE),
    "S-not-inverted": lambda i: nearest_first(squared(i, "S"), GATE),
    "unwrapped": lambda i: nearest_first(squared(i, wrapped=False), GATE),
    "diagonal": lambda i: nearest_first(squared(i, "diagonal"), GATE),
    "entries": lambda i: nearest_first(squared(i, "entries"), GATE),
    "not-squared": lambda i: nearest_first(squared(i), GATE**2),
    "gate-forgotten": lambda i: nearest_first(squared(i), np.inf),
    "in-turn": lambda i: in_turn(squared(i), GATE),
    "first-found": lambda i: in_turn(squared(i), GATE, first=True),
    "first-found, again": lambda i: each_alone(squared(i), GATE, first=True),
    "each-alone": lambda i: each_alone(squared(i), GATE),
    "no-gate, alone": lambda i: squared(i).argmin(axis=2),
}
