"""Exact ray casting to line segments and circles, vectorised over beams and obstacles."""

import numpy as np

ON_WALL = 1e-9  # a sensor closer to a wall counts as on the wall [m]
EDGE_ON = 1e-9  # a wall that spans less counts as its near end [rad]
PADDING = 1e-12  # so that no beam passes between two walls with a common corner [rad]
FIRST_CHUNK = 64  # nearest obstacles, processed first: they occlude most of the others
CACHED = 1 << 14  # (obstacle, ray) pairs of a table that fits into the processor's cache
MAX_PAIRS = 1 << 20  # (obstacle, beam) pairs processed at once: bounds the memory


def cast(position, directions, walls, circles=()):
    """Cast rays from one position along absolute directions (n,) [rad].

    Returns ranges (n,), inf for no hit [m]. Equations (02.1) and (02.2); for circles, (02.17). From
    a position on a wall, all ranges are 0. A beam along a wall hits the near end of the wall.
    """
    position = np.asarray(position, dtype=float)[:2]
    directions = np.asarray(directions, dtype=float)
    walls = np.asarray(walls, dtype=float).reshape(-1, 4)
    circles = np.asarray(circles, dtype=float).reshape(-1, 3)

    # an obstacle spans an interval of bearings: only beams inside the interval can hit it
    bearings = np.mod(directions, 2 * np.pi)
    order = np.argsort(bearings, kind="stable")  # linear for sorted bearings
    bearings = bearings[order]
    # a second revolution of beams: an interval across 2 pi needs no splitting
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
    """Update ``nearest`` with the walls' inverse ranges; return True for a position on a wall."""
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
        # the wall's line as n·q = 1; edge-on, the perpendicular through its near end
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
        side = np.where(inside, 1.0, -1.0)  # from inside, the far intersection lies ahead
        circle, beam = _pairs(start, 2 * half, turns)
        ux, uy = u[0][beam], u[1][beam]
        middle = cx[circle] * ux + cy[circle] * uy
        offset = cx[circle] * uy - cy[circle] * ux
        root = np.sqrt(np.maximum(radius[circle] ** 2 - offset**2, 0))
        np.maximum.at(nearest, beam, 1 / (middle + side[circle] * root))
    return False


def _nearest_first(near, nearest):
    """Yield chunks of obstacles in order of distance, without completely occluded obstacles."""
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
    """Return index pairs (obstacle, beam) of the beams in each obstacle's interval of bearings."""
    start = np.mod(start - PADDING, 2 * np.pi)
    first = np.searchsorted(turns, start)
    counts = np.searchsorted(turns, start + span + 2 * PADDING, side="right") - first
    counts = np.minimum(counts, len(turns) // 2)
    skipped = np.cumsum(counts) - counts
    return (
        np.repeat(np.arange(len(start)), counts),
        np.arange(counts.sum()) + np.repeat(first - skipped, counts),
    )


def cast_each_ray(positions, directions, walls, circles):
    """Cast each ray from its own position; return ranges (n,), inf for no hit [m].

    ``positions``: (n, 2) [m]; ``directions``: (n,) [rad]; ``walls``: (w, 4); ``circles``: (c, 3),
    or (n, c, 3) for moving obstacles.
    """
    # ``cast`` is for many rays from one position; for many positions a full table is faster
    circles = np.broadcast_to(circles, (len(directions), *circles.shape[-2:]))
    ranges, rays = np.empty(len(directions)), max(CACHED // (len(walls) + 1), 1)
    for first in range(0, len(directions), rays):
        some = slice(first, first + rays)
        x, y = positions[some, :1], positions[some, 1:]
        u = np.cos(directions[some])[:, None], np.sin(directions[some])[:, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            to_walls = _ranges_to_walls(x, y, *u, walls)
            to_circles = _ranges_to_circles(x, y, *u, circles[some])
        ranges[some] = np.minimum(to_walls, to_circles)
    return ranges


def _ranges_to_walls(x, y, ux, uy, walls):
    ax, ay = walls[:, 0] - x, walls[:, 1] - y
    wx, wy = walls[:, 2] - walls[:, 0], walls[:, 3] - walls[:, 1]
    across = ux * wy - uy * wx
    along, share = (ax * wy - ay * wx) / across, (ax * uy - ay * ux) / across
    hits = (along >= 0) & (share >= 0) & (share <= 1)
    return np.where(hits, along, np.inf).min(axis=1, initial=np.inf)


def _ranges_to_circles(x, y, ux, uy, circles):
    cx, cy = circles[..., 0] - x, circles[..., 1] - y
    middle = ux * cx + uy * cy
    half = np.sqrt(circles[..., 2] ** 2 - (ux * cy - uy * cx) ** 2)
    near, far = middle - half, middle + half
    to_circles = np.where(near >= 0, near, np.where(far >= 0, far, np.inf))
    return np.fmin.reduce(to_circles, axis=1, initial=np.inf)  # NaN: no hit
