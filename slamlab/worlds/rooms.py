"""Ready indoor worlds for a lidar: a room, a corridor that closes a loop, twin rooms, a polygon."""

import numpy as np

from slamlab.worlds.shapes import box, ring
from slamlab.worlds.world import World


def room():
    """An irregular living room: one slanted wall, a niche, a cupboard, a table, a pillar."""
    outer = [(-1.5, -2.0), (5.5, -2.0), (5.5, 1.2), (4.0, 3.4), (1.2, 3.4), (1.2, 2.8), (-1.5, 2.8)]
    walls = [
        ring(outer),
        box((2.3, 0.9), (1.2, 0.7), np.radians(20)),
        box((-1.2, 1.6), (0.6, 1.4)),
        box((3.6, -1.75), (1.6, 0.5)),
    ]
    return World(np.concatenate(walls), [(4.4, 0.1, 0.22), (0.2, -1.5, 0.25)], "room")


def corridor():
    """A corridor 2 m wide round a rectangular block, to close a loop: start and end should meet.

    Niches, pillars and a cupboard stand along it: between bare walls a scan matcher cannot tell how
    far the robot went.
    """
    outer = [
        *[(-2.0, -1.0), (3.0, -1.0), (3.0, -1.4), (4.0, -1.4), (4.0, -1.0), (13.0, -1.0)],
        *[(13.0, 3.5), (13.4, 3.5), (13.4, 4.7), (13.0, 4.7), (13.0, 9.0)],
        *[(8.5, 9.0), (8.5, 9.5), (7.3, 9.5), (7.3, 9.0), (-2.0, 9.0)],
        *[(-2.0, 5.2), (-2.4, 5.2), (-2.4, 4.2), (-2.0, 4.2)],
    ]
    block = [
        *[(0.0, 1.0), (6.0, 1.0), (6.0, 1.4), (7.0, 1.4), (7.0, 1.0), (11.0, 1.0)],
        *[(11.0, 7.0), (3.5, 7.0), (3.5, 6.6), (2.3, 6.6), (2.3, 7.0), (0.0, 7.0)],
    ]
    cupboards = [box((9.3, -0.8), (1.2, 0.4)), box((11.2, 5.6), (0.4, 0.9))]
    pillars = [(1.3, 0.85, 0.15), (4.9, 8.8, 0.2), (-1.85, 1.9, 0.15)]
    return World(np.concatenate([ring(outer), ring(block), *cupboards]), pillars, "corridor")


def twins():
    """Twin rooms (perceptual aliasing): alike to the last chair, a trap for loop closure."""
    corridor = [
        [(-2.0, -1.0), (15.0, -1.0)],
        [(15.0, -1.0), (15.0, 1.0)],
        [(15.0, 1.0), (10.5, 1.0)],
        [(9.5, 1.0), (3.5, 1.0)],
        [(2.5, 1.0), (-2.0, 1.0)],
        [(-2.0, 1.0), (-2.0, -1.0)],
    ]
    walls, pillars = [np.array(corridor).reshape(-1, 4), box((-1.7, 0.7), (0.4, 0.4))], []
    for x in (0.0, 7.0):
        doors = [(x + 3.5, 1.0), (x + 3.5, 1.2), (x + 6.0, 1.2), (x + 6.0, 6.0), (x, 6.0)]
        shell = ring([*doors, (x, 1.2), (x + 2.5, 1.2), (x + 2.5, 1.0)])[:-1]  # the last is open
        table, shelf = (
            box((x + 1.2, 4.6), (1.4, 0.8), np.radians(25)),
            box((x + 5.5, 3.0), (0.6, 1.6)),
        )
        walls += [shell, table, shelf]
        pillars.append((x + 3.9, 5.2, 0.25))
    return World(np.concatenate(walls), pillars, "twins")


def polygon():
    """Tuček's cardboard polygon: eight corners, a smaller box and a cylinder inside (§3.2).

    His figures give no measures: these fit his steps of 19 to 33 cm, and as with him no place sees
    every side. The origin is his first scanning place.
    """
    outer = [
        *[(-0.9, -1.5), (1.1, -1.5), (1.1, -0.3), (1.7, 0.1)],
        *[(1.7, 1.0), (0.3, 1.0), (0.1, 0.6), (-0.9, 0.6)],
    ]
    walls = np.concatenate([ring(outer), box((0.75, -0.42), (0.35, 0.25), np.radians(15))])
    return World(walls, [(-0.45, -0.75, 0.15)], "polygon")
