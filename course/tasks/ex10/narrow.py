"""Programs of 10-narrow: many ways to smaller boxes, and ways that give up what is possible."""

from course.tasks import Slip, Stumble

TASK = "10-narrow"

WAYS = {
    "where lines cross": """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(2):
        ends, found = np.linspace(*heading, 25), []
        for piece in zip(ends[:-1], ends[1:]):
            lines = [(-1, 0, -robot[0]), (1, 0, robot[1]), (0, -1, -robot[2]), (0, 1, robot[3])]
            for place, sight in zip(objects, z):
                lines += list(edges(sight, bounds, np.add(piece, np.pi), np.repeat(place, 2)))
            lines = np.array(lines)
            k, m = np.triu_indices(len(lines), 1)
            (a, b, c), (d, e, f) = lines[k].T, lines[m].T
            with np.errstate(all="ignore"):
                points = np.array([c * e - b * f, a * f - c * d]) / (a * e - b * d)
                points = points[:, (lines[:, :2] @ points <= lines[:, 2:] + 1e-9).all(axis=0)]
            if points.size:
                found.append([*points.min(axis=1), piece[0], *points.max(axis=1), piece[1]])
        low, high = np.min(found, axis=0)[:3], np.max(found, axis=0)[3:]
        robot, heading = np.array([low[0], high[0], low[1], high[1]]), np.array([low[2], high[2]])
    return robot, heading
""",
    "a grid of cells": """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(4):
        sides = [np.linspace(*side, 13) for side in (robot[:2], robot[2:], heading)]
        low = np.array(np.meshgrid(*(s[:-1] for s in sides))).reshape(3, -1)
        high = np.array(np.meshgrid(*(s[1:] for s in sides))).reshape(3, -1)
        for place, (r, bearing) in zip(objects, z):
            x, y = np.array([low[:2], high[:2]]).swapaxes(0, 1) - place[:, None, None]
            aside = [np.maximum(0, np.maximum(s[0], -s[1])) for s in (x, y)]
            most = np.hypot(np.abs(x).max(axis=0), np.abs(y).max(axis=0))
            middle = np.arctan2(-y.sum(axis=0), -x.sum(axis=0))
            off = wrap(np.arctan2(-y[[0, 0, 1, 1]], -x[[0, 1, 0, 1]]) - middle)
            turn = wrap(middle - bearing - (low[2] + high[2]) / 2)
            slack = bounds[1] + (high[2] - low[2]) / 2
            seen = (turn + off.min(axis=0) <= slack) & (turn + off.max(axis=0) >= -slack)
            seen |= np.hypot(*aside) == 0
            keep = seen & (np.hypot(*aside) <= r + bounds[0]) & (most >= r - bounds[0])
            low, high = low[:, keep], high[:, keep]
        ends = np.array([low.min(axis=1), high.max(axis=1)])
        robot, heading = ends[:, :2].T.ravel(), ends[:, 2]
    return robot, heading
""",
    "halves of the heading": """
def narrow(robot, heading, objects, z, bounds):
    def rest(corners, edge):
        c = edge[2] - corners @ edge[:2]
        ahead, there = np.roll(corners, -1, axis=0), np.roll(c, -1)
        share = c / np.where(c == there, 1, c - there)
        crossed = corners + share[:, None] * (ahead - corners)
        return np.concatenate([corners[c >= 0], crossed[(c >= 0) != (there >= 0)]])

    def halves(piece, corners, depth):
        for place, sight in zip(objects, z):
            if len(corners) and np.ptp(piece) < 2:
                for edge in edges(sight, bounds, np.add(piece, np.pi), np.repeat(place, 2)):
                    corners = around(rest(corners, edge)) if len(corners) else corners
        if not len(corners):
            return []
        if depth == 0:
            return [(corners, piece)]
        middle = (piece[0] + piece[1]) / 2
        return halves((piece[0], middle), corners, depth - 1) + halves((middle, piece[1]), corners, depth - 1)

    def around(points):
        if not len(points):
            return points
        angle = np.arctan2(*(points - points.mean(axis=0)).T)
        return points[np.argsort(angle)]

    whole = np.array([(x, y) for x in robot[:2] for y in robot[2:]])
    found = halves(tuple(heading), around(whole), 7)
    x, y = np.concatenate([corners for corners, _ in found]).T
    angles = np.array([piece for _, piece in found])
    return [x.min(), x.max(), y.min(), y.max()], [angles.min(), angles.max()]
""",
    "pieces after many rounds": """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(12):
        robot, heading = look(robot, heading, objects, z, bounds)

    def rest(polygon, a, b, c):
        kept = []
        for k, (x, y) in enumerate(polygon):
            u, v = polygon[k - 1]
            here, before = a * x + b * y - c, a * u + b * v - c
            if here * before < 0:
                t = before / (before - here)
                kept.append((u + t * (x - u), v + t * (y - v)))
            if here <= 0:
                kept.append((x, y))
        return kept

    boxes = []
    width = (heading[1] - heading[0]) / 40
    for k in range(40):
        piece = heading[0] + k * width, heading[0] + (k + 1) * width
        polygon = [(robot[0], robot[2]), (robot[1], robot[2]), (robot[1], robot[3]), (robot[0], robot[3])]
        for place, sight in zip(objects, z):
            for a, b, c in edges(sight, bounds, np.add(piece, np.pi), place[[0, 0, 1, 1]]):
                polygon = rest(polygon, a, b, c)
        if polygon:
            boxes.append((*np.min(polygon, axis=0), *np.max(polygon, axis=0), *piece))
    x0, y0, x1, y1, right, left = np.transpose(boxes)
    return (x0.min(), x1.max(), y0.min(), y1.max()), (right.min(), left.max())
""",
}
SLIPS = ()
