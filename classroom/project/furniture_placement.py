"""Place furniture (boxes and circles) in a floor plan without blocking the robot's path."""

from itertools import pairwise

import numpy as np

from slamlab.simulation.worlds import box

CLEARANCE = 0.5  # from the path: the robot's radius, its deviation, and a margin [m]
FROM_DOOR, FROM_WALL = 0.6, 0.03  # distance from the centre of a door; of a cupboard to a wall [m]
MAX_PIECES, TRIES = 5, 12  # pieces of furniture in a room, and tries to place each
CUPBOARDS, TABLES = 0.55, 0.25  # shares of the pieces; the rest is round [1]


def place_furniture(floor, paths, rng, identical=False, corridors=True):
    """Place furniture away from paths (n, 2) [m]; return walls (n, 4) and circles (m, 3) [m].

    identical : whether all rooms get the same furniture. corridors : whether to furnish corridors,
    too."""
    track = np.concatenate([_sampled(path) for path in paths])
    doors = np.array(list(floor.passages.values()))
    walls, circles, seed = [np.empty((0, 4))], [np.empty((0, 3))], rng.integers(2**63)
    for k, cell in enumerate(sorted(floor.cells)):
        in_corridor = cell in floor.corridors
        if in_corridor and not corridors:
            continue
        own = np.random.default_rng([seed, 0 if identical else k])
        low, high = np.reshape(floor.cells[cell], (2, 2))
        placed = []
        for _ in range(own.integers(2, MAX_PIECES + 1)):
            for _ in range(TRIES):
                centre, size, turn, is_round = _draw_piece(low, high, own, in_corridor)
                outline = box(centre, size, turn)
                rim = _sampled(outline.reshape(-1, 2))
                radius = np.hypot(*size) / 2
                if (
                    (rim > low + FROM_WALL / 2).all()
                    and (rim < high - FROM_WALL / 2).all()
                    and all(np.hypot(*(centre - c)) > radius + r for c, r in placed)
                    and _distance(rim, track) > CLEARANCE
                    and _distance(rim, doors) > FROM_DOOR
                ):
                    placed.append((centre, radius))
                    if is_round:
                        circles.append([[*centre, size[0] / 2]])
                    else:
                        walls.append(outline)
                    break
    return np.concatenate(walls), np.concatenate(circles)


def _draw_piece(low, high, rng, in_corridor):
    """Draw the position, size and orientation of a piece of furniture, and whether it is round."""
    side, along, kind = rng.integers(4), rng.random(), rng.random()
    width, depth = rng.uniform(0.5, 1.6), rng.uniform(0.25, 0.7)
    if kind < CUPBOARDS or in_corridor:  # along a wall; shallow in a corridor
        depth = depth / 2 if in_corridor else depth
        size = np.array([width, depth] if side < 2 else [depth, width])
        least, most = low + size / 2 + FROM_WALL, high - size / 2 - FROM_WALL
        centre = least + along * (most - least)
        axis = 1 if side < 2 else 0
        centre[axis] = (least, most)[side % 2][axis]
        return centre, size, 0.0, False
    centre = rng.uniform(low + 0.3, high - 0.3)
    if kind < CUPBOARDS + TABLES:
        return centre, np.array([width, depth + 0.1]), rng.uniform(0, np.pi), False
    return centre, np.full(2, rng.uniform(0.15, 0.5)), 0.0, True


def _sampled(points, step=0.1):
    """Sample equidistant points along a path [m]."""
    parts = [
        a + np.linspace(0, 1, int(np.hypot(*(b - a)) / step) + 2)[:, None] * (b - a)
        for a, b in pairwise(points)
    ]
    return np.concatenate([*parts, points[-1:]])


def _distance(points, others):
    return np.hypot(*(points[:, None] - others).transpose(2, 0, 1)).min()
