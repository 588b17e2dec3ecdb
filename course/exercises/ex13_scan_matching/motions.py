"""Motions and clouds of exercise 13, and rigid alignment."""

import numpy as np

FEW = 8  # points: of so few, all might have the same nearest point, and then no motion is the best


def motion(x, y, theta):
    """Matrices (..., 3, 3) of poses x, y [m] and theta [rad]."""
    x, y, theta = np.broadcast_arrays(x, y, theta)
    T = np.zeros((*x.shape, 3, 3))
    T[..., 0, 0] = T[..., 1, 1] = np.cos(theta)
    T[..., 1, 0] = np.sin(theta)
    T[..., 0, 1] = -T[..., 1, 0]
    T[..., 0, 2], T[..., 1, 2], T[..., 2, 2] = x, y, 1
    return T


def carried(T, points):
    """Points (..., n, 2) transformed by motions (..., 3, 3)."""
    return points @ T[..., :2, :2].mT + T[..., None, :2, 2]


def either_sign(rng, low, high, size=None):
    """Numbers whose magnitude lies between low and high."""
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


def fit(source, target, weights=None):
    """The best motion (..., 3, 3) of clouds (..., n, 2), weighted by (n,), by one arctangent."""
    a, b = (np.average(points, axis=-2, weights=weights) for points in (source, target))
    w = np.ones(source.shape[-2]) if weights is None else weights
    p, q = source - a[..., None, :], target - b[..., None, :]
    cross = p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0]
    T = motion(0, 0, np.arctan2(cross @ w, (p * q).sum(axis=-1) @ w))
    T[..., :2, 2] = b - (T[..., :2, :2] @ a[..., None])[..., 0]
    return T


def nearest(source, target):
    """Row of the nearest target point (n,), and its distance (n,) [m]."""
    apart = np.linalg.norm(source[:, None] - target, axis=-1)
    rows = apart.argmin(axis=1)
    return rows, apart[np.arange(len(source)), rows]


def matched(inputs, weights=lambda lengths: None):
    """{"result": (k, 3, 3)}: ICP for each row, with weights of the n correspondences (n,)."""
    found = []
    for source, target, T, iterations, *c in zip(*inputs.values(), strict=True):
        for _ in range(int(iterations)):
            moved = carried(T, source)
            rows, lengths = nearest(moved, target)
            T = fit(moved, target[rows], weights(lengths, *c)) @ T
        found.append(T)
    return {"result": np.array(found)}


def first_pairs(inputs):
    """The median length of the first correspondences [m], for a hint."""
    rows = zip(inputs["source"], inputs["target"], inputs["T"], strict=True)
    return np.array([np.median(nearest(carried(T, p), q)[1]) for p, q, T in rows])


def outline(rng, count, corners=5):
    """(count, 2) points along an irregular room's walls, about 5 m by 3.5 m [m]."""
    angle = (np.arange(corners) + 0.8 * rng.uniform(size=corners)) * 2 * np.pi / corners
    reach = rng.uniform(0.8, 1.2, corners)
    corner = np.column_stack([2.4 * reach * np.cos(angle), 1.7 * reach * np.sin(angle)])
    wall, along = rng.integers(0, corners, count), rng.uniform(size=(count, 1))
    return corner[wall] * (1 - along) + corner[(wall + 1) % corners] * along


def _posts(rng, count):
    """(count, 2) posts [m], so far apart that no two have the same nearest point."""
    angle = (np.arange(count) + 0.3 * rng.uniform(size=count)) * 2 * np.pi / count
    return rng.uniform(2, 2.5, (count, 1)) * np.column_stack([np.cos(angle), np.sin(angle)])


def looks(rng, iterations, sizes=(36, 48), people=0, off=1.5, turn=(1.4, 2.8)):
    """Two scans of a room: source (k, n, 2), target (k, m, 2), T (k, 3, 3), iterations (k,).
    people : number of further points of the source; off : error of the guess in units of 3 to 6°
    and 6 to 12 cm; turn : rotation between the scans [rad].
    """
    found = {"source": [], "target": [], "T": []}
    for _ in iterations:
        room = (outline if max(sizes) > FEW else _posts)(rng, max(sizes))
        T = motion(*either_sign(rng, 0.4, 1.5, 2), either_sign(rng, *turn))
        way = rng.uniform(0, 2 * np.pi)
        middle = room.mean(axis=0)
        crowd = middle + 4.2 * np.array([np.cos(way), np.sin(way)])
        crowd = crowd + rng.uniform(-0.4, 0.4, (people, 2))
        seen = np.concatenate([rng.permutation(room)[: sizes[0]], crowd])
        found["source"].append(rng.permutation(carried(np.linalg.inv(T), seen)))
        found["target"].append(rng.permutation(room)[: sizes[1]])
        about = motion(*middle, off * either_sign(rng, np.radians(3), np.radians(6)))
        shift = off * rng.uniform(0.06, 0.12) * np.array([np.cos(way), np.sin(way)])
        found["T"].append(motion(*shift, 0) @ about @ motion(*-middle, 0) @ T)
    return {name: np.array(made) for name, made in found.items()} | {
        "iterations": np.array(iterations)
    }
