"""Clouds for the tasks of scan matching, and what can be said of a motion that lays them over.

A source is a part of its target, moved and shuffled: the right motion lands each of its points on
a point of the target, exactly, so that a law needs no answer to compare with.
"""

import numpy as np

from slamlab.exercises.drives.ex13 import ROUNDS
from slamlab.geometry import from_matrix, matrix
from slamlab.scanmatching import point_to_point

PATIENT = {"tolerance": 1e-12, "max_rounds": ROUNDS - 3}

# turns all the way round, and small steps to each side of an optimum
_TURNS = np.concatenate([np.arange(1, 12) * np.pi / 6, [1e-3, -1e-3], np.zeros(4)])
_SHIFTS = np.concatenate([np.zeros((13, 2)), 1e-3 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])])


def motion(x, y, theta):
    """Homogeneous matrices (..., 3, 3) of poses given as arrays x, y [m] and theta [rad]."""
    x, y, theta = np.broadcast_arrays(x, y, theta)
    T = np.zeros((*x.shape, 3, 3))
    T[..., 0, 0] = T[..., 1, 1] = np.cos(theta)
    T[..., 1, 0] = np.sin(theta)
    T[..., 0, 1] = -T[..., 1, 0]
    T[..., 0, 2], T[..., 1, 2], T[..., 2, 2] = x, y, 1
    return T


def carried(T, points):
    """Points (..., n, 2) carried by motions (..., 3, 3)."""
    return points @ np.swapaxes(T[..., :2, :2], -1, -2) + T[..., None, :2, 2]


def either_sign(rng, low, high, size=None):
    """Numbers whose magnitude lies between low and high."""
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


def outline(rng, count, corners=5):
    """(count, 2) points along the walls of an irregular room, about 5 m by 3.5 m [m]."""
    angle = (np.arange(corners) + 0.8 * rng.uniform(size=corners)) * 2 * np.pi / corners
    reach = rng.uniform(0.8, 1.2, corners)
    corner = np.column_stack([2.4 * reach * np.cos(angle), 1.7 * reach * np.sin(angle)])
    wall, along = rng.integers(0, corners, count), rng.uniform(size=(count, 1))
    return corner[wall] * (1 - along) + corner[(wall + 1) % corners] * along


def nudged(rng, T, centre, size):
    """T, turned by size x 3 to 6 degrees about a point and shifted by size x 6 to 12 cm."""
    way, far = rng.uniform(0, 2 * np.pi), size * rng.uniform(0.06, 0.12)
    turn = motion(0, 0, size * either_sign(rng, np.radians(3), np.radians(6)))
    shift = motion(*(centre + far * np.array([np.cos(way), np.sin(way)])), 0)
    return shift @ turn @ motion(*-centre, 0) @ T


def nearest(source, target):
    """Row of the nearest target point and its distance [m], for each source point (..., n, 2)."""
    apart = source[..., :, None, :] - target[..., None, :, :]
    squared = np.einsum("...i,...i->...", apart, apart)
    index = squared.argmin(axis=-1)
    return index, np.sqrt(np.take_along_axis(squared, index[..., None], axis=-1)[..., 0])


def good_guess(rng, T, source, target, clutter=None, shares=(1.0,), low=0.4, high=0.85):
    """A first guess that gets only some of the pairs right, yet leads to T.

    Parameters
    ----------
    T : (3, 3) lands the source (n, 2) on points of the target (m, 2)
    clutter : (k, 2) further points of the source, or None
    shares : floats, shares of the pairs: a matcher that fits any of them must get there
    low, high : float, bounds of the share of nearest pairs that are right at the guess
    """
    right, size = nearest(carried(T, source), target)[0], 1.0
    seen = source if clutter is None else np.concatenate([source, clutter])
    while True:
        guess = nudged(rng, T, target.mean(axis=0), size)
        share = np.mean(nearest(carried(guess, source), target)[0] == right)
        if low <= share <= high:
            ends = (
                point_to_point(seen, target, from_matrix(guess), keep=keep, **PATIENT).pose
                for keep in shares
            )
            if all(landed(matrix(end), source, target) == len(source) for end in ends):
                return guess
        size *= 0.9 if share < low else 1.1


def paired(pairs, target):
    """(..., n, 2) the target's rows that pairs (..., n) name."""
    return np.take_along_axis(target, pairs[..., None], axis=-2)


def is_rigid(T):
    """(...) whether T is a homogeneous matrix with an orthonormal block, mirrored or not."""
    R = T[..., :2, :2]
    square = np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(2)).max(axis=(-1, -2)) < 1e-6
    return square & (np.abs(T[..., 2, :] - [0, 0, 1]).max(axis=-1) < 1e-9)


def is_best(T, source, target):
    """(k,) whether no turn and no small step of T lays paired points closer over each other.

    Parameters
    ----------
    T : (k, 3, 3)
    source, target : (k, n, 2) paired by row [m]
    """
    moved = carried(T, source)[:, None]
    centre = moved.mean(axis=-2, keepdims=True)
    others = carried(motion(*_SHIFTS.T, _TURNS), moved - centre) + centre
    here = np.square(moved[:, 0] - target).sum(axis=(-1, -2))
    return here <= np.square(others - target[:, None]).sum(axis=(-1, -2)).min(axis=-1) + 1e-12


def landed(T, source, target):
    """(...) how many source points T lands on a point of the target."""
    return np.count_nonzero(nearest(carried(T, source), target)[1] < 1e-6, axis=-1)
