"""Ready small worlds: a table-top arena of cardboard boxes (MAK thesis, ch. 8), and table legs."""

import numpy as np

from slamlab.worlds.shapes import box, ring
from slamlab.worlds.world import World


def arena():
    """A closed arena of cardboard boxes with many corners, for a robot of 12 × 12 cm.

    The boxes stand so that a scanner reaching 0.3 m always has a wall on its left when the robot
    keeps along them clockwise; the arena of the thesis is known from photographs only.
    """
    outer = [
        *[(-0.3, 0.2), (0.25, 0.2), (0.25, 0.32), (0.6, 0.32), (0.6, 0.2), (1.1, 0.2)],
        *[(1.1, -0.1), (1.22, -0.1), (1.22, -0.5), (1.1, -0.5), (1.1, -0.9)],
        *[(0.7, -0.9), (0.7, -0.78), (0.35, -0.78), (0.35, -0.9), (-0.3, -0.9)],
        *[(-0.3, -0.6), (-0.42, -0.6), (-0.42, -0.2), (-0.3, -0.2)],
    ]
    inner = [box((0.3, -0.32), (0.3, 0.2)), box((0.62, -0.4), (0.22, 0.24), np.radians(20))]
    return World(np.concatenate([ring(outer), *inner]), name="arena")


def table_legs():
    """A bare room with a table and four chairs, of which a lidar sees the legs only (spikes)."""
    room = ring([(-2.0, -2.5), (4.0, -2.5), (4.0, 2.5), (-2.0, 2.5)])
    table = _legs((1.4, 0.3), (1.6, 0.9), 0.04, np.radians(15))
    chairs = [
        _legs(centre, (0.4, 0.4), 0.02, turn)
        for centre, turn in [
            ((0.9, 1.2), 0.2),
            ((2.2, 1.35), -0.1),
            ((1.3, -0.75), 0.4),
            ((-0.9, -1.4), 0.9),
        ]
    ]
    return World(room, np.concatenate([table, *chairs]), "table-legs")


def _legs(centre, size, radius, turn):
    """(4, 3) round legs at the corners of a turned rectangle [m]."""
    corners = box(centre, size, turn)[:, :2]
    return np.column_stack([corners, np.full(4, radius)])
