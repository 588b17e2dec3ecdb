"""Predefined worlds: rooms for a lidar, Smolec's situations (§3.3, §4.5), small worlds (MAK 8)."""

import numpy as np

from slamlab.simulation.worlds.world import World, box, ring


def room():
    """Create an irregular living room with a slanted wall, niche, cupboard, table and pillar."""
    outer = [(-1.5, -2.0), (5.5, -2.0), (5.5, 1.2), (4.0, 3.4), (1.2, 3.4), (1.2, 2.8), (-1.5, 2.8)]
    walls = [
        ring(outer),
        box((2.3, 0.9), (1.2, 0.7), np.radians(20)),
        box((-1.2, 1.6), (0.6, 1.4)),
        box((3.6, -1.75), (1.6, 0.5)),
    ]
    return World(np.concatenate(walls), [(4.4, 0.1, 0.22), (0.2, -1.5, 0.25)], "room")


def corridor():
    """Create a corridor around a rectangular block, for a loop closure at the start."""
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
    """Create two identical rooms, which cause false loop closures (perceptual aliasing)."""
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
        table = box((x + 1.2, 4.6), (1.4, 0.8), np.radians(25))
        shelf = box((x + 5.5, 3.0), (0.6, 1.6))
        walls += [shell, table, shelf]
        pillars.append((x + 3.9, 5.2, 0.25))
    return World(np.concatenate(walls), pillars, "twins")


def polygon():
    """Create Tuček's cardboard polygon (§3.2): eight corners, with a box and a cylinder inside.

    The thesis states no dimensions; those here suit steps of 19 to 33 cm. No view shows all sides.
    """
    outer = [
        *[(-0.9, -1.5), (1.1, -1.5), (1.1, -0.3), (1.7, 0.1)],
        *[(1.7, 1.0), (0.3, 1.0), (0.1, 0.6), (-0.9, 0.6)],
    ]
    walls = np.concatenate([ring(outer), box((0.75, -0.42), (0.35, 0.25), np.radians(15))])
    return World(walls, [(-0.45, -0.75, 0.15)], "polygon")


def situation_1():
    """Create four rooms along a corridor with opposite doors; the lower left room is the start."""
    outer = ring([(-2.0, -2.0), (8.0, -2.0), (8.0, 7.5), (-2.0, 7.5)])
    # the corridor runs along y from 2 to 3.5; a door 1 m wide leads into each of four rooms
    pieces = (-2.0, -0.5), (0.5, 4.5), (5.5, 8.0)
    corridor = [[start, y, end, y] for y in (2.0, 3.5) for start, end in pieces]
    between_rooms = [[3.0, -2.0, 3.0, 2.0], [3.5, 3.5, 3.5, 7.5]]
    return World(np.concatenate([outer, corridor, between_rooms]), name="situation-1")


def situation_2():
    """Create an irregular room with a slanted wall and a start at the upper right."""
    corners = [
        *[(1.8, 1.5), (-2.6, 1.5), (-2.6, -0.4), (-5.2, -0.4)],
        *[(-5.2, -4.6), (-2.4, -4.6), (-2.4, -3.2), (-0.4, -3.2), (1.8, -1.6)],
    ]
    return World(ring(corners), name="situation-2")


def arena():
    """Create a closed arena of cardboard boxes for a robot of 12 × 12 cm.

    For a clockwise trajectory, a wall is always within 0.3 m to the left of the robot.
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
    """Create a table and four chairs; only their legs are visible to a lidar."""
    room = ring([(-2.0, -2.5), (4.0, -2.5), (4.0, 2.5), (-2.0, 2.5)])
    table = _legs((1.4, 0.3), (1.6, 0.9), 0.04, np.radians(15))
    poses = ((0.9, 1.2), 0.2), ((2.2, 1.35), -0.1), ((1.3, -0.75), 0.4), ((-0.9, -1.4), 0.9)
    chairs = [_legs(centre, (0.4, 0.4), 0.02, turn) for centre, turn in poses]
    return World(room, np.concatenate([table, *chairs]), "table-legs")


def _legs(centre, size, radius, turn):
    corners = box(centre, size, turn)[:, :2]
    return np.column_stack([corners, np.full(4, radius)])
