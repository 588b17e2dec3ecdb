"""Predefined worlds for a hand-held lidar: flats with doors, furniture and loops of rooms."""

import numpy as np

from slamlab.simulation.worlds.world import World, box, ring

THICKNESS = 0.1  # of an inner wall [m]
LEAF = 0.8  # width of an open door [m]


def flat():
    """Create a flat of 80 m²: corridor, bath, bedrooms, and two loops through the living room."""
    shell = ring([(-1.0, -4.0), (9.0, -4.0), (9.0, 4.0), (-1.0, 4.0)])
    inner = [
        *_wall((-1.0, 0.7), (6.0, 0.7), (1.0, 1.9), (3.6, 4.5)),
        *_wall((-1.0, -0.7), (6.0, -0.7), (0.4, 1.3), (2.6, 3.5)),
        *_wall((6.0, -4.0), (6.0, 4.0), (-3.2, -2.2), (-0.5, 0.5), (2.0, 3.0)),
        *_wall((3.0, 0.7), (3.0, 4.0)),
        *_wall((2.0, -4.0), (2.0, -0.7)),
    ]
    doors = [
        _open_door((1.0, 0.75), 95),
        _open_door((1.3, -0.75), -80),
        _open_door((3.6, 0.75), 100),
        _open_door((6.05, 2.0), -20),
    ]
    furniture = [
        box((-0.5, 2.6), (0.9, 2.0)),  # bedroom: bed, wardrobe, chest
        box((2.2, 3.7), (1.4, 0.5)),
        box((2.75, 1.3), (0.4, 0.9)),
        box((-0.6, -3.4), (0.7, 1.0)),  # bath: shower, washbasin
        box((1.7, -3.2), (0.5, 0.8)),
        box((5.6, 1.4), (0.6, 1.2)),  # kitchen: stove, cupboards
        box((3.9, 3.68), (1.6, 0.6)),
        box((8.6, 2.2), (0.6, 1.8)),  # living room: shelf, sofa, armchair
        box((8.55, -1.2), (0.8, 2.0)),
        box((6.7, -0.95), (0.6, 0.6), np.radians(25)),
        box((3.9, -3.6), (2.0, 0.7)),  # study: desk, shelf
        box((5.75, -1.2), (0.4, 0.8)),
    ]
    round_ones = [(5.4, -3.5, 0.22), (8.5, 3.5, 0.2), (-0.7, 0.45, 0.12), (6.5, 3.6, 0.18)]
    return World(np.concatenate([shell, *inner, *doors, *furniture]), round_ones, "flat")


def flat_2():
    """Create a flat of 99 m² around a bath, with a long loop, and a short loop near the kitchen."""
    shell = ring([(-1.0, -1.2), (10.0, -1.2), (10.0, 7.8), (-1.0, 7.8)])
    inner = [
        *_wall((4.0, -1.2), (4.0, 3.4), (-0.5, 0.5)),
        *_wall((-1.0, 1.0), (4.0, 1.0), (-0.3, 0.9)),
        *_wall((1.6, 1.0), (1.6, 3.4)),
        *_wall((-1.0, 3.4), (10.0, 3.4), (-0.2, 0.8), (2.4, 3.3), (7.4, 8.8)),
        *_wall((-1.0, 4.6), (6.0, 4.6), (0.2, 1.1), (3.3, 4.2)),
        *_wall((2.0, 4.6), (2.0, 7.8)),
        *_wall((6.0, 3.4), (6.0, 7.8), (3.55, 4.45), (5.6, 6.5)),
    ]
    doors = [
        _open_door((2.4, 3.35), -100),
        _open_door((0.2, 4.65), 100),
        _open_door((3.3, 4.65), 85),
        _open_door((4.05, 0.5), 75),
    ]
    furniture = [
        box((2.6, 0.75), (1.8, 0.4)),  # hall: wardrobe
        box((-0.8, 2.2), (0.35, 1.4)),  # passage: shelf
        box((3.65, 2.95), (0.5, 0.7)),  # bath: shower
        box((2.0, 1.4), (0.6, 0.5)),
        box((7.0, -0.85), (2.4, 0.6)),  # living room: sofa, shelves, sideboard
        box((9.75, 1.2), (0.4, 2.4)),
        box((5.0, 3.1), (1.6, 0.45)),
        box((6.6, 1.3), (1.1, 0.7), np.radians(15)),
        box((9.7, 5.6), (0.6, 2.8)),  # kitchen: a row, an island
        box((7.9, 6.3), (1.0, 0.6)),
        box((4.0, 7.3), (1.6, 1.0)),  # bedroom: bed, wardrobe
        box((2.35, 5.6), (0.6, 1.6)),
        box((-0.6, 6.6), (0.8, 1.8)),  # study: desk, shelf
        box((1.75, 7.1), (0.4, 1.2)),
        box((5.7, 5.1), (0.5, 0.6)),
    ]
    round_ones = [(9.4, -0.7, 0.25), (6.4, 7.4, 0.2), (1.2, -0.9, 0.15), (-0.7, 5.0, 0.18)]
    return World(np.concatenate([shell, *inner, *doors, *furniture]), round_ones, "flat-2")


def flat_3():
    """Create a flat of 66 m² with a slanted wall, and a loop through hall, kitchen and bedroom."""
    shell = ring([(-1.0, -1.0), (7.5, -1.0), (8.7, 1.6), (8.7, 6.0), (-1.0, 6.0)])
    inner = [
        *_wall((2.5, -1.0), (2.5, 2.0), (-0.5, 0.5)),
        *_wall((-1.0, 2.0), (5.2, 2.0), (-0.2, 0.9)),
        *_wall((-1.0, 3.1), (5.2, 3.1), (0.3, 1.2), (2.6, 3.5)),
        *_wall((2.0, 3.1), (2.0, 6.0)),
        *_wall((5.2, -1.0), (5.2, 6.0), (0.3, 1.3), (2.1, 3.0), (4.0, 5.0)),
    ]
    doors = [_open_door((2.55, 0.5), 70), _open_door((1.2, 3.15), 80), _open_door((5.25, 4.0), -75)]
    furniture = [
        box((1.5, -0.8), (1.6, 0.35)),  # hall: wardrobe
        box((2.1, 1.6), (0.6, 0.6)),
        box((3.9, -0.7), (2.0, 0.55)),  # kitchen: a row, the refrigerator
        box((3.2, 1.65), (0.6, 0.6)),
        box((-0.6, 5.5), (0.7, 0.9)),  # bath: shower, washbasin
        box((1.7, 4.9), (0.5, 0.7)),
        box((3.9, 5.5), (1.9, 0.9)),  # bedroom: bed, wardrobe
        box((2.3, 4.5), (0.5, 1.2)),
        box((8.4, 3.4), (0.5, 1.8)),  # living room: shelf, sofa, chest
        box((6.9, 5.6), (2.0, 0.7)),
        box((6.0, -0.75), (0.9, 0.4)),
    ]
    round_ones = [(6.9, 2.9, 0.45), (8.3, 5.5, 0.2), (-0.75, 1.6, 0.14)]  # a table, two plants
    return World(np.concatenate([shell, *inner, *doors, *furniture]), round_ones, "flat-3")


def _wall(start, end, *doors):
    """Yield the boxes of a wall along x or y; ``doors``: (from, to) of each doorway [m]."""
    start, end = np.array(start), np.array(end)
    axis = int(start[0] == end[0])
    edges = [start[axis], *np.ravel(doors), end[axis]]
    for begin, stop in zip(edges[::2], edges[1::2], strict=True):
        centre, size = start.copy(), np.full(2, THICKNESS)
        centre[axis], size[axis] = (begin + stop) / 2, stop - begin
        yield box(centre, size)


def _open_door(hinge, direction):
    """Return the leaf of an open door that extends from its hinge in a direction [degree]."""
    turn = np.radians(direction)
    tip = np.add(hinge, LEAF * np.array([np.cos(turn), np.sin(turn)]))
    return np.array([[*hinge, *tip]])
