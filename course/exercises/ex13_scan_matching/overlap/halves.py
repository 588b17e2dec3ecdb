"""Two scans of which about half overlaps, and a bad initial guess.

Rooms come in pairs with the same true motion; the errors of their two guesses are opposite.
"""

import numpy as np

from course.exercises.ex13_scan_matching.motions import either_sign, motion
from slamlab.geometry import compose, matrix, wrap
from slamlab.simulation.worlds import World

BEAMS, FIELD, NOISE = 100, np.radians(240), 0.01
CORNERS, BOXES = 7, 3


def rooms(rng, pairs=8, beams=(BEAMS, BEAMS), turn=(60, 115), off=(0.5, 1.2), off_turn=(30, 90)):
    """Scans of irregular rooms: source (2 pairs, n, 2), target (2 pairs, m, 2), T (2 pairs, 3, 3).
    turn : rotation of the robot [°]; off, off_turn : errors of the guess [m], [°].
    """
    found = {"source": [], "target": [], "T": []}
    for _ in range(pairs):
        here = np.append(rng.uniform(-0.4, 0.4, 2), rng.uniform(-np.pi, np.pi))
        step = np.append(rng.uniform(-0.5, 0.5, 2), np.radians(either_sign(rng, *turn)))
        way, far = rng.uniform(-np.pi, np.pi), rng.uniform(*off)
        error = [far * np.cos(way), far * np.sin(way), np.radians(either_sign(rng, *off_turn))]
        for sign in (1, -1):
            room = _room(rng)
            found["source"].append(_scan(rng, room, compose(here, step), beams[0]))
            found["target"].append(_scan(rng, room, here, beams[1]))
            found["T"].append(matrix(step + sign * np.array(error)))
    return {name: np.array(made) for name, made in found.items()}


def _room(rng):
    angle = (np.arange(CORNERS) + 0.7 * rng.uniform(size=CORNERS)) * 2 * np.pi / CORNERS
    corners = rng.uniform(2.2, 4.5, (CORNERS, 1)) * np.column_stack([np.cos(angle), np.sin(angle)])
    things = [corners]
    first = rng.uniform(0, 2 * np.pi)
    for k in range(BOXES):
        where = first + 2 * np.pi * k / BOXES + rng.uniform(-0.4, 0.4)
        middle = rng.uniform(1.5, 1.9) * np.array([np.cos(where), np.sin(where)])
        box = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * rng.uniform(0.12, 0.4, 2)
        things.append(middle + box @ motion(0, 0, rng.uniform(0, np.pi))[:2, :2].T)
    return World(np.vstack([np.hstack([t, np.roll(t, -1, axis=0)]) for t in things]))


def _scan(rng, room, pose, beams):
    bearing = np.linspace(-FIELD / 2, FIELD / 2, beams)
    r = room.cast(pose[:2], pose[2] + bearing) + NOISE * rng.standard_normal(beams)
    return r[:, None] * np.column_stack([np.cos(bearing), np.sin(bearing)])


def offs(inputs, motions):
    """Errors of motions (n, 3, 3): (n,) [m] and (n,) [°]."""
    guesses = _poses(inputs["T"]).reshape(-1, 2, 3)
    true = guesses.mean(axis=1)
    true[:, 2] = guesses[:, 0, 2] + wrap(guesses[:, 1, 2] - guesses[:, 0, 2]) / 2
    off = _poses(motions) - np.repeat(true, 2, axis=0)
    return np.hypot(off[:, 0], off[:, 1]), np.degrees(np.abs(wrap(off[:, 2])))


def _poses(T):
    return np.column_stack([T[:, :2, 2], np.arctan2(T[:, 1, 0], T[:, 0, 0])])
