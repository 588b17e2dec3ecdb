"""Exact ray casting among segments and circles, vectorised over beams and obstacles.

Seen from the sensor an obstacle spans an interval of bearings and only beams inside it can meet it.
So the work is a list of (obstacle, beam) pairs, not a table of all with all. For a wall on the line
n·q = 1 (q from the sensor) the inverse range along the unit vector u is just n·u: no division a
pair, and the nearest obstacle is the one with the largest inverse range.
"""

import numpy as np

TOUCH = 1e-9  # a sensor this close to a wall stands on it [m]
EDGE_ON = 1e-9  # a wall narrower than this is seen as its near end [rad]
PAD = 1e-12  # so that no beam slips between two walls that share a corner [rad]
BLOCK = 1 << 18  # pairs handled at once: bounds the memory


def cast(position, directions, walls, circles=()):
    """Distance from a point to the nearest obstacle in each direction.

    A point that stands on a wall or on a rim (within 1e-9 m) sees 0 in every direction; a beam that
    runs along a wall meets its near end; from inside a circle its rim is seen.

    Parameters
    ----------
    position : (2,) [m]
    directions : (n,) absolute, counter-clockwise from +x, any order, any number of turns [rad]
    walls : (w, 4) rows x1 y1 x2 y2 [m]; a wall may have length zero
    circles : (c, 3) rows x y radius [m]

    Returns
    -------
    (n,) ranges [m]; inf where nothing is met
    """
    position = np.asarray(position, dtype=float)[:2]
    directions = np.asarray(directions, dtype=float)
    walls = np.asarray(walls, dtype=float).reshape(-1, 4)
    circles = np.asarray(circles, dtype=float).reshape(-1, 3)

    bearings = np.mod(directions, 2 * np.pi)
    order = np.argsort(bearings)
    # a second turn of beams: an interval that passes 2 pi needs no splitting
    turns = np.concatenate([bearings[order], bearings[order] + 2 * np.pi])
    beams = np.concatenate([order, order])
    u = np.stack([np.cos(directions), np.sin(directions)])[:, beams]
    nearest = np.zeros(2 * len(directions))  # inverse ranges [1/m]

    touched = False
    if len(walls):
        touched |= _cast_walls(position, walls, turns, u, nearest)
    if len(circles):
        touched |= _cast_circles(position, circles, turns, u, nearest)
    if touched:
        return np.zeros(len(directions))

    ranges = np.empty(len(directions))
    with np.errstate(divide="ignore"):
        ranges[order] = 1 / np.maximum(*nearest.reshape(2, -1))
    return ranges


def _cast_walls(position, walls, turns, u, nearest):
    """Raise ``nearest`` to the walls' inverse ranges; True if the position is on a wall."""
    ax, ay, bx, by = (walls - np.tile(position, 2)).T
    wx, wy = bx - ax, by - ay
    cross, dot = ax * by - ay * bx, ax * bx + ay * by
    span = np.abs(np.arctan2(cross, dot))

    length2 = wx * wx + wy * wy
    along = -(ax * wx + ay * wy) / np.where(length2 > 0, length2, 1)
    along = np.clip(along, 0, 1)
    near_x, near_y = ax + along * wx, ay + along * wy
    near2 = near_x * near_x + near_y * near_y
    if near2.min() <= TOUCH**2:
        return True

    # the wall's line as n·q = 1; edge-on, the perpendicular through the near end stands for it
    edge_on = span < EDGE_ON
    scale = np.where(edge_on, near2, cross)
    nx = np.where(edge_on, near_x, wy) / scale
    ny = np.where(edge_on, near_y, -wx) / scale

    start = np.where(cross > 0, np.arctan2(ay, ax), np.arctan2(by, bx))
    for wall, beam in _pairs(start, span, turns):
        np.maximum.at(nearest, beam, nx[wall] * u[0, beam] + ny[wall] * u[1, beam])
    return False


def _cast_circles(position, circles, turns, u, nearest):
    """Raise ``nearest`` to the circles' inverse ranges; True if the position is on a rim."""
    cx, cy = circles[:, 0] - position[0], circles[:, 1] - position[1]
    radius = circles[:, 2]
    distance = np.hypot(cx, cy)
    if np.min(np.abs(distance - radius)) <= TOUCH:
        return True

    inside = distance < radius
    half = np.where(inside, np.pi, np.arcsin(radius / np.maximum(distance, radius)))
    start = np.where(inside, 0.0, np.arctan2(cy, cx) - half)
    side = np.where(inside, 1.0, -1.0)  # from inside the far intersection is the one ahead
    for circle, beam in _pairs(start, 2 * half, turns):
        ux, uy = u[:, beam]
        middle = cx[circle] * ux + cy[circle] * uy
        offset = cx[circle] * uy - cy[circle] * ux
        root = np.sqrt(np.maximum(radius[circle] ** 2 - offset**2, 0))
        np.maximum.at(nearest, beam, 1 / (middle + side[circle] * root))
    return False


def _pairs(start, span, turns):
    """Blocks of index pairs (obstacle, beam) of the beams inside each obstacle's interval."""
    start = np.mod(start - PAD, 2 * np.pi)
    first = np.searchsorted(turns, start)
    counts = np.searchsorted(turns, start + span + 2 * PAD, side="right") - first
    counts = np.minimum(counts, len(turns) // 2)
    ends = np.cumsum(counts)
    cut = np.searchsorted(ends, np.arange(BLOCK, ends[-1], BLOCK))
    for block in np.split(np.arange(len(start)), cut):
        n = counts[block]
        skip = np.cumsum(n) - n
        yield np.repeat(block, n), np.arange(n.sum()) + np.repeat(first[block] - skip, n)
