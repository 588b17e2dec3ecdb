"""Exact ray casting among segments and circles, vectorised over beams and obstacles.

Seen from the sensor an obstacle spans an interval of bearings and only beams inside it can meet it.
So the work is a list of (obstacle, beam) pairs, not a table of all with all. For a wall on the line
n·q = 1 (q from the sensor) the inverse range along the unit vector u is just n·u: no division a
pair, and the nearest obstacle is the one with the largest inverse range. Near obstacles go first,
so that those behind them need not be looked at.
"""

import numpy as np

ON_WALL = 1e-9  # a sensor this close to a wall stands on it [m]
EDGE_ON = 1e-9  # a wall narrower than this is seen as its near end [rad]
PADDING = 1e-12  # so that no beam slips between two walls that share a corner [rad]
FIRST_CHUNK = 64  # nearest obstacles that go first: they hide (occlude) most of the others
MAX_PAIRS = 1 << 20  # (obstacle, beam) pairs handled at once: bounds the memory


def cast(position, directions, walls, circles=()):
    """Cast rays (ray casting): distance from a point to the nearest obstacle in each direction.

    Equations (02.1) and (02.2); of circles, (02.12).

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
    order = np.argsort(bearings, kind="stable")  # linear where they come sorted
    bearings = bearings[order]
    # a second turn of beams: an interval that passes 2 pi needs no splitting
    turns = np.concatenate([bearings, bearings + 2 * np.pi])
    ux, uy = np.cos(bearings), np.sin(bearings)
    u = np.concatenate([ux, ux]), np.concatenate([uy, uy])
    nearest = np.zeros(len(turns))  # inverse ranges [1/m]

    if not len(directions):
        return np.empty(0)
    if _cast_walls(position, walls, turns, u, nearest):
        return np.zeros(len(directions))
    if len(circles) and _cast_circles(position, circles, turns, u, nearest):
        return np.zeros(len(directions))

    ranges = np.empty(len(directions))
    with np.errstate(divide="ignore"):
        ranges[order] = 1 / np.maximum(*nearest.reshape(2, -1))
    return ranges


def _cast_walls(position, walls, turns, u, nearest):
    """Raise ``nearest`` to the walls' inverse ranges; True if the position is on a wall."""
    ends = np.ascontiguousarray((walls - np.concatenate([position, position])).T)
    ax, ay, bx, by = ends
    wx, wy = bx - ax, by - ay
    length2 = wx * wx + wy * wy
    along = -(ax * wx + ay * wy) / np.where(length2 > 0, length2, 1)
    along = np.minimum(np.maximum(along, 0), 1)
    near_x, near_y = ax + along * wx, ay + along * wy
    near = np.hypot(near_x, near_y)
    if (near <= ON_WALL).any():
        return True

    for chunk in _nearest_first(near, nearest):
        ax, ay, bx, by = ends[:, chunk]
        cross, dot = ax * by - ay * bx, ax * bx + ay * by
        span = np.abs(np.arctan2(cross, dot))
        # the wall's line as n·q = 1; edge-on, the perpendicular through the near end stands for it
        edge_on = span < EDGE_ON
        scale = np.where(edge_on, near[chunk] ** 2, cross)
        nx = np.where(edge_on, near_x[chunk], by - ay) / scale
        ny = np.where(edge_on, near_y[chunk], ax - bx) / scale

        left = cross > 0
        start = np.arctan2(np.where(left, ay, by), np.where(left, ax, bx))
        wall, beam = _pairs(start, span, turns)
        np.maximum.at(nearest, beam, nx[wall] * u[0][beam] + ny[wall] * u[1][beam])
    return False


def _cast_circles(position, circles, turns, u, nearest):
    """Raise ``nearest`` to the circles' inverse ranges; True if the position is on a rim."""
    x, y, radii = (circles - [*position, 0.0]).T
    distance = np.hypot(x, y)
    near = np.abs(distance - radii)
    if (near <= ON_WALL).any():
        return True

    for chunk in _nearest_first(near, nearest):
        cx, cy, radius = x[chunk], y[chunk], radii[chunk]
        inside = distance[chunk] < radius
        half = np.where(inside, np.pi, np.arcsin(radius / np.maximum(distance[chunk], radius)))
        start = np.where(inside, 0.0, np.arctan2(cy, cx) - half)
        side = np.where(inside, 1.0, -1.0)  # from inside the far intersection is the one ahead
        circle, beam = _pairs(start, 2 * half, turns)
        ux, uy = u[0][beam], u[1][beam]
        middle = cx[circle] * ux + cy[circle] * uy
        offset = cx[circle] * uy - cy[circle] * ux
        root = np.sqrt(np.maximum(radius[circle] ** 2 - offset**2, 0))
        np.maximum.at(nearest, beam, 1 / (middle + side[circle] * root))
    return False


def _nearest_first(near, nearest):
    """Chunks of obstacles in order of distance, without those behind what every beam has met.

    ``nearest`` is read again before each chunk: the caller raises it in between.
    """
    if len(near) <= FIRST_CHUNK:
        yield slice(None)
        return
    todo, size = np.arange(len(near)), FIRST_CHUNK
    while len(todo):
        if len(todo) > size:
            todo = todo[np.argpartition(near[todo], size)]
        yield todo[:size]
        farthest = np.maximum(*nearest.reshape(2, -1)).min()
        todo = todo[size:]
        todo = todo[near[todo] * farthest < 1]
        size = max(FIRST_CHUNK, 2 * MAX_PAIRS // len(nearest))


def _pairs(start, span, turns):
    """Index pairs (obstacle, beam): the beams inside each obstacle's interval of bearings."""
    start = np.mod(start - PADDING, 2 * np.pi)
    first = np.searchsorted(turns, start)
    counts = np.searchsorted(turns, start + span + 2 * PADDING, side="right") - first
    counts = np.minimum(counts, len(turns) // 2)
    skipped = np.cumsum(counts) - counts
    return (
        np.repeat(np.arange(len(start)), counts),
        np.arange(counts.sum()) + np.repeat(first - skipped, counts),
    )
